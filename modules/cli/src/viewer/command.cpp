// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "picture.hpp"
#include "report.hpp"
#include "viewer/viewer.hpp"

#include <goffer/io/atomic_file.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <utility>

namespace goffer::cli {
namespace {

struct ViewOptions {
    std::vector<std::filesystem::path> models;
    PoseWords pose;
    BindWords bind;
    int crowd = 0;
    bool shader = false;
    std::size_t frames = 0;
    std::string size = "1280x720";
    std::filesystem::path json;
    std::vector<const CLI::Option*> pose_options;

    [[nodiscard]] bool pose_said() const {
        return std::ranges::any_of(pose_options,
                                   [](const CLI::Option* option) { return option->count() > 0; });
    }
};

ViewerPlan plan_of(const ViewOptions& options, const glm::ivec2& size, const Loaded& loaded) {
    ViewerPlan plan;
    plan.size = size;
    plan.frames = options.frames;
    plan.controls.set_words(loaded.words);
    plan.controls.set_poses(loaded);
    plan.controls.instances = options.crowd;
    plan.controls.animated = options.crowd > 0;
    plan.controls.deformer = options.shader ? Deformer::shader : Deformer::processor;
    return plan;
}

void report_times(Report& report, const ViewOptions& options, const Stage& stage, const ViewerTimes& times) {
    nlohmann::ordered_json& json = report.json;
    json["instances"] = stage.instances();
    json["vertices_per_frame"] = stage.vertices();
    json["frames"] = times.frames;
    json["deformer"] = options.shader ? "shader" : "processor";
    json["device"] = times.device;
    json["ms"] = {{"set_up", times.deformation.set_up},
                  {"deform", times.deformation.deform},
                  {"upload", times.deformation.upload},
                  {"draw", times.draw ? nlohmann::ordered_json(*times.draw) : nullptr},
                  {"frame", times.frame}};
    report.line("crowd", counted(stage.instances(), "instance") + ", " + std::to_string(stage.vertices()) +
                             " vertices a frame");
    report.line("device", times.device);
    report.line(
        options.shader ? "set-up" : "deform",
        number(options.shader ? times.deformation.set_up : times.deformation.deform) + " ms (medians)");
    report.line("upload", number(times.deformation.upload) + " ms");
    if (times.draw) report.line("draw", number(*times.draw) + " ms");
    report.line("frame", number(times.frame) + " ms");
}

void run_view(const ViewOptions& options) {
    if (!options.json.empty() && options.frames == 0)
        throw UsageError("--json: is a report of times; add --frames N");
    const view::Settings size = parse_size(options.size);
    Window::check_display();
    Report report(options.json);
    const Wish wish{options.models, options.bind, options.pose, !options.pose_said()};
    auto loaded = std::make_unique<Loaded>(load(wish));
    const ViewerPlan plan = plan_of(options, {size.width, size.height}, *loaded);
    Viewer viewer(std::move(loaded), plan);
    const ViewerTimes times = viewer.run();
    if (options.frames == 0) return;
    report_times(report, options, viewer.stage(), times);
    io::AtomicFiles outputs;
    report.finish(outputs);
}

}  // namespace

void add_view(CLI::App& app, Action& action) {
    const auto options = std::make_shared<ViewOptions>();
    CLI::App* command = app.add_subcommand("view", "Bend models in a window, with the mouse and sliders");
    command->add_option("models", options->models,
                        "Models: .glb, .gltf, .obj, .ply, .stl, or body files (default: a bare cylinder); of "
                        "several, one body is the first, and a crowd has all");
    command->add_option("--crowd", options->crowd, "Show a crowd of this many instances, in motion")
        ->check(CLI::Range(0, 100'000));
    command->add_flag("--shader", options->shader, "Deform in the vertex shader, not on the processor");
    command->add_option("--size", options->size, "Make the window WIDTHxHEIGHT")->capture_default_str();
    command
        ->add_option("--frames", options->frames,
                     "Draw this many frames in motion, as fast as possible, say what they took, and end")
        ->check(CLI::Range(1, 10'000'000));
    add_pose_words(*command, options->pose);
    for (const char* option : {"--angle", "--by", "--angles"})
        options->pose_options.push_back(command->get_option(option));
    add_bind_words(*command, options->bind);
    add_refine_word(*command, options->bind, "auto");
    add_level_word(*command, options->bind.level);
    options->bind.choices.push_back(command->get_option("--regions"));
    add_json_word(*command, options->json);
    command->get_option("--json")->description(
        "With --frames, write a report as JSON (- for standard output)");
    command->footer(
        "A body that is bent in its file is shown as it is there, unless an angle is given.\n"
        "Drag: turn; with the right button: shift; wheel: zoom. Drag an orange end to bend. Files that are\n"
        "dropped on the window are opened. What the panel saves goes into the current folder.\n"
        "Keys: 1 to 9 choose a region; up, down: its angle, left, right: its direction (with Shift by "
        "less);\n"
        "Space: in motion; C: a crowd; D: deformed by processor or shader; L: look at all again. W, N, A, "
        "B,\n"
        "F, R: show wires, normals, change of area, base, frames, rest shape; F1: the panel. Ctrl+S, P, B: "
        "save\n"
        "model, picture, body file; Ctrl+C: copy the command; Ctrl+Q, Esc: close.");
    command->callback([options, &action] { action = [options] { run_view(*options); }; });
}

}  // namespace goffer::cli
