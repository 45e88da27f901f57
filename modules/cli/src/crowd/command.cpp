// SPDX-License-Identifier: MIT
#include "body_file.hpp"
#include "commands.hpp"
#include "crowd/crowd.hpp"
#include "crowd/render.hpp"
#include "crowd/timing.hpp"
#include "model.hpp"
#include "picture.hpp"
#include "poses.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "suitability.hpp"
#include "threads.hpp"

#include <goffer/io/atomic_file.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <span>
#include <vector>

namespace goffer::cli {
namespace {

struct CrowdOptions {
    std::vector<std::filesystem::path> models;
    std::size_t instances = 1000;
    std::size_t frames = 100;
    PoseWords pose;
    bool from_rest = false;
    BindWords bind;
    std::string streams = "planar";
    bool normals = false;
    std::string stores = "automatic";
    std::string isa = "auto";
    int threads = 0;
    PictureWords picture;
    std::filesystem::path json;
};

const measure::StreamLayout& parse_layout(const std::string& text, bool normals) {
    if (text == "packed") return measure::stream_layout(text);
    const std::string order = text == "interleaved" ? "interleaved-" : "";
    return measure::stream_layout(order + (normals ? "positions+normals" : "positions"));
}

bend::Stores parse_stores(const std::string& text) {
    if (text == "cached") return bend::Stores::cached;
    return text == "streaming" ? bend::Stores::non_temporal : bend::Stores::automatic;
}

/// Everything that can be refused by looking at the words alone, and at the regions of body files.
struct CrowdRequest {
    PoseRequest pose;
    std::vector<Target> targets;
    BindRequest bind;
    CrowdPlan plan;
    int threads;
    view::Settings picture;

    CrowdRequest(const CrowdOptions& options, std::vector<fit::RegionOptions> baked)
        : pose(options.pose, options.bind.fit.arcs, std::move(baked)),
          bind(BindRequest(options.bind, pose.regions).with_one_arc()),
          plan{.instances = options.instances,
               .poses = {},
               .from_rest = options.from_rest,
               .layout = parse_layout(options.streams, options.normals),
               .isa = parse_isa_option(options.isa),
               .stores = parse_stores(options.stores)},
          threads(usable_threads(options.threads)) {
        if (options.instances < options.models.size()) {
            throw UsageError("--instances: " + std::to_string(options.instances) + " are fewer than the " +
                             std::to_string(options.models.size()) + " models; give each one or more");
        }
        std::vector<NamedFile> inputs;
        for (const std::filesystem::path& model : options.models) inputs.push_back({"MODEL", model});
        check_places(inputs, {{"--png", options.picture.file}, {"--json", options.json}},
                     options.bind.load.limits);
        picture = picture_settings(options.picture);
    }

