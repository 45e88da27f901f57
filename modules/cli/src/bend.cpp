// SPDX-License-Identifier: MIT
#include "body_file.hpp"
#include "commands.hpp"
#include "deformed.hpp"
#include "local_area.hpp"
#include "model.hpp"
#include "motion/path_words.hpp"
#include "picture.hpp"
#include "poses.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "suitability.hpp"
#include "threads.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/fit/base.hpp>
#include <goffer/io/atomic_file.hpp>
#include <goffer/measure/timer.hpp>
#include <goffer/mesh/mesh.hpp>

#include <CLI/CLI.hpp>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace goffer::cli {
namespace {

struct BendOptions {
    std::filesystem::path model;
    std::filesystem::path output;
    PoseWords pose;
    PathOptions path;
    BindWords bind;
    std::filesystem::path fit;
    std::string isa = "auto";
    int threads = 0;
    PictureWords picture;
    std::optional<std::string> camera;
    bool ghost = false;
    std::string show;  ///< what the picture's colors stand for; empty: the model's own
    std::filesystem::path json;
};

/// Everything that can be refused by looking at the words alone, and at the regions of a body file.
struct Request {
    PoseRequest pose;
    BindRequest bind;
    Isa isa;
    int threads;
    PictureStyle style;

    Request(const BendOptions& options, std::vector<fit::RegionOptions> baked)
        : pose(options.pose, options.bind.fit.arcs, std::move(baked)),
          bind(options.bind, pose.regions),
          isa(parse_isa_option(options.isa)),
          threads(usable_threads(options.threads)) {
        pose.along_path = !options.path.file.empty();
        pose.by_default = pose.by_default && !pose.along_path;
        check_wanted(options.picture, options.ghost, "--ghost");
        check_wanted(options.picture, !options.show.empty(), "--show");
        check_wanted(options.picture, options.camera.has_value(), "--camera");
        if (!options.fit.empty() && bind.axis)
            throw UsageError("--axis: the axis is in the file of --fit; give one of them");
        if (options.path.scale != "fit") (void)read_path_scale(options.path.scale);
        check_places({{"MODEL", options.model}, {"--fit", options.fit}, {"--path", options.path.file}},
                     {{"-o", options.output}, {"--png", options.picture.file}, {"--json", options.json}},
                     options.bind.load.limits);
        if (options.output.empty() && options.picture.file.empty() && options.json.empty())
            throw UsageError("give -o, --png or --json; see goffer bend --help");
        if (!options.output.empty()) check_model_output(options.output);
        style.settings = picture_settings(options.picture);
        if (options.camera) style.viewpoint = parse_camera(*options.camera);
        style.ghost = options.ghost;
    }
};

/// The deformed records and how long they took.
struct Deformed {
    mesh::VertexArrays records;
    double microseconds = 0;
};

Deformed deform(const BoundModel& model, const Request& request, std::span<const bend::Pose> poses,
                const glm::mat4x3& transform) {
    Deformed result;
    const bend::DeformJob job = job_into(result.records, model, poses, request.isa, transform);
    tbb::task_arena arena(request.threads);
    std::vector<double> times(9);  // the first run also pays for memory that was never touched
    for (double& time : times) {
        time = measure::nanoseconds_of(request.threads,
                                       [&] { arena.execute([&] { bend::run_parallel(job); }); });
    }
    result.microseconds = 1e-3 * measure::median(times);
    put_in_model_order(result.records, model.binding);
    return result;
}

/// A fit of another model can hold this one in a corner of itself.
void warn_of_foreign_fit(Report& report, const BoundModel& model) {
    std::vector<double> heights = fit::heights(model.rest.positions, model.cylinder);
    for (double& height : heights) height = std::clamp(height, 0.0, model.cylinder.length);
    const auto [lowest, highest] = std::ranges::minmax(heights);
    const double taken = (highest - lowest) / model.cylinder.length;
    constexpr double least = 0.5;
    if (taken >= least) return;
    report.warn("the mesh takes up " + number(100 * taken) +
                " % of the length of --fit; is it the fit of this model?");
}

/// What it costs that a part of the body stays smooth: said of --wrinkle-range and --wrinkle-mask together.
void report_smooth(Report& report, const Request& request, const BoundModel& model,
                   std::span<const glm::vec3> positions) {
    const fit::WrinkleRange range = request.bind.options.wrinkle_range;
    const std::optional<std::string>& mask = request.bind.words.wrinkle_mask;
    const std::vector<std::uint32_t> within =
        fit::triangles_within(geometry_of(model), model.cylinder, range);
    const double inside = fit::surface_area(model.rest.positions, within);
    const double outside = fit::surface_area(model.rest.positions, model.rest.triangles) - inside;
    const double bent_inside = fit::surface_area(positions, within);
    const double bent_outside = fit::surface_area(positions, model.rest.triangles) - bent_inside;
    const double change = inside > 0 ? bent_inside / inside - 1 : 0;
    const double cost = outside > 0 ? bent_outside / outside - 1 : 0;
    nlohmann::ordered_json said;
    if (!range.whole()) said["wrinkle_range"] = {{"first", range.first}, {"last", range.last}};
    if (mask) said["wrinkle_mask"] = {{"channel", *mask}};
    for (auto& [word, json] : said.items()) {
        json["area_change_inside"] = change;
        json["area_change_outside"] = cost;
        report.json[word] = json;
    }
    const std::string stretch = number(range.first) + " to " + number(range.last) + " of the length";
    const std::string where = !mask ? stretch : range.whole() ? *mask : *mask + ", " + stretch;
    report.line(mask ? "wrinkle mask" : "wrinkle range",
                where + ": area " + percent(change) + " there, " + percent(cost) + " elsewhere");
}

/// Whether nobody said how to wrinkle, so that area is to be kept.
bool keeps_area(const Request& request, const BoundModel& model) {
    const BindRequest& bind = request.bind;
    return !model.baked && !bind.words.folds && bind.words.amplitude == "mesh" && !bind.mask_channel &&
           bind.options.wrinkle_range.whole();
}

/// Likewise, so that it is to be kept in every place.
bool keeps_area_everywhere(const Request& request, const BoundModel& model) {
    const BindWords& words = request.bind.words;
    return keeps_area(request, model) && words.profile == "even" && !words.fold_length && !words.onset &&
           words.shape == "auto" && !words.roundness;
}

/// Returns whether the area is not kept, and says so. `few_folds`: a warning says so of the folds, and how to
/// mend that.
bool warn_of_area(Report& report, double change, bool few_folds, bool one_region) {
    constexpr double most = 0.01;
    if (change >= -most) return false;
    std::string line = "the area changes by " + percent(change) + ", which ";
    line += few_folds ? "so few folds do not make up for"
                      : "the wrinkles do not make up for; say how many folds there are with --folds";
    if (!few_folds && one_region) line += ", or cut the body into --regions";
    report.warn(line);
    return true;
}

/// The area may be kept in all, and change here and there. Where the body is bent at rest, that may be why.
void warn_of_patches(Report& report, const BoundModel& model, const fit::PatchChange& change, bool shown) {
    constexpr double most = 0.12;  // what looked odd among some sixty models changed by more
    const bool straight = model.cylinder.rest_angle == 0 && model.cylinder.arcs.empty();
    if (straight && change.rms > most)
        report.warn(
            "the area is kept in all, but changes by " + number(std::round(100 * change.rms)) +
            " % from place to place (rms), as where legs, fins or leaves are bent with what they grow "
            "from" +
            (shown ? "" : "; --png with --show area colors where"));
}

/// What straightens a body less that is bent to and fro at rest, as an S is, where nobody said which way.
std::string less_stretch(const PoseRequest& request, const bend::Body& body) {
    const bool said = std::ranges::any_of(request.directions, [](const auto& d) { return d.has_value(); });
    if (said || request.along_path || !counts_from_rest(request, body) || !is_chain(body)) return {};
    const double across = std::remainder(std::round(rest_direction(body)) + 90, 360.0);
    return "; --direction " + number(across) + ", across that, straightens it less";
}

/// Returns whether it is known why the area may change: it was chosen to, or a warning says so.
bool report_bend(Report& report, const Request& request, const BoundModel& model,
                 const std::vector<Target>& targets, const Deformed& bent, double area_before) {
    const fit::Binding& binding = model.binding;
    std::vector<double> used;
    for (std::size_t r = 0; r < binding.regions.size(); ++r)
        used.push_back(used_angle(binding.body, r, targets[r].pose));
    const double area_after = fit::surface_area(bent.records.positions, bent.records.triangles);
    std::optional<double> base_change;
    if (!model.baked) base_change = fit::base_area_change(binding, used);
    nlohmann::ordered_json& json = report.json;
    const bool straightened = report_poses(report, request.pose, targets, model);
    if (!model.baked) {
        json["amplitude"] = request.bind.words.amplitude;
        json["profile"] = request.bind.words.profile;
    }
    json["area_before"] = area_before;
    json["area_after"] = area_after;
    json["base_area_change"] = base_change ? nlohmann::ordered_json(*base_change) : nullptr;
    if (!model.baked) json["bind_ms"] = binding.milliseconds;
    json["deform_us"] = bent.microseconds;
    json["isa"] = name(resolve(request.isa));
    json["threads"] = request.threads;

    report.line("area change", percent(area_after / area_before - 1) + " of the mesh" +
                                   (base_change ? ", " + percent(*base_change) + " of its base" : ""));
    if (!request.bind.options.wrinkle_range.whole() || request.bind.mask_channel)
        report_smooth(report, request, model, bent.records.positions);
    const std::string bind = model.baked ? "" : number(binding.milliseconds) + " ms to bind, ";
    report.line("time", bind + number(bent.microseconds) + " us to deform (" +
                            std::string(name(resolve(request.isa))) +
                            ", threads: " + std::to_string(request.threads) + ")");
    const bool few_folds = !model.baked && warn_of_folds(report, request.bind, model, used);
    const double change = area_after / area_before - 1;
    if (straightened) warn_of_stretch(report, change, {}, less_stretch(request.pose, binding.body));
    if (straightened || !keeps_area(request, model)) return true;
    return warn_of_area(report, change, few_folds, targets.size() == 1) || few_folds;
}

void run_bend(const BendOptions& options) {
    ModelFile file(options.model, options.bind.load.limits);
    const bool along_path = !options.path.file.empty();
    const Request request(options, along_path && !file.baked ? regions_for_path() : baked_regions(file));
    Report report(options.json);
    const BoundModel model = bind_model(std::move(file), request.bind, options.fit);
    const bend::Body& body = model.binding.body;
    const Laid laid =
        along_path ? lay(body, options.path) : Laid{.targets = targets_on(body, request.pose), .fit = {}};
    const std::vector<Target>& targets = laid.targets;
    const std::vector<bend::Pose> poses = poses_of(targets);
    const Deformed bent = deform(model, request, poses, laid.fit.transform);

    const double area_before = fit::surface_area(model.rest.positions, model.rest.triangles);
    report_model(report, options.model, model.mesh, area_before);
    if (!model.baked) report_fit(report, model.cylinder);
    const bool suitable = model.baked || !report_suitability(report, model);
    if (model.growth) report_growth(report, *model.growth);
    const bool explained = report_bend(report, request, model, targets, bent, area_before) || !suitable;
    if (along_path) report_path(report, laid, options.path);
    const fit::PatchChange change = in_file(
        options.model, [&] { return report_local_area(report, model, poses, bent.records.positions); });
    if (!explained && keeps_area_everywhere(request, model))
        warn_of_patches(report, model, change, !options.show.empty());
    if (!options.fit.empty()) warn_of_foreign_fit(report, model);
    io::AtomicFiles outputs;
    if (const std::filesystem::path& png = options.picture.file; !png.empty()) {
        Progress progress("rendering " + png.string());
        PictureStyle style = request.style;
        style.settings.progress = progress.listener();
        const bool show = !options.show.empty();
        const std::vector<glm::vec4> colors = show ? area_colors(model, bent.records.positions)
                                                   : vertex_colors(model.mesh, model.rest, plain_color(0));
        const Textures textures = show ? Textures{} : textures_of(model.mesh, options.bind.load.limits);
        for (const std::string& warning : textures.warnings) report.warn(warning);
        write_picture({body, model.mesh, model.rest, bent.records.positions, bent.records.normals, colors,
                       textures, poses, laid.fit.transform},
                      style, png, outputs);
        if (show) report_area_colors(report);
        report.line("picture", png.string());
    }
    if (!options.output.empty()) {
        mesh::save(mesh::with_vertex_arrays(model.mesh, bent.records), options.output, outputs);
        report.line("written", options.output.string());
    }
    report.finish(outputs);
}

}  // namespace

