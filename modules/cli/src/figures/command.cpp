// SPDX-License-Identifier: MIT
#include "body_file.hpp"
#include "commands.hpp"
#include "figures/bending.hpp"
#include "figures/charts.hpp"
#include "figures/figure.hpp"
#include "figures/folder.hpp"
#include "figures/machine.hpp"
#include "figures/page.hpp"
#include "model.hpp"
#include "picture.hpp"
#include "poses.hpp"
#include "threads.hpp"

#include <goffer/io/atomic_file.hpp>
#include <goffer/measure/timer.hpp>

#include <CLI/CLI.hpp>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace goffer::cli {
namespace {

struct FiguresOptions {
    std::vector<std::filesystem::path> models;
    std::filesystem::path folder;
    std::string size = "640x480";
    bool quick = false;
    int threads = 0;
    bool no_charts = false;
    mesh::LoadOptions load;
    std::filesystem::path json;
};

/// As `goffer bend` has it, or `goffer bend --paper`.
BindRequest request_for(const FiguresOptions& options, bool paper) {
    BindWords words;
    words.load = options.load;
    words.refine = "auto";
    words.paper = paper;
    return BindRequest(words).with_one_arc();
}

void check_words(const FiguresOptions& options) {
    constexpr std::size_t most_models = 8;
    if (options.models.size() > most_models)
        throw UsageError("figures: " + counted(options.models.size(), "model") + "; give " +
                         std::to_string(most_models) + " at most");
    std::vector<NamedFile> inputs;
    for (const std::filesystem::path& model : options.models) inputs.push_back({"MODEL", model});
    check_places(inputs, {{"-o", options.folder / "index.html"}, {"--json", options.json}},
                 options.load.limits);
    if (options.json.empty() || options.json == "-") return;
    if (lies_in(options.json, options.folder))
        throw UsageError("--json: '" + options.json.string() +
                         "' lies in the page's folder; give it another place");
}

/// The model by one of the two methods. Says what there is to warn of, for the largest angle of its pictures.
BoundModel bound(const FiguresOptions& options, const FigurePlan& plan, const std::filesystem::path& file,
                 bool paper, Report& report) {
    const BindRequest request = request_for(options, paper);
    BoundModel model = bind_model(file, request);
    const std::string where = file.filename().string() + (paper ? ", by --paper: " : ": ");
    const double largest = std::min(plan.model_angles.back(), largest_by(model.binding.body));
    const std::array angles{used_angle(model.binding.body, 0, pose_by(model.binding.body, largest))};
    if (!paper)
        for (const std::string& warning : model.mesh.warnings) report.warn(where + warning);
    warn_of_folds(report, request, model, angles, where);
    return model;
}

std::vector<Figure> make_figures(const FiguresOptions& options, Workshop& workshop, Report& report,
                                 std::string& device) {
    // Models first: one that cannot be read ends the command at once.
    std::vector<Figure> papers, own;
    for (std::size_t i = 0; i < options.models.size(); ++i) {
        const std::filesystem::path& file = options.models[i];
        const BoundModel by_paper = bound(options, workshop.plan, file, true, report);
        const BoundModel by_goffer = bound(options, workshop.plan, file, false, report);
        const int number = 7 + static_cast<int>(i);
        if (i == 0) own.push_back(area_figure(workshop, by_goffer));
        (number <= 8 ? papers : own)
            .push_back(model_figure(workshop, by_paper, by_goffer, number, options.load.limits));
    }
    std::vector<Figure> figures;
    const auto add_all = [&](std::vector<Figure>& some) {
        for (Figure& figure : some) figures.push_back(std::move(figure));
    };
    figures.push_back(base_grid_figure(workshop, false));
    figures.push_back(base_grid_figure(workshop, true));
    add_all(papers);
    figures.push_back(timing_figure(workshop, device));
    figures.push_back(fold_figure());
    add_all(own);
    figures.push_back(vertices_figure(workshop));
    figures.push_back(instances_figure(workshop));
    return figures;
}

Table machine_table(const Workshop& workshop, const std::string& device) {
    Table table({"what", "value"});
    const Isa isa = resolve(Isa::automatic);
    table.add({"processor", processor_name()});
    table.add({"kernels", std::string(name(isa))});
    table.add({"AVX-512 used", isa == Isa::avx512 ? "yes" : "no"});
    table.add({"threads", static_cast<double>(workshop.threads)});
    table.add({"OpenGL", device});
    return table;
}

/// Adds a figure's files; returns their names.
std::vector<std::string> write_figure(const Workshop& workshop, const Figure& figure, bool charts) {
    std::vector<std::string> names;
    const auto add = [&](const std::string& name, const std::string& text) {
        workshop.files.add(workshop.folder / name).write(text);
        names.push_back(name);
    };
    add(figure.name + ".csv", figure.table.csv());
    if (figure.summary) add(figure.name + "_summary.csv", figure.summary->csv());
    if (!figure.script.empty()) add(figure.name + ".gp", chart_script(figure));
    if (!figure.script.empty() && charts) add(figure.name + ".svg", drawn_chart(figure));
    for (const auto& row : figure.pictures)
        for (const FigurePicture& picture : row) names.push_back(picture.file);
    return names;
}

void report_figure(Report& report, const Figure& figure, const std::vector<std::string>& files) {
    report.json["figures"].push_back({{"name", figure.name},
                                      {"title", figure.title},
                                      {"files", files},
                                      {"table", figure.table.json()},
                                      {"summary", figure.summary ? figure.summary->json() : nullptr}});
    report.line(figure.name, figure.title);
}

std::string names_of(const std::vector<std::filesystem::path>& models) {
    std::string names;
    for (const std::filesystem::path& model : models)
        names += (names.empty() ? "" : ", ") + model.filename().string();
    return names;
}

void run_figures(const FiguresOptions& options) {
    const view::Settings picture = parse_size(options.size);
    const int threads = usable_threads(options.threads);
    check_words(options);
    for (const std::filesystem::path& model : options.models) refuse_body_file(model);
    if (!options.no_charts) check_gnuplot();
    Report report(options.json);
    PageFolder folder(options.folder);
    check_output(folder.path() / "index.html");

    io::AtomicFiles files;
    Workshop workshop{options.quick ? FigurePlan::sparing() : FigurePlan{}, picture, threads, folder.path(),
                      files};
    std::string device;
    std::vector<Figure> figures;
    const double nanoseconds = measure::nanoseconds_of(measure::wall_clock, [&] {
        tbb::task_arena(threads).execute([&] { figures = make_figures(options, workshop, report, device); });
    });

    const Table machine = machine_table(workshop, device);
    report.json["folder"] = folder.path().string();
    report.json["quick"] = options.quick;
    report.json["charts"] = !options.no_charts;
    report.json["machine"] = machine.json();
    report.json["seconds"] = 1e-9 * nanoseconds;
    std::vector<std::string> names{"index.html", "machine.csv"};
    for (const Figure& figure : figures) {
        const std::vector<std::string> written = write_figure(workshop, figure, !options.no_charts);
        names.insert(names.end(), written.begin(), written.end());
        report_figure(report, figure, written);
    }
    files.add(folder.path() / "machine.csv").write(machine.csv());
    const PageFacts facts{names_of(options.models), options.quick, !options.no_charts, &machine};
    files.add(folder.path() / "index.html").write(page_text(figures, facts));
    report.line("time", number(1e-9 * nanoseconds) + " s");
    report.line("page", (folder.path() / "index.html").string());
    report.finish(files);
    folder.keep(names);
}

}  // namespace

void add_figures(CLI::App& app, Action& action) {
    const auto options = std::make_shared<FiguresOptions>();
    CLI::App* command = app.add_subcommand(
        "figures", "Make the paper's figures, and some of goffer's own: pictures, charts, data and a page");
    command->add_option("models", options->models, "Models, 1 to 8: .glb, .gltf, .obj, .ply or .stl")
        ->required();
    command
        ->add_option("-o,--output", options->folder,
                     "Write all files to this folder: a new or an empty one, or one of an earlier page")
        ->required();
    command->add_option("--size", options->size, "Make pictures WIDTHxHEIGHT pixels")->capture_default_str();
    command->add_flag("--quick", options->quick, "Take fewer poses, runs and sizes: times are rough");
    command->add_flag("--no-charts", options->no_charts,
                      "Draw no charts, for which gnuplot is needed; their scripts are written all the same");
    add_threads_word(*command, options->threads);
    add_load_words(*command, options->load);
    add_json_word(*command, options->json);
    command->callback([options, &action] { action = [options] { run_figures(*options); }; });
}

}  // namespace goffer::cli