    /// Sets the targets and the plan's poses. The arcs of a chain share an angle by the lengths that they
    /// have in `body`, the first of the models.
    void set_targets(const bend::Body& body) {
        if (bind.words.fit.arcs > 0) pose.share_out(body);
        targets = targets_from_straight(pose);
        plan.poses = poses_of(targets);
    }
};

std::vector<BoundModel> bind_models(std::vector<ModelFile> files, const BindRequest& request) {
    std::vector<BoundModel> models;
    models.reserve(files.size());
    for (ModelFile& file : files) models.push_back(bind_model(std::move(file), request));
    return models;
}

/// Which of several models is meant, to begin a warning with.
std::string place_of(const BoundModel& model, std::span<const BoundModel> models) {
    return models.size() > 1 ? model.file.string() + ": " : "";
}

/// Warns of what a model's regions are asked for and cannot do.
void warn_of_regions(Report& report, const CrowdRequest& request, const BoundModel& model,
                     const std::string& where) {
    const bend::Body& body = model.binding.body;
    const std::vector<Target>& targets = request.targets;
    std::vector<double> used;
    for (std::size_t r = 0; r < targets.size(); ++r) {
        const double rest = request.plan.from_rest ? rest_pose(body, r).angle : 0;
        const double limit = degrees(static_cast<double>(body.max_angle(r)));
        const double asked = std::fabs(targets[r].angle) + rest;
        used.push_back(radians(std::min(asked, limit)));
        if (!is_beyond(asked, limit) || std::isinf(asked)) continue;
        std::string line = where + region_words(r, targets.size());
        const std::string then = "it is bent no further than that";
        if (rest == 0) {
            warn_of_angle(report, line, targets[r].angle, limit, then);
            continue;
        }
        line += number(std::fabs(targets[r].angle));
        line += " degrees from the rest pose, which is " + number(rest);
        line += ", are beyond the largest angle, " + number(limit);
        line += ", where some instances swing; " + then;
        report.warn(line);
    }
    if (!model.baked) warn_of_folds(report, request.bind, model, used, where);
}

/// Warns of a swing that goes round further than once. Returns whether it does.
bool warn_of_full_turn(Report& report, const CrowdRequest& request, const bend::Body& body,
                       const std::string& where) {
    std::vector<bend::Pose> poses = request.plan.poses;
    if (request.plan.from_rest) {
        // Each instance swings its own way: some, the way that the body is bent.
        const double toward = rest_direction(body);
        for (std::size_t r = 0; r < poses.size(); ++r)
            poses[r] =
                pose_from_rest(body, r, degrees(static_cast<double>(std::fabs(poses[r].angle))), toward, 1);
    }
    const bool beyond = beyond_full_turn(body, poses);
    if (beyond) report.warn(where + "at its ends the swing is " + full_turn_words);
    return beyond;
}

/// Warns of a swing that straightens a body which is bent at rest. Returns whether it does.
bool warn_of_straightening(Report& report, const CrowdRequest& request, const BoundModel& model,
                           const std::string& where) {
    const bool straightens = !request.plan.from_rest && bent_at_rest(model.binding.body);
    if (straightens)
        report.warn(where + "the body is bent at rest by " + rest_words(model.binding.body) +
                    ", and the swing straightens it; to swing from there, use --from-rest");
    return straightens;
}

void report_models(Report& report, const CrowdRequest& request, std::span<const BoundModel> models) {
    for (const BoundModel& model : models) {
        const bend::Body& body = model.binding.body;
        const std::string where = place_of(model, models);
        for (const std::string& warning : model.mesh.warnings) report.warn(where + warning);
        warn_of_regions(report, request, model, where);
        nlohmann::ordered_json regions;
        int folds = 0;
        double limit = 0;
        for (std::size_t r = 0; r < body.region_count(); ++r) {
            const double own = degrees(static_cast<double>(body.max_angle(r)));
            regions.push_back({{"folds", model.binding.folds(r)}, {"max_angle", own}});
            folds += model.binding.folds(r);
            limit += own;
        }
        report.json["models"].push_back(
            {{"file", model.file.string()},
             {"vertices", body.vertex_count()},
             {"folds", folds},
             {"max_angle", limit},
             {"regions", regions},
             {"straightens", warn_of_straightening(report, request, model, where)},
             {"beyond_full_turn", warn_of_full_turn(report, request, body, where)}});
        nlohmann::ordered_json& json = report.json["models"].back();
        if (!model.baked) report_suitability(report, model, json, where);
        report.line("model", model.file.string() + ", " + std::to_string(body.vertex_count()) +
                                 " vertices, " + counted(static_cast<std::size_t>(folds), "fold"));
        if (model.growth) report_growth(report, *model.growth, json);
    }
}

/// One decimal, and no sign.
std::string percentage(double fraction) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f %%", 100 * fraction);
    return text;
}

void report_crowd(Report& report, const CrowdOptions& options, const CrowdRequest& request,
                  const Crowd& crowd, const Timing& timing) {
    const auto bytes = static_cast<double>(crowd.scene().bytes());
    const double rate = bytes / timing.frame_median * 1e-6;
    const double floor = bytes / timing.fill_median * 1e-6;
    const double per_vertex = timing.frame_median * 1e6 / static_cast<double>(crowd.scene().vertices());
    const bool normals = request.plan.layout.normals || request.plan.layout.packed;
    const std::string isa(name(resolve(request.plan.isa)));
    const std::string hash = hex(crowd.scene().hash());

    nlohmann::ordered_json& json = report.json;
    json["instances"] = options.instances;
    json["vertices_per_frame"] = crowd.scene().vertices();
    json["bytes_per_frame"] = crowd.scene().bytes();
    json["frames"] = options.frames;
    json["threads"] = request.threads;
    json["isa"] = isa;
    json["streams"] = options.streams;
    json["normals"] = normals;
    json["stores"] = options.stores;
    for (const double angle : request.pose.angles)
        json["angles"].push_back(std::isfinite(angle) ? nlohmann::ordered_json(angle)
                                                      : nlohmann::ordered_json(angle > 0 ? "max" : "-max"));
    json["ms_median"] = timing.frame_median;
    json["ms_p99"] = timing.frame_p99;
    json["ns_per_vertex"] = per_vertex;
    json["gb_per_s"] = rate;
    json["floor_gb_per_s"] = floor;
    json["of_floor"] = rate / floor;
    json["allocations_per_frame"] = nullptr;
    if (timing.allocations) json["allocations_per_frame"] = *timing.allocations;
    json["clamped"] = timing.clamped;
    json["hash"] = hash;

    report.line("crowd", counted(options.instances, "instance") + ", " +
                             std::to_string(crowd.scene().vertices()) + " vertices a frame");
    report.line("output", options.streams + ", positions" + (normals ? " and normals" : "") + ", " +
                              number(bytes * 1e-6) + " MB a frame");
    report.line("kernels", isa + ", threads: " + std::to_string(request.threads));
    report.line("frames", number(1000 / timing.frame_median) + " per second");
    report.line("frame",
                number(timing.frame_median) + " ms (median), " + number(timing.frame_p99) + " ms (p99)");
    report.line("vertex", number(per_vertex) + " ns");
    report.line("written", number(rate) + " GB/s, " +
                               (rate > floor ? number(rate / floor) + " times the speed of the floor"
                                             : percentage(rate / floor) + " of the floor") +
                               ": a fill of as much past the cache, " + number(floor) + " GB/s" +
                               (rate > floor ? "; this fits the cache" : ""));
    if (timing.allocations) report.line("allocations", number(*timing.allocations) + " per frame");
}

void run_crowd(const CrowdOptions& options) {
    std::vector<ModelFile> files;
    files.reserve(options.models.size());
    for (const std::filesystem::path& model : options.models)
        files.emplace_back(model, options.bind.load.limits);
    CrowdRequest request(options, baked_regions(files));
    Report report(options.json);
    const std::vector<BoundModel> models = bind_models(std::move(files), request.bind);
    request.set_targets(models[0].binding.body);
    auto progress =
        std::make_unique<Progress>("deforming " + counted(options.frames, "frame"), options.frames);
    Crowd crowd(models, request.plan);
    const Timing timing = measure(crowd, options.frames, request.threads, *progress);
    progress.reset();
    report_crowd(report, options, request, crowd, timing);
    report_models(report, request, models);
    io::AtomicFiles outputs;
    if (const std::filesystem::path& file = options.picture.file; !file.empty()) {
        Progress rendering("rendering " + file.string());
        view::Settings settings = request.picture;
        settings.progress = rendering.listener();
        std::vector<Textures> textures;
        for (const BoundModel& model : models) {
            textures.push_back(textures_of(model.mesh, options.bind.load.limits));
            for (const std::string& warning : textures.back().warnings)
                report.warn(place_of(model, models) + warning);
        }
        const std::size_t shown = write_crowd_picture(crowd, models, textures, settings, file, outputs);
        report.line("picture",
                    file.string() + (shown == options.instances ? std::string()
                                                                : ", " + std::to_string(shown) + " of " +
                                                                      std::to_string(options.instances) +
                                                                      " instances, those in front"));
    }
    report.finish(outputs);
}

}  // namespace

