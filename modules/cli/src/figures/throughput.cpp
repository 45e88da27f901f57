// SPDX-License-Identifier: MIT
#include "figures/figure.hpp"
#include "figures/tube.hpp"
#include "progress.hpp"

#include <goffer/engine/columns.hpp>
#include <goffer/measure/crowd_scene.hpp>
#include <goffer/measure/fill.hpp>
#include <goffer/measure/timer.hpp>

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

/// Nanoseconds per vertex, for positions and normals in planes: of one body, and of a crowd.

namespace goffer::cli {
namespace {

constexpr std::array<std::size_t, 3> crowd_vertices{200, 500, 1000};
constexpr std::size_t non_temporal_bytes = std::size_t{16} << 20;  // crowds from there on go past the cache

/// Nanoseconds of `work`, a median: as often as takes so many seconds, and three times at least.
double time_of(double seconds, int threads, const std::function<void()>& work) {
    constexpr std::size_t least = 3, most = 100'000;
    work();  // memory that was never touched
    std::vector<double> times;
    for (double sum = 0; times.size() < least || (sum < 1e9 * seconds && times.size() < most);) {
        times.push_back(measure::nanoseconds_of(threads, work));
        sum += times.back();
    }
    return measure::median(times);
}

/// What a crowd costs per vertex.
struct Cost {
    double one_thread = 0, all_threads = 0, fill = 0;  ///< ns
};

Cost cost_of(const Workshop& workshop, const bend::Body& body, std::size_t instances) {
    const measure::StreamLayout& layout = measure::stream_layout("positions+normals");
    const std::size_t vertices = body.vertex_count() * instances;
    Columns memory(1, layout.memory_floats(vertices));
    measure::CrowdScene scene({{&body, instances, body.vertex_count()}}, layout, memory[0]);
    scene.set_poses([](std::size_t i, std::span<bend::Pose> poses) { poses[0] = varied_pose(i); });
    const double seconds = workshop.plan.seconds, count = static_cast<double>(vertices);
    // Small work is done several times, so that the clock's own time does not show.
    const std::size_t times = std::max<std::size_t>(1, 20'000 / vertices);
    const auto repeated = [&](auto&& once) {
        return [&, once] {
            for (std::size_t i = 0; i < times; ++i) once();
        };
    };
    const bend::CrowdJob job = scene.job();
    const double all = count * static_cast<double>(times);
    Cost cost;
    cost.one_thread = time_of(seconds, 1, repeated([&] { bend::run(job); })) / all;
    tbb::task_arena arena(workshop.threads);
    cost.all_threads = arena.execute([&] {
        return time_of(seconds, measure::wall_clock, repeated([&] { bend::run_parallel(job); })) / all;
    });
    const std::span<float> written = memory[0].first(layout.floats * vertices);
    const bool past = written.size_bytes() >= non_temporal_bytes;
    cost.fill = time_of(seconds, 1, repeated([&] { measure::fill(written, 1, past); })) / all;
    return cost;
}

Table cost_table() {
    return Table({"vertices", "instances", "one_thread_ns", "all_threads_ns", "fill_ns", "threads"});
}

void add_row(Table& table, const Workshop& workshop, const bend::Body& body, std::size_t instances) {
    const Cost cost = cost_of(workshop, body, instances);
    table.add({static_cast<double>(body.vertex_count()), static_cast<double>(instances), cost.one_thread,
               cost.all_threads, cost.fill, static_cast<double>(workshop.threads)});
}

std::string ns(const Table& table, std::size_t row, const char* column) {
    return html(table, row, column) + "&nbsp;ns";
}

constexpr const char* vertices_script = R"gp(set logscale xy
set xlabel "vertices of the body"
set ylabel "ns per vertex"
set format x "10^{%T}"
set key outside top center maxcols 1
plot data using "vertices":"one_thread_ns" with linespoints lw 2 pt 7 ps 0.6 lc rgb "#d55e00" title "one thread", \
     data using "vertices":"all_threads_ns" with linespoints lw 2 pt 5 ps 0.6 lc rgb "#0072b2" title "all threads", \
     data using "vertices":"fill_ns" with lines lw 1.5 dt 2 lc rgb "#555555" title "fill of the same bytes, one thread"
)gp";

constexpr const char* instances_script = R"gp(set logscale xy
set xlabel "instances"
set ylabel "ns per vertex"
set xrange [0.7:*]
set yrange [0.2:10]
set key top right maxcols 1
of(count, name) = column("vertices") == count ? column(name) : NaN
sizes = "200 500 1000"
colors = "#d55e00 #009e73 #0072b2"
plot for [i = 1:3] data using (of(word(sizes, i), "instances")):"one_thread_ns" with linespoints lw 2 pt 7 ps 0.6 \
         lc rgb word(colors, i) title word(sizes, i)." vertices, one thread", \
     for [i = 1:3] data using (of(word(sizes, i), "instances")):"all_threads_ns" with linespoints lw 2 dt 2 pt 5 ps 0.6 \
         lc rgb word(colors, i) notitle, \
     keyentry with lines lw 2 dt 2 lc rgb "#333333" title "all threads"
)gp";

}  // namespace

