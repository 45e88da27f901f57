// SPDX-License-Identifier: MIT
#include "figures/drawing.hpp"
#include "figures/figure.hpp"
#include "figures/tube.hpp"
#include "progress.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/engine/columns.hpp>
#include <goffer/measure/timer.hpp>
#include <goffer/paper/grid.hpp>

#include <algorithm>
#include <functional>
#include <span>
#include <utility>

/// Figure 9: what each step of a frame takes.

namespace goffer::cli {
namespace {

constexpr std::size_t vertices = 10'000;
constexpr std::uint32_t grid_columns = 64, grid_rows = 161;
constexpr double papers_milliseconds = 30;
constexpr std::size_t warm_up_frames = 3;

/// What each run took: milliseconds per frame.
using Times = std::vector<double>;

Times operator-(Times all, const Times& less) {
    for (std::size_t i = 0; i < all.size(); ++i) all[i] -= less[i];
    return all;
}

/// The mean of `frames` frames, milliseconds on the calling thread.
double mean_of(int frames, const std::function<void(std::size_t)>& frame) {
    for (std::size_t i = 0; i < warm_up_frames; ++i) frame(i);
    const double all = measure::nanoseconds_of(1, [&] {
        for (std::size_t i = 0; i < static_cast<std::size_t>(frames); ++i) frame(i);
    });
    return 1e-6 * all / frames;
}

/// The method as module paper has it: in double, one step after the other.
class StepByStep {
public:
    explicit StepByStep(const Tube& tube)
        : plain_({.length = Tube::length, .radius = Tube::radius}, grid_columns, grid_rows),
          wrinkled_({.length = Tube::length, .radius = Tube::radius, .folds = Tube::folds}, grid_columns,
                    grid_rows),
          positions_(tube.vertices.size()) {
        for (const paper::Cylindrical& vertex : tube.vertices) bound_.push_back(wrinkled_.bind(vertex));
    }

    void bend_bare(std::size_t frame) { bent_ = plain_.bend(pose(frame)); }
    void bend_wrinkled(std::size_t frame) { bent_ = wrinkled_.bend(pose(frame)); }
    void merge(std::size_t) {
        for (std::size_t i = 0; i < bound_.size(); ++i) positions_[i] = bent_.position(bound_[i]);
    }

private:
    static paper::Pose pose(std::size_t frame) {
        const bend::Pose pose = varied_pose(frame);
        return {double{pose.angle}, double{pose.direction}};
    }

    paper::Grid plain_, wrinkled_;
    std::vector<paper::GridVertex> bound_;
    paper::BentGrid bent_;
    std::vector<glm::dvec3> positions_;
};

/// goffer's kernel: base, wrinkle and merge in one pass, in float.
class OnePass {
public:
    explicit OnePass(const bend::Body& body) : memory_(6, body.vertex_count()) {
        job_.body = &body;
        job_.positions = planes(0);
    }

    void set_wrinkle_weight(float weight) { job_.wrinkle_weight = weight; }
    void set_normals() { job_.normals = planes(3); }
    void run(std::size_t frame) {
        job_.pose = varied_pose(frame);
        bend::run(job_);
    }

private:
    Stream3 planes(std::size_t first) {
        return planar(memory_[first], memory_[first + 1], memory_[first + 2]);
    }

    Columns memory_;
    bend::DeformJob job_;
};

struct AllTimes {
    Times bare_base, wrinkled_base, merge;             // of the method step by step
    Times bare_kernel, wrinkled_kernel, with_normals;  // of goffer's kernel
};

AllTimes measured(const FigurePlan& plan, const Tube& tube, const bend::Body& body) {
    AllTimes times;
    StepByStep steps(tube);
    OnePass bare(body), wrinkled(body), with_normals(body);
    bare.set_wrinkle_weight(0);
    with_normals.set_normals();
    for (int run = 0; run < plan.runs; ++run) {  // in turns, so that a busy moment hits all
        const auto take = [&](Times& into, const std::function<void(std::size_t)>& frame) {
            into.push_back(mean_of(plan.frames, frame));
        };
        take(times.bare_kernel, [&](std::size_t i) { bare.run(i); });
        take(times.wrinkled_kernel, [&](std::size_t i) { wrinkled.run(i); });
        take(times.with_normals, [&](std::size_t i) { with_normals.run(i); });
        take(times.bare_base, [&](std::size_t i) { steps.bend_bare(i); });
        take(times.wrinkled_base, [&](std::size_t i) { steps.bend_wrinkled(i); });
        take(times.merge, [&](std::size_t i) { steps.merge(i); });
    }
    return times;
}

class Rows {
public:
    Rows(Table& table, const FigurePlan& plan, std::size_t count)
        : table_(table), plan_(plan), count_(count) {}