void add_crowd(CLI::App& app, Action& action) {
    const auto options = std::make_shared<CrowdOptions>();
    CLI::App* command = app.add_subcommand(
        "crowd",
        "Bend a crowd of models, frame after frame, and say how fast that is, next to a fill of memory");
    command
        ->add_option("models", options->models,
                     "Models, about as many of each: .glb, .gltf, .obj, .ply, .stl, or body files")
        ->required();
    command->add_option("--instances", options->instances, "Bend this many instances, of all models together")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str();
    command->add_option("--frames", options->frames, "Measure this many frames")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str();
    add_angle_words(
        *command, options->pose,
        "Swing between straight and this many degrees; negative: the other way; max: as far as each "
        "model can");
    command->add_flag("--from-rest", options->from_rest,
                      "Swing from the rest pose by this many degrees, instead of from straight");
    options->bind.amplitude = "paper";  // the factors of `mesh` cost time in each frame
    add_bind_words(*command, options->bind);
    add_refine_word(*command, options->bind, "off");
    options->bind.choices.push_back(command->get_option("--regions"));
    add_level_word(*command, options->bind.level);
    command
        ->add_option(
            "--streams", options->streams,
            "Write: planar (x[] y[] z[]), interleaved (records of floats), packed (12 bytes a vertex)")
        ->check(CLI::IsMember({"planar", "interleaved", "packed"}))
        ->capture_default_str();
    command->add_flag("--normals", options->normals, "Write normals too; packed has them anyway");
    command
        ->add_option("--stores", options->stores,
                     "Write past the cache or into it: automatic, cached, streaming")
        ->check(CLI::IsMember({"automatic", "cached", "streaming"}))
        ->capture_default_str();
    add_isa_word(*command, options->isa);
    add_threads_word(*command, options->threads);
    add_picture_words(*command, options->picture, " of the last frame");
    add_json_word(*command, options->json);
    command->callback([options, &action] { action = [options] { run_crowd(*options); }; });
}

}  // namespace goffer::cli
