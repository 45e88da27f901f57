// SPDX-License-Identifier: MIT
#include "body_file.hpp"
#include "commands.hpp"
#include "model.hpp"
#include "poses.hpp"
#include "progress.hpp"
#include "refine.hpp"
#include "report.hpp"
#include "suitability.hpp"

#include <goffer/fit/geometry.hpp>
#include <goffer/io/atomic_file.hpp>
#include <goffer/io/read_file.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

namespace goffer::cli {
namespace {

struct InspectOptions {
    std::filesystem::path model;
    FitWords fit;
    mesh::LoadOptions load;
    std::filesystem::path json;
    bool said_fit = false;  ///< --axis, --rest or --arcs
};

/// The center line at rest, if it is bent, beside the straight line that it replaces.
void report_rest(Report& report, const BindRequest& request, const BoundModel& model) {
    const fit::Cylinder& fitted = model.cylinder;
    const bool bent = fitted.rest_angle != 0 || std::ranges::any_of(fitted.arcs, [](const fit::RestArc& arc) {
                          return arc.angle != 0;
                      });
    const auto straight_residual = [&]() -> std::optional<double> {
        const fit::Geometry geometry{model.rest.positions, model.rest.triangles};
        try {
            return fit::fit_cylinder(geometry, request.axis, fit::RestPose::straight).residual;
        } catch (const fit::AxisError&) {
            return std::nullopt;  // as long across as along, for a straight line
        }
    };
    const std::optional<double> straight = bent ? straight_residual() : fitted.residual;
    nlohmann::ordered_json& rest = report.json["rest"];
    rest["bent"] = bent;
    rest["arc_radius"] = fitted.rest_angle != 0 ? nlohmann::ordered_json(fit::rest_radius(fitted)) : nullptr;
    rest["residual_straight"] = straight ? nlohmann::ordered_json(*straight) : nullptr;
    rest["residual"] = fitted.residual;
    if (!bent) return report.line("at rest", "straight");
    if (straight) report.line("straight residual", number(*straight) + " of the radius");
}

/// Lists texts out of a file, as many as a line of the report can hold.
std::string list_of(const std::vector<std::string>& names) {
    constexpr std::size_t most = 12;
    std::string list = std::to_string(names.size());
    for (std::size_t i = 0; i < names.size() && i < most; ++i) list += (i == 0 ? ": " : ", ") + names[i];
    return list + (names.size() > most ? ", .." : "");
}

void report_levels(Report& report, const bend::BodyFile& file) {
    for (std::size_t i = 0; i < file.levels.size(); ++i) {
        const auto& [body, mesh, box] = file.levels[i];
        report.json["levels"].push_back({{"vertices", body.vertex_count()},
                                         {"triangles", mesh.triangles.size() / 3},
                                         {"parts", mesh.parts.size()},
                                         {"uvs", !mesh.uvs.empty()},
                                         {"tangents", body.has_tangents()},
                                         {"low", {box.low.x, box.low.y, box.low.z}},
                                         {"high", {box.high.x, box.high.y, box.high.z}}});
        report.line(i == 0 ? "levels" : "", std::to_string(i) + ": " + std::to_string(body.vertex_count()) +
                                                " vertices, " +
                                                counted(mesh.triangles.size() / 3, "triangle") +
                                                (mesh.uvs.empty() ? "" : ", texture coordinates") +
                                                (body.has_tangents() ? ", tangents" : ""));
    }
}

/// A region as the reports of a model and of a body file have it.
nlohmann::ordered_json region_json(const bend::RegionInput& region, int folds) {
    return {{"length", region.length},
            {"max_angle", degrees(region.max_angle)},
            {"rest_angle", degrees(region.rest_angle)},
            {"rest_direction", degrees(region.rest_direction)},
            {"folds", folds}};
}

void report_regions(Report& report, const bend::Body& body, Notes notes) {
    notes.regions.resize(body.region_count());
    const std::span<const bend::RegionInput> regions = body.region_inputs();
    for (std::size_t r = 0; r < regions.size(); ++r) {
        const double limit = degrees(regions[r].max_angle), rest = degrees(regions[r].rest_angle);
        const double direction = degrees(regions[r].rest_direction);
        report.json["regions"].push_back(region_json(regions[r], notes.regions[r].folds));
        std::string line = region_words(r, regions.size()) + "length " + number(regions[r].length) +
                           ", bends by " + number(limit) + " degrees at most";
        if (notes.regions[r].capacity > 0)
            line += ", " + counted(static_cast<std::size_t>(notes.regions[r].folds), "fold");
        if (rest != 0) line += ", bent at rest by " + number(rest) + " toward " + angle_text(direction);
        report.line(r == 0 ? "body" : "", line);
    }
}

void inspect_body_file(const InspectOptions& options) {
    if (options.said_fit) {
        throw UsageError("--axis, --rest, --arcs: " + options.model.string() +
                         " is a body file, which was fitted already; leave them out");
    }
    check_places({{"MODEL", options.model}}, {{"--json", options.json}}, options.load.limits);
    Report report(options.json);
    const bend::BodyFile file = read_body_file(options.model, options.load.limits);
    const Notes notes = read_notes(file);
    std::vector<std::string> sockets, materials;
    for (const bend::NamedSocket& socket : file.sockets) sockets.emplace_back(socket.name);
    for (const bend::DrawMaterial& material : file.materials) materials.emplace_back(material.name);
    report.json["file"] = options.model.string();
    const std::uint64_t bytes = io::size_of_file(options.model);
    report.json["bytes"] = bytes;
    report.json["radius"] = file.levels[0].body.radius();
    report.line("body file", options.model.string() + ", " + std::to_string(bytes) + " bytes");
    report_levels(report, file);
    report_regions(report, file.levels[0].body, notes);
    report.line("radius", number(file.levels[0].body.radius()));
    report.line("sockets", list_of(sockets));
    report.line("materials", list_of(materials));
    report.json["sockets"] = sockets;
    report.json["materials"] = materials;
    if (!notes.model.empty()) {
        report.json["made_from"] = {
            {"model", notes.model}, {"amplitude", notes.amplitude}, {"profile", notes.profile}};
        report.line("made from",
                    notes.model + ", profile " + notes.profile + ", amplitude " + notes.amplitude);
    }
    io::AtomicFiles outputs;
    report.finish(outputs);
}

/// How far the regions of a model bend, with how many folds.
void report_bends(Report& report, const BindRequest& request, const BoundModel& model) {
    const fit::Binding& binding = model.binding;
    const std::span<const bend::RegionInput> regions = binding.body.region_inputs();
    report.json["max_angle"] = degrees(regions[0].max_angle);
    report.json["folds_capacity"] = binding.folds_capacity();
    report.json["folds"] = binding.folds();
    for (std::size_t r = 0; r < regions.size(); ++r) {
        report.json["regions"].push_back(region_json(regions[r], binding.folds(r)));
        report.line(r == 0 ? "largest angle" : "",
                    region_words(r, regions.size()) + number(degrees(regions[r].max_angle)) + " degrees");
    }
    for (std::size_t r = 0; r < regions.size(); ++r)
        report.line(r == 0 ? "folds" : "",
                    region_words(r, regions.size()) +
                        (binding.folds(r) > 0 ? "it would have " + std::to_string(binding.folds(r))
                                              : "none as it is") +
                        "; the mesh carries " + capacity_words(binding.folds_capacity(r)));
    const bool adds = in_file(model.file, [&] {
        const Progress progress("looking where " + model.file.string() + " is too coarse");
        return adds_vertices(model.mesh, model.cylinder, request.options, request.words.load.limits);
    });
    report.json["adds_vertices"] = adds;
    if (adds) report.line("", "goffer bend adds vertices for its folds, unless with --refine off");
}

void run_inspect(const InspectOptions& options) {
    if (is_body_file(options.model)) return inspect_body_file(options);
    BindWords words;
    words.fit = options.fit;
    words.load = options.load;
    const BindRequest request(words);
    check_places({{"MODEL", options.model}}, {{"--json", options.json}}, options.load.limits);
    Report report(options.json);
    const BoundModel model = bind_model(options.model, request);
    report_model(report, options.model, model.mesh,
                 fit::surface_area(model.rest.positions, model.rest.triangles));
    report_fit(report, model.cylinder);
    report_suitability(report, model);
    const nlohmann::ordered_json& form = report.json["suitability"];
    report.line("cross-section", number(form["flatness"]) + " times as wide as thick");
    if (form["shells"] != 1) report.line("shells", std::to_string(form["shells"].get<std::size_t>()));
    if (options.fit.rest != "straight") report_rest(report, request, model);
    report_bends(report, request, model);
    io::AtomicFiles outputs;
    report.finish(outputs);
}

}  // namespace

void add_inspect(CLI::App& app, Action& action) {
    const auto options = std::make_shared<InspectOptions>();
    CLI::App* command =
        app.add_subcommand("inspect", "Fit the base cylinder to a model and say what was found");
    command->add_option("model", options->model, "Model: .glb, .gltf, .obj, .ply, .stl, or a body file")
        ->required();
    add_fit_words(*command, options->fit);
    add_load_words(*command, options->load);
    add_json_word(*command, options->json);
    command->callback([options, command, &action] {
        options->said_fit =
            command->count("--axis") + command->count("--rest") + command->count("--arcs") > 0;
        action = [options] { run_inspect(*options); };
    });
}

}  // namespace goffer::cli
