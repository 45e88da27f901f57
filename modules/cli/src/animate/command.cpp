// SPDX-License-Identifier: MIT
#include "animate/request.hpp"
#include "commands.hpp"
#include "suitability.hpp"
#include "threads.hpp"

#include <goffer/io/read_file.hpp>
#include <goffer/measure/timer.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

namespace goffer::cli {
namespace {

void report_motion(Report& report, const AnimateRequest& request, const AnimateOptions& options,
                   const Survey& survey, const BoundModel& model) {
    const double reached = degrees(*std::ranges::max_element(survey.largest));
    // A glTF lasts from its first key to its last; in all else, each frame is shown for its time.
    const double seconds = static_cast<double>(request.frames - (request.gltf_wanted ? 1 : 0)) / options.fps;
    nlohmann::ordered_json& json = report.json;
    json["regions"] = model.binding.body.region_count();
    json["frames"] = request.frames;
    json["fps"] = options.fps;
    json["seconds"] = seconds;
    json["repeats"] = request.motion->repeats();
    json["reached_angle"] = reached;
    json["clamped_frames"] = survey.clamped;
    json["frames_beyond_full_turn"] = survey.beyond_full_turn;
    json["path_error"] = survey.path_error;
    json["worst_area_change"] = survey.worst_area_change;
    json["worst_area_frame"] = survey.worst_frame + 1;
    json["deform_ms"] = survey.milliseconds;
    report.line("frames", std::to_string(request.frames) + " at " + number(options.fps) +
                              " a second: " + number(seconds) + " s");
    report.line("bends to", number(reached) + " degrees" + (survey.largest.size() > 1 ? " of a region" : ""));
    if (bent_at_rest(model.binding.body) && options.swing && !options.from_rest)
        report.line("angles", "are absolute: 0 is straight, and " + rest_words(model.binding.body) +
                                  " is the shape of the file; to swing from there, use --from-rest");
    if (survey.path_error > 0)
        report.line("path", "the center line is within " + number(survey.path_error) + " of it" +
                                (survey.path_error > model.cylinder.radius
                                     ? ", which is beyond the radius: more --regions come closer"
                                     : ""));
    report.line("area change", "at most " + percent(survey.worst_area_change) + ", in frame " +
                                   std::to_string(survey.worst_frame + 1));
    if (bent_at_rest(model.binding.body))
        warn_of_stretch(
            report, survey.worst_area_change, " in frame " + std::to_string(survey.worst_frame + 1),
            options.swing && !options.from_rest ? "; to swing from the shape of the file, use --from-rest"
                                                : "");
    if (survey.clamped > 0)
        report.warn("in " + counted(survey.clamped, "frame") +
                    " a region is asked to bend further than it can, and is bent as far as it can");
    if (survey.beyond_full_turn > 0)
        report.warn("in " + counted(survey.beyond_full_turn, "frame") + " it bends by " + full_turn_words);
    if (!model.baked) {
        const BindRequest bound(options.bind, request.regions);
        warn_of_folds(report, bound, model, survey.largest);
    }
}

void report_written(Report& report, const AnimateOptions& options, const AnimateRequest& request,
                    std::uint64_t bytes, double milliseconds) {
    const double each = milliseconds / static_cast<double>(request.frames);
    report.json["output"] = options.output.string();
    report.json["bytes"] = bytes;
    report.json["ms_per_frame"] = each;
    report.line("time", number(report.json["deform_ms"].get<double>()) + " ms to deform a frame, " +
                            number(each) + " ms to write it");
    report.line("written", options.output.string() + ", " + request.writer->what + ": " +
                               number(static_cast<double>(bytes) * 1e-6) + " MB");
}

/// What was written, in all.
std::uint64_t bytes_of(const AnimateRequest& request, io::AtomicFiles& outputs) {
    std::uint64_t bytes = outputs.bytes();
    for (std::size_t frame = 0; request.pattern && frame < request.frames; ++frame)
        bytes += io::size_of_file(request.pattern->file(frame));
    return bytes;
}

void run_animate(const AnimateOptions& options) {
    ModelFile file(options.model, options.bind.load.limits);
    const AnimateRequest request(options, file);
    BindRequest bind(options.bind, request.regions);
    bind.with_uvs = request.with_uvs;
    const Isa isa = parse_isa_option(options.isa);
    Report report(options.json);
    const BoundModel model = bind_model(std::move(file), bind);
    if (options.lag != 0 && model.binding.body.region_count() == 1)
        throw UsageError("--lag: the body has one region, which follows none; give --regions too");
    MovingModel frames(model, *request.motion, request.frames, options.fps, isa);
    if (request.pattern) request.pattern->check_places(request.frames);
    const Survey seen = survey(frames, request.pictures ? &*request.pictures : nullptr);
    report_model(report, options.model, model.mesh, seen.area_before);
    if (!model.baked) report_suitability(report, model);
    if (model.growth) report_growth(report, *model.growth);
    report_motion(report, request, options, seen, model);
    io::AtomicFiles outputs;
    Animation animation{frames,
                        seen,
                        options.output,
                        request.pattern,
                        request.picture,
                        options.bind.load.limits,
                        request.gltf,
                        options.max_error.has_value(),
                        usable_threads(options.threads),
                        outputs,
                        report};
    const double taken = measure::nanoseconds_of(
        measure::wall_clock, [&] { in_file(options.model, [&] { request.writer->write(animation); }); });
    report_written(report, options, request, bytes_of(request, outputs), 1e-6 * taken);
    report.finish(outputs);
}

constexpr const char* keys_help =
    "Keys are JSON: {\"interpolation\": \"smooth\", \"repeat\": false, \"keys\": [{\"time\": 0, \"angle\": "
    "0},\n"
    "{\"time\": 1.5, \"angles\": [40, -60], \"directions\": [0, 90]}, ..]}: seconds, degrees, \"max\"; one "
    "\"angle\"\n"
    "is shared by regions. Instead of angles each key may have a \"path\" that the body lies on. Or they "
    "are\n"
    "a table with a first line: time,angle,direction or time,angle1,direction1,angle2,direction2,..\n"
    "\"angles_count_from\": \"rest\" beside \"keys\" adds the angles to the shape of the file.\n\n";

constexpr const char* output_help =
    "\n\n-o decides what is written: NAME.glb or .gltf, in which few shapes are blended to all frames; a "
    "point\n"
    "cache NAME.mdd or .pc2, of the model's vertices in their order; NAME.json, a vertex-animation texture\n"
    "with its images beside it; or a model or a picture for each frame, of a name with %04d, which becomes\n"
    "the frame's number from 1. Files with these numbers are replaced, one by one; the command stops if\n"
    "there are files of the same pattern with other numbers. Ended early, it leaves only whole frames.\n"
    "Frames are not kept: as many are in memory at a time as --max-memory has room for beside the model,\n"
    "and at most one a thread; animated glTF compares frames, and keeps what half of it holds.";

}  // namespace

void add_animate(CLI::App& app, Action& action) {
    const auto options = std::make_shared<AnimateOptions>();
    CLI::App* command = app.add_subcommand(
        "animate", "Move a model, and write that as animated glTF, a point cache, a texture, or frames");
    command->add_option("model", options->model, "Model: .glb, .gltf, .obj, .ply, .stl, or a body file")
        ->required();
    command
        ->add_option(
            "-o,--output", options->output,
            "Write it here: .glb, .gltf, .mdd, .pc2, .json (a vertex-animation texture), NAME_%04d.obj "
            "(.ply, .stl, .glb, .gltf) or NAME_%04d.png")
        ->required();
    command->footer(keys_help + std::string(path_help) + output_help);
    add_motion_words(*command, *options);
    add_bind_words(*command, options->bind);
    add_refine_word(*command, options->bind, "auto");
    options->bind.choices.push_back(command->get_option("--regions"));
    add_level_word(*command, options->bind.level);
    command
        ->add_option("--max-error", options->max_error,
                     "Blend as many shapes in animated glTF as it takes for no vertex to be off by more than "
                     "this, per cent of the model's size [" +
                         number(100 * usual_max_error) + ", as far as " + std::to_string(usual_targets) +
                         " shapes can]")
        ->check(number_within(0, 100, "a share in per cent"));
    command
        ->add_option(
            "--targets", options->targets,
            "Blend at most this many shapes in animated glTF; the report says how far off that is [" +
                std::to_string(usual_targets) + ", or with --max-error any number]")
        ->check(CLI::Range(std::size_t{1}, std::size_t{65535}));
    add_isa_word(*command, options->isa);
    add_threads_word(*command, options->threads);
    command->add_option("--size", options->size, "Make pictures WIDTHxHEIGHT pixels [1280x960]");
    command->add_option("--camera", options->camera,
                        "Look from: side, inner (onto the folds), front, or AZIMUTH,ELEVATION [0,35]; all "
                        "frames are seen from one place");
    add_json_word(*command, options->json);
    command->callback([options, command, &action] {
        action = [options, command] {
            check_path_words(options->path, *command);
            run_animate(*options);
        };
    });
}

}  // namespace goffer::cli