    void add(const std::string& method, const std::string& step, const Times& times) {
        const auto [least, most] = std::ranges::minmax(times);
        table_.add({method, step, measure::median(times), least, most, static_cast<double>(plan_.runs),
                    static_cast<double>(plan_.frames), static_cast<double>(count_), papers_milliseconds});
    }

private:
    Table& table_;
    const FigurePlan& plan_;
    std::size_t count_;
};

Times sum(const Times& one, const Times& other) {
    Times all = one;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += other[i];
    return all;
}

std::string ms(const Table& t, std::size_t row) {
    return html(t, row, "milliseconds") + "&nbsp;ms";
}

/// `drawn`: whether there are rows about drawing.
std::vector<std::string> words(const Figure& figure, bool drawn, const std::string& device) {
    const Table& t = figure.table;
    const Table& all = *figure.summary;
    std::vector<std::string> text;
    text.push_back("A tube with a relief, " + html(t, 0, "vertices", Shown::whole) +
                   " vertices, one frame at a time; medians of " + html(t, 0, "runs", Shown::whole) +
                   " runs of " + html(t, 0, "frames", Shown::whole) +
                   " frames each, every frame in a pose of its own, on one thread. Mind that the scale is "
                   "logarithmic. The dashed line is what the paper reports for a "
                   "frame with as many vertices, drawing included: " +
                   html(t, 0, "paper_milliseconds", Shown::whole) + "&nbsp;ms, on a machine of its time.");
    text.push_back(
        "Step by step is the method as module <code>paper</code> has it, in double: the base grid (" +
        html(all, 0, "grid_columns", Shown::whole) + " &times; " + html(all, 0, "grid_rows", Shown::whole) +
        " vertices, on three shells) is bent in " + ms(t, 0) + "; its wrinkles take " + ms(t, 1) +
        " more, since equation 7 is solved for every column in every frame, without a table; and the merge, "
        "which puts the radial difference of every "
        "vertex back by trilinear interpolation, takes " +
        ms(t, 2) +
        ". That module is written to be read and to be compared with, not for speed. In total, without "
        "drawing, " +
        html(all, 0, "milliseconds") + "&nbsp;ms.");
    text.push_back(
        "goffer&rsquo;s kernel has no separate merge: it takes every vertex of the mesh through base "
        "deformation and merge "
        "in the same pass, in float, in " +
        ms(t, drawn ? 4 : 3) + " for positions (measured with a wrinkle weight of 0). Wrinkles add " +
        ms(t, drawn ? 5 : 4) + " (with them less without), normals, which step by step does not make, " +
        ms(t, drawn ? 6 : 5) + ". In total, without normals and drawing, " + html(all, 1, "milliseconds") +
        "&nbsp;ms, " + html(all, 1, "times_as_fast") + " times as fast as step by step.");
    text.push_back(drawn ? "Drawing is the same for both, by the wall clock in " + ms(t, 3) +
                               ": vertices go to OpenGL, and a picture of " +
                               html(all, 0, "drawn_width", Shown::whole) + " &times; " +
                               html(all, 0, "drawn_height", Shown::whole) +
                               " pixels is drawn and waited for, on <i>" + html_text(device) + "</i>" +
                               (device.find("llvmpipe") != std::string::npos ||
                                        device.find("softpipe") != std::string::npos
                                    ? ", which is a software renderer: the processor draws."
                                    : ".")
                         : "There is no bar for drawing: " + html_text(device) + ".");
    return text;
}

constexpr const char* timing_script = R"gp(set logscale y
set yrange [0.0003:100]
set ylabel "ms per frame"
set boxwidth 0.75
set style fill solid
set xtics rotate by -35
set key outside top center maxcols 1
position(i) = i + (strcol("method") eq "goffer" ? 0.7 : 0)
plot data using (position($0)):(strcol("method") eq "goffer" ? NaN : column("milliseconds")):xticlabels(strcol("step")) \
         with boxes lc rgb "#d55e00" title "step by step, in double", \
     data using (position($0)):(strcol("method") eq "goffer" ? column("milliseconds") : NaN):xticlabels(strcol("step")) \
         with boxes lc rgb "#0072b2" title "goffer, in one pass", \
     data using (position($0)):(column("fastest")):(0):(column("slowest") - column("fastest")) \
         with vectors nohead lw 1.5 lc rgb "#333333" notitle, \
     data using (position($0)):(column("slowest") * 1.6):(sprintf("%.2g", column("milliseconds"))) with labels font ",13" notitle, \
     data using (position($0)):(column("paper_milliseconds")) with lines dt 2 lw 1.5 lc rgb "#333333" title "the paper, all steps"
)gp";

}  // namespace

Figure timing_figure(Workshop& workshop, std::string& device) {
    const FigurePlan& plan = workshop.plan;
    Figure figure{.name = "figure_9",
                  .title = "Figure 9: the time of each step of a frame",
                  .table = Table({"method", "step", "milliseconds", "fastest", "slowest", "runs", "frames",
                                  "vertices", "paper_milliseconds"}),
                  .summary = Table({"method", "milliseconds", "times_as_fast", "grid_columns", "grid_rows",
                                    "drawn_width", "drawn_height"})};
    const Progress progress("timing the steps of a frame");
    const Tube tube(vertices);
    const bend::Body body = tube.body();
    const AllTimes times = measured(plan, tube, body);
    const auto drawing = drawing_times(body, tube.triangles, varied_pose, plan.runs, plan.frames, device);

    Rows rows(figure.table, plan, tube.vertices.size());
    rows.add("step by step", "base deformation", times.bare_base);
    rows.add("step by step", "wrinkle", times.wrinkled_base - times.bare_base);
    rows.add("step by step", "merge", times.merge);
    if (drawing) rows.add("step by step", "drawing", *drawing);
    rows.add("goffer", "base and merge", times.bare_kernel);
    rows.add("goffer", "wrinkle", times.wrinkled_kernel - times.bare_kernel);
    rows.add("goffer", "normals", times.with_normals - times.wrinkled_kernel);
    if (drawing) rows.add("goffer", "drawing", *drawing);

    const double slow = measure::median(sum(times.wrinkled_base, times.merge));
    const double fast = measure::median(times.wrinkled_kernel);
    for (const auto& [method, milliseconds] : {std::pair("step by step", slow), {"goffer", fast}})
        figure.summary->add({std::string(method), milliseconds, slow / milliseconds, double{grid_columns},
                             double{grid_rows}, double{drawn_width}, double{drawn_height}});
    figure.paragraphs = words(figure, drawing.has_value(), device);
    figure.script = timing_script;
    return figure;
}

}  // namespace goffer::cli
