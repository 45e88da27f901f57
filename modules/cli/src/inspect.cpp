// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "model.hpp"
#include "report.hpp"
#include "suitability.hpp"

#include <goffer/fit/geometry.hpp>
#include <goffer/io/atomic_file.hpp>

#include <memory>

namespace goffer::cli {
namespace {

struct InspectOptions {
    std::filesystem::path model;
    std::string axis = "auto";
    std::string rest = "auto";
    mesh::LoadOptions load;
    std::filesystem::path json;
};

/// The arc of the rest center line, if there is one, beside the straight line that it replaces.
void report_rest(Report& report, const InspectOptions& options, const BindRequest& request,
                 const BoundModel& model) {
    const fit::Cylinder& fitted = model.cylinder;
    const bool bent = fitted.rest_angle != 0;
    const auto straight_residual = [&] {
        const fit::Geometry geometry{model.rest.positions, model.rest.triangles};
        return in_file(options.model, [&] {
            return fit::fit_cylinder(geometry, request.axis, fit::RestPose::straight).residual;
        });
    };
    const double straight = bent ? straight_residual() : fitted.residual;
    nlohmann::ordered_json& rest = report.json["rest"];
    rest["bent"] = bent;
    rest["arc_radius"] = bent ? nlohmann::ordered_json(fit::rest_radius(fitted)) : nullptr;
    rest["residual_straight"] = straight;
    rest["residual"] = fitted.residual;
    if (!bent) return report.line("at rest", "straight");
    report.line("straight residual", number(straight) + " of the radius");
}

void run_inspect(const InspectOptions& options) {
    BindWords words;
    words.axis = options.axis;
    words.rest = options.rest;
    words.load = options.load;
    const BindRequest request(words);
    check_places({{"MODEL", options.model}}, {{"--json", options.json}});
    Report report(options.json);
    const BoundModel model = bind_model(options.model, request);
    const fit::Binding& binding = model.binding;

    report_model(report, options.model, model.mesh,
                 fit::surface_area(model.rest.positions, model.rest.triangles));
    report_fit(report, model.cylinder);
    report_suitability(report, model);
    if (options.rest == "auto") report_rest(report, options, request, model);
    const double max_angle = degrees(static_cast<double>(binding.body.max_angle()));
    report.json["max_angle"] = max_angle;
    report.json["folds_capacity"] = binding.folds_capacity();
    report.json["folds"] = binding.folds();
    report.line("largest angle", number(max_angle) + " degrees");
    report.line("folds", std::to_string(binding.folds()) + " would be used; the mesh carries " +
                             std::to_string(binding.folds_capacity()));
    io::AtomicFiles outputs;
    report.finish(outputs);
}

}  // namespace

void add_inspect(CLI::App& app, Action& action) {
    const auto options = std::make_shared<InspectOptions>();
    CLI::App* command =
        app.add_subcommand("inspect", "Fit the base cylinder to a model and say what was found");
    command->add_option("model", options->model, "Model: .glb, .gltf, .obj, .ply or .stl")->required();
    add_fit_words(*command, options->axis, options->rest);
    add_load_words(*command, options->load);
    command->add_option("--json", options->json, "Write a report as JSON (- for standard output)");
    command->callback([options, &action] { action = [options] { run_inspect(*options); }; });
}

}  // namespace goffer::cli