Figure vertices_figure(Workshop& workshop) {
    Figure figure{.name = "vertices", .title = "Time per vertex: one body", .table = cost_table()};
    const Progress progress("timing bodies of many sizes");
    for (std::size_t decade = 100; decade <= workshop.plan.most_vertices; decade *= 10) {
        for (const std::size_t vertices : {decade, 3 * decade})
            if (vertices <= workshop.plan.most_vertices)
                add_row(figure.table, workshop, Tube(vertices).body(), 1);
    }
    const Table& t = figure.table;
    const std::size_t last = t.rows() - 1;
    figure.paragraphs.push_back(
        "Positions and normals of one bare cylinder with a relief, one radius and the paper&rsquo;s folds, "
        "written in planes: " +
        ns(t, 0, "one_thread_ns") + " per vertex for " + html(t, 0, "vertices", Shown::whole) +
        " vertices and " + ns(t, last, "one_thread_ns") + " for " + html(t, last, "vertices", Shown::whole) +
        " on one thread, where a fill of as many bytes takes " + ns(t, last, "fill_ns") + "; with " +
        html(t, last, "threads", Shown::whole) + " threads the largest takes " +
        ns(t, last, "all_threads_ns") +
        ". Small bodies pay for what is computed once per instance. A body that is thicker here than there "
        "takes longer. The time of one thread is the processor&rsquo;s, that of several the wall "
        "clock&rsquo;s, "
        "which counts what other programs take.");
    figure.script = vertices_script;
    return figure;
}

Figure instances_figure(Workshop& workshop) {
    Figure figure{.name = "instances", .title = "Time per vertex: a crowd", .table = cost_table()};
    const Progress progress("timing crowds of many sizes");
    for (const std::size_t vertices : crowd_vertices) {
        const bend::Body body = Tube(vertices).body();
        for (std::size_t instances = 1; instances <= workshop.plan.most_instances; instances *= 10)
            add_row(figure.table, workshop, body, instances);
    }
    const Table& t = figure.table;
    const std::size_t last = t.rows() - 1;
    figure.paragraphs.push_back(
        "The same for crowds, each instance in a pose of its own: " +
        html(t, last, "instances", Shown::whole) + " instances of " +
        html(t, last, "vertices", Shown::whole) + " vertices take " + ns(t, last, "one_thread_ns") +
        " per vertex on one thread and " + ns(t, last, "all_threads_ns") + " on " +
        html(t, last, "threads", Shown::whole) + ", where a fill of as many bytes takes " +
        ns(t, last, "fill_ns") + " on one.");
    figure.script = instances_script;
    return figure;
}

}  // namespace goffer::cli
