// SPDX-License-Identifier: MIT
#include "refine.hpp"

#include "body_file.hpp"
#include "commands.hpp"
#include "memory.hpp"
#include "model.hpp"
#include "poses.hpp"
#include "progress.hpp"

#include <goffer/fit/bind.hpp>
#include <goffer/fit/refine.hpp>
#include <goffer/io/atomic_file.hpp>
#include <goffer/mesh/refined.hpp>

#include <CLI/CLI.hpp>

#include <cassert>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace goffer::cli {
namespace {

struct RefineOptions {
    std::filesystem::path model;
    std::filesystem::path output;
    std::optional<int> folds;
    FitWords words;
    mesh::LoadOptions load;
    std::filesystem::path fit;
    std::filesystem::path json;
};

void run_refine(const RefineOptions& options) {
    BindWords words;
    words.fit = options.words;
    words.load = options.load;
    words.refine = "on";
    BindRequest request(words);
    request.options.folds = options.folds;
    if (!options.fit.empty() && request.axis)
        throw UsageError("--axis: the axis is in the file of --fit; give one of them");
    check_places({{"MODEL", options.model}, {"--fit", options.fit}},
                 {{"-o", options.output}, {"--json", options.json}}, options.load.limits);
    check_model_output(options.output);
    Report report(options.json);
    refuse_body_file(options.model);
    const BoundModel model = bind_model(options.model, request, options.fit);
    report_model(report, options.model, model.mesh,
                 fit::surface_area(model.rest.positions, model.rest.triangles));
    report_fit(report, model.cylinder);
    report_growth(report, *model.growth);
    int capacity = 0;
    for (std::size_t r = 0; r < model.binding.regions.size(); ++r)
        capacity += model.binding.folds_capacity(r);
    report.json["folds_capacity"] = capacity;
    report.line("folds", "the mesh carries " + capacity_words(capacity));
    io::AtomicFiles outputs;
    mesh::save(model.mesh, options.output, outputs);
    report.line("written", options.output.string());
    report.finish(outputs);
}

constexpr double cuts_found =
    0.3;  ///< the share of refine()'s time, roughly, by when it is known where to cut

/// Returns nothing if the refined mesh would be too large and that is allowed.
std::optional<fit::Refinement> refinement(const fit::Geometry& geometry, const fit::Cylinder& cylinder,
                                          std::span<const fit::Stretch> wanted, std::size_t most,
                                          bool sparing, const std::function<void(double)>& progress) {
    if (!sparing)
        return fit::refine(geometry, cylinder, wanted, {.max_triangles = most, .progress = progress});
    constexpr std::size_t some = 1'000'000;
    const std::size_t limit = std::min(most, std::max(some, geometry.triangles.size() / 3));
    try {
        return fit::refine(geometry, cylinder, wanted, {.max_triangles = limit, .progress = progress});
    } catch (const fit::SizeError&) {
        return std::nullopt;
    }
}

/// Values of the vertices in the order of a refined mesh, which is not everywhere that of the refinement. Its
/// triangles are.
std::vector<glm::vec3> in_order_of(const mesh::Mesh& mesh, std::span<const std::uint32_t> pieces,
                                   std::span<const glm::vec3> values) {
    const std::vector<std::uint32_t> triangles = mesh::triangles(mesh);
    assert(triangles.size() == pieces.size());
    std::vector<glm::vec3> sorted(mesh.positions.size(), glm::vec3(0));
    for (std::size_t c = 0; c < pieces.size(); ++c) sorted[triangles[c]] = values[pieces[c]];
    return sorted;
}

}  // namespace

Growth refine(mesh::Mesh& mesh, const fit::Cylinder& cylinder, const fit::BindOptions& options,
              const mesh::Limits& limits, bool sparing, const std::function<void(double)>& progress) {
    const auto stretch_of = [&](double from, double to) -> std::function<void(double)> {
        if (!progress) return {};
        return [&progress, from, to](double share) { progress(from + (to - from) * share); };
    };
    Growth growth;
    const std::vector<fit::Stretch> wanted = fit::stretches_of(cylinder, options);
    growth.folds = fit::fold_count(wanted, options.profile);
    growth.vertices_before = mesh.positions.size();
    growth.triangles_before = mesh::triangle_count(mesh);
    const std::vector<std::uint32_t> triangles = mesh::triangles(mesh);
    const fit::Geometry geometry{mesh.positions, triangles};
    const std::optional<fit::Refinement> found =
        refinement(geometry, cylinder, wanted, most_triangles(limits), sparing, stretch_of(0, cuts_found));
    growth.vertices_after = growth.vertices_before;
    growth.triangles_after = growth.triangles_before;
    if (!found || found->vertices.empty()) return growth;
    const fit::Refinement& made = *found;
    std::vector<glm::vec3> normals;
    if (mesh.normals.empty()) normals = fit::make_refined_normals(mesh.positions, triangles, made);
    mesh = mesh::refined(mesh, made, limits, stretch_of(cuts_found, 1));
    if (!normals.empty()) growth.normals = in_order_of(mesh, made.triangles, normals);
    growth.vertices_after = mesh.positions.size();
    growth.triangles_after = mesh::triangle_count(mesh);
    return growth;
}

bool adds_vertices(const mesh::Mesh& mesh, const fit::Cylinder& cylinder, const fit::BindOptions& options,
                   const mesh::Limits& limits) {
    const std::vector<std::uint32_t> triangles = mesh::triangles(mesh);
    const std::optional<fit::Refinement> found =
        refinement({mesh.positions, triangles}, cylinder, fit::stretches_of(cylinder, options),
                   most_triangles(limits), true, {});
    return found && !found->vertices.empty();
}

void report_growth(Report& report, const Growth& growth, nlohmann::ordered_json& json) {
    json["refined"] = {{"folds", growth.folds},
                       {"vertices_before", growth.vertices_before},
                       {"vertices_after", growth.vertices_after},
                       {"triangles_before", growth.triangles_before},
                       {"triangles_after", growth.triangles_after}};
    report.line("refined", "from " + std::to_string(growth.triangles_before) + " to " +
                               std::to_string(growth.triangles_after) + " triangles, from " +
                               std::to_string(growth.vertices_before) + " to " +
                               std::to_string(growth.vertices_after) + " vertices, for " +
                               counted(static_cast<std::size_t>(growth.folds), "fold"));
    if (growth.folds == 0)
        report.warn("the body is too short for folds of its own, so that nothing is refined; give --folds K");
}

void add_refine(CLI::App& app, Action& action) {
    const auto options = std::make_shared<RefineOptions>();
    CLI::App* command = app.add_subcommand(
        "refine",
        "Give a model the vertices that its folds need, along it and about it, its shape unchanged");
    command->add_option("model", options->model, "Model: .glb, .gltf, .obj, .ply or .stl")->required();
    command->add_option("-o,--output", options->output, "Write the model here, with one of these endings")
        ->required();
    command
        ->add_option(
            "--folds", options->folds,
            "Make room for this many folds over the length, as --profile even counts them; the paper's, "
            "over half of it, need twice as many (default: what suits the body)")
        ->check(CLI::Range(1, fit::BindOptions::max_folds));
    add_fit_words(*command, options->words);
    add_load_words(*command, options->load);
    command->add_option("--fit", options->fit,
                        "Take the base cylinder from a report of 'goffer inspect --json'");
    add_json_word(*command, options->json);
    command->callback([options, &action] { action = [options] { run_refine(*options); }; });
}

}  // namespace goffer::cli