void add_bend(CLI::App& app, Action& action) {
    const auto options = std::make_shared<BendOptions>();
    CLI::App* command = app.add_subcommand("bend", "Bend a model, and write it, a picture of it or a report");
    command->add_option("model", options->model, "Model: .glb, .gltf, .obj, .ply, .stl, or a body file")
        ->required();
    command->add_option(
        "-o,--output", options->output,
        "Write the model here, with one of these endings; may be left out beside --png or --json");
    command->footer(
        "Angles are absolute: 0 is straight, whatever shape the model has in its file. One that is\n"
        "bent there gets that shape back from the angle and direction that 'goffer inspect' reports\n"
        "(a chain of N arcs from --arcs N, and these for each), or from --by 0; --by 30 bends it by 30\n"
        "degrees more. Without a word on how far, it is bent by 90 degrees more, or as far as it can.\n"
        "Angles beyond the largest are clamped.\n\n" +
        std::string(path_help));
    add_pose_words(*command, options->pose);
    add_path_words(*command, options->path);
    for (const char* option : {"--angle", "--angles", "--by", "--direction", "--directions"})
        command->get_option("--path")->excludes(option);
    command
        ->add_option("--path-start", options->path.start,
                     "Put the base this far along the path, in the model's units [0]")
        ->check(number_within(0, 1e9, "a length"));
    add_bind_words(*command, options->bind);
    add_refine_word(*command, options->bind, "auto");
    command->add_option("--fit", options->fit,
                        "Take the base cylinder from a report of 'goffer inspect --json'");
    add_level_word(*command, options->bind.level);
    for (const char* option : {"--fit", "--regions"})
        options->bind.choices.push_back(command->get_option(option));
    add_isa_word(*command, options->isa);
    add_threads_word(*command, options->threads);
    add_picture_words(*command, options->picture, "");
    command->add_option("--camera", options->camera,
                        "Look at it from: side, inner (onto the folds), front, or AZIMUTH,ELEVATION [0,35]");
    command->add_flag("--ghost", options->ghost, "Show the rest shape in the picture too, translucent");
    command
        ->add_option("--show", options->show,
                     "Color the picture by: area (its change at every vertex; blue: smaller, red: larger)")
        ->check(CLI::IsMember({"area"}));
    add_json_word(*command, options->json);
    command->callback([options, command, &action] {
        action = [options, command] {
            check_path_words(options->path, *command);
            run_bend(*options);
        };
    });
}

}  // namespace goffer::cli
