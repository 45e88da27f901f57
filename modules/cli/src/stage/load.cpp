// SPDX-License-Identifier: MIT
#include "stage/load.hpp"

#include "body_file.hpp"
#include "report.hpp"
#include "suitability.hpp"

#include <goffer/paper/base.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace goffer::cli {
namespace {

/// The base model, as `goffer base --caps` makes it.
BoundModel base_model() {
    BoundModel model;
    model.file = "base";
    model.mesh = mesh_of(paper::base_mesh(10, 1, 64, 161, true));
    model.rest = mesh::vertex_arrays(model.mesh);
    return model;
}

std::vector<Target> rest_targets(const bend::Body& body) {
    std::vector<Target> targets;
    for (const bend::Pose& rest : body.rest_poses()) targets.push_back(target_of(rest));
    return targets;
}

/// What the command `bend` would warn of, at a right angle or as far as the body bends.
std::vector<std::string> warnings_of(const BoundModel& model, const Textures& textures,
                                     const BindRequest& request) {
    Report report("");
    for (const std::string& warning : model.mesh.warnings) report.warn(warning);
    for (const std::string& warning : textures.warnings) report.warn(warning);
    if (!model.baked) {
        report_suitability(report, model);
        warn_of_folds(report, request, model, right_angle_of(model.binding.body));
    }
    return report.warnings();
}

}  // namespace

BindRequest bind_request(const Wish& wish, const PoseRequest& pose) {
    BindRequest request(wish.bind, pose.regions);
    return wish.files.size() > 1 ? request.with_one_arc() : request;
}

Loaded load(const Wish& wish) {
    std::vector<ModelFile> files;
    for (const std::filesystem::path& file : wish.files) files.emplace_back(file, wish.bind.load.limits);
    const PoseRequest pose(wish.pose, wish.bind.fit.arcs, baked_regions(files));
    const BindRequest request = bind_request(wish, pose);
    Loaded loaded{
        .wish = wish, .models = {}, .textures = {}, .words = request.words, .targets = {}, .warnings = {}};
    if (files.empty()) loaded.models.push_back(bind_mesh(base_model(), request));
    for (ModelFile& file : files) loaded.models.push_back(bind_model(std::move(file), request));
    const bend::Body& body = loaded.models[0].binding.body;
    // What is said from now on is for the arcs that were found.
    loaded.wish.bind.fit.arcs = loaded.models[0].baked ? 0 : loaded.models[0].cylinder.arcs.size();
    loaded.targets = targets_on(body, pose);
    const bool bent =
        std::ranges::any_of(body.rest_poses(), [](const bend::Pose& rest) { return rest.angle != 0; });
    if (wish.keep_rest && bent) loaded.targets = rest_targets(body);
    for (std::size_t r = 0; r < loaded.targets.size(); ++r) {
        const double asked = std::fabs(loaded.targets[r].angle),
                     limit = degrees(static_cast<double>(body.max_angle(r)));
        Report report("");
        if (std::isfinite(asked))
            warn_of_angle(report, region_words(r, loaded.targets.size()), asked, limit, "clamped to it");
        loaded.warnings.insert(loaded.warnings.end(), report.warnings().begin(), report.warnings().end());
    }
    for (const BoundModel& model : loaded.models) {
        const Textures& textures =
            loaded.textures.emplace_back(textures_of(model.mesh, wish.bind.load.limits));
        for (const std::string& warning : warnings_of(model, textures, request))
            loaded.warnings.push_back(
                (loaded.models.size() > 1 ? model.file.filename().string() + ": " : "") + warning);
    }
    return loaded;
}

}  // namespace goffer::cli
