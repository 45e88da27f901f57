// SPDX-License-Identifier: MIT
#include "model.hpp"

#include "progress.hpp"

#include <algorithm>
#include <utility>

namespace goffer::cli {

void add_bind_words(CLI::App& command, BindWords& words) {
    command
        .add_option("--folds", words.folds,
                    "Folds per half length (default: what suits the body and its mesh)")
        ->check(CLI::Range(0, fit::BindOptions::max_folds));
    command
        .add_option("--amplitude", words.amplitude,
                    "Wrinkle: paper (keeps lengths), area (keeps the area), none")
        ->check(CLI::IsMember({"paper", "area", "none"}))
        ->capture_default_str();
    command.add_option("--profile", words.profile, "Wrinkle's shape: damped, smooth")
        ->check(CLI::IsMember({"damped", "smooth"}))
        ->capture_default_str();
    command.add_option("--axis", words.axis, "Axis from base to tip: auto, x, y, z, -x, .. or X,Y,Z")
        ->capture_default_str();
}

BindRequest::BindRequest(const BindWords& words) : axis(parse_axis(words.axis)) {
    options.folds = words.folds;
    options.amplitude = parse_amplitude(words.amplitude);
    options.profile = parse_profile(words.profile);
}

BoundModel bind_model(const std::filesystem::path& file, const BindRequest& request,
                      const std::filesystem::path& fit) {
    const Progress progress("reading " + file.string());
    mesh::Mesh mesh = mesh::load(file);
    mesh::Records rest = mesh::records(mesh);
    const fit::Geometry geometry{rest.positions, rest.triangles, rest.normals, rest.tangents};
    const bool given = !fit.empty();
    const fit::Cylinder cylinder = in_file(file, [&] {
        fit::check(geometry);
        return given ? read_fit(fit) : fit::fit_cylinder(geometry, request.axis);
    });
    fit::Bound bound =
        in_file(given ? fit : file, [&] { return fit::bind(geometry, cylinder, request.options); });
    return {file, std::move(mesh), std::move(rest), cylinder, std::move(bound)};
}

void warn_of_folds(Report& report, const BindWords& words, const BoundModel& model, double angle,
                   const std::string& where) {
    const fit::Bound& bound = model.bound;
    const fit::Cylinder& cylinder = model.cylinder;
    const int wanted = fit::sensible_folds(cylinder, fit::BindOptions::max_folds);
    const auto capacity = static_cast<std::size_t>(bound.folds_capacity);
    if (bound.folds > bound.folds_capacity) {
        report.warn(where + "the mesh has vertices for " + counted(capacity, "fold") + ", not " +
                    std::to_string(bound.folds) + ": wrinkles are coarse, and the area is not kept");
    } else if (!words.folds && bound.folds == 0 && wanted > 0 && words.amplitude != "none") {
        report.warn(where + "bent without wrinkles: the mesh has vertices for " + counted(capacity, "fold") +
                    ", and " + std::to_string(wanted) +
                    " would suit its length; use a finer mesh, or --folds K to insist");
    }
    if (bound.folds == 0) return;
    const double squeeze = std::min(2 * angle * cylinder.radius / cylinder.length, 0.999);
    if (paper::amplitude(parse_profile(words.profile), bound.folds, cylinder.length, squeeze) >
        cylinder.radius) {
        report.warn(where +
                    "the wrinkle is deeper than the radius, so that the squeezed side reaches past the "
                    "axis; use more folds");
    }
}

}  // namespace goffer::cli
