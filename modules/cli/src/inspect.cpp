// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "model.hpp"
#include "report.hpp"

#include <goffer/fit/geometry.hpp>

#include <memory>

namespace goffer::cli {
namespace {

struct InspectOptions {
    std::filesystem::path model;
    std::string axis = "auto";
    std::filesystem::path json;
};

void run_inspect(const InspectOptions& options) {
    const BindRequest request({.axis = options.axis});
    check_places({{"MODEL", options.model}}, {{"--json", options.json}});
    Report report(options.json);
    const BoundModel model = bind_model(options.model, request);
    const fit::Bound& bound = model.bound;

    report_model(report, options.model, model.mesh,
                 fit::surface_area(model.rest.positions, model.rest.triangles));
    report_fit(report, model.cylinder);
    const double max_angle = degrees(static_cast<double>(bound.body.max_angle()));
    report.json["max_angle"] = max_angle;
    report.json["folds_capacity"] = bound.folds_capacity();
    report.json["folds"] = bound.folds();
    report.line("largest angle", number(max_angle) + " degrees");
    report.line("folds", std::to_string(bound.folds()) + " would be used; the mesh carries " +
                             std::to_string(bound.folds_capacity()));
    report.finish();
}

}  // namespace

void add_inspect(CLI::App& app, Action& action) {
    const auto options = std::make_shared<InspectOptions>();
    CLI::App* command =
        app.add_subcommand("inspect", "Fit the base cylinder to a model and say what was found");
    command->add_option("model", options->model, "Model: .glb, .gltf, .obj, .ply or .stl")->required();
    command->add_option("--axis", options->axis, "Axis from base to tip: auto, x, y, z, -x, .. or X,Y,Z")
        ->capture_default_str();
    command->add_option("--json", options->json, "Write a report as JSON (- for standard output)");
    command->callback([options, &action] { action = [options] { run_inspect(*options); }; });
}

}  // namespace goffer::cli
