// SPDX-License-Identifier: MIT
#include "model.hpp"

#include "poses.hpp"
#include "progress.hpp"

#include <goffer/fit/base.hpp>

#include <algorithm>
#include <utility>

namespace goffer::cli {

void add_fit_words(CLI::App& command, std::string& axis, std::string& rest) {
    command.add_option("--axis", axis, "Take this axis, from base to tip: auto, x, y, z, -x, .. or X,Y,Z")
        ->capture_default_str();
    command.add_option("--rest", rest, "Fit the center line: auto (an arc where that fits better), straight")
        ->check(CLI::IsMember({"auto", "straight"}))
        ->capture_default_str();
}

void add_bind_words(CLI::App& command, BindWords& words) {
    command.add_option("--folds", words.folds,
                       "Make this many folds over the length of a region (with --profile damped or smooth: "
                       "over half of it), or a list of one number for each (default: what suits the body and "
                       "its mesh)");
    command
        .add_option(
            "--fold-length", words.fold_length,
            "Make folds so many radii long: the shorter, the shallower (default: 0.75; with --profile "
            "damped or smooth 1)")
        ->check(number_within(0.05, 10, "a number of radii"));
    command
        .add_option("--amplitude", words.amplitude,
                    "Choose wrinkles' depth: paper (keeps lengths), area (keeps the base's area), mesh "
                    "(keeps the mesh's own area), none")
        ->check(CLI::IsMember({"paper", "area", "mesh", "none"}))
        ->capture_default_str();
    command
        .add_option("--profile", words.profile,
                    "Choose wrinkles' shape: even (of one depth), damped (the paper's, with creases), smooth")
        ->check(CLI::IsMember({"even", "damped", "smooth"}))
        ->capture_default_str();
    command
        .add_option("--roundness", words.roundness,
                    "Round the crests of --profile even, 0 to 0.5; 0 is a plain cosine")
        ->check(number_within(0, 0.5, "a roundness"))
        ->capture_default_str();
    command
        .add_option("--shape", words.shape,
                    "Take the body for: auto (as thick as it is, here and there), cylinder (of one radius)")
        ->check(CLI::IsMember({"auto", "cylinder"}))
        ->capture_default_str();
    command
        .add_flag("--paper", words.paper,
                  "Bend as the paper has it: --profile damped --shape cylinder --amplitude paper --onset 0")
        ->excludes(command.get_option("--profile"))
        ->excludes(command.get_option("--shape"))
        ->excludes(command.get_option("--amplitude"));
    command
        .add_option("--onset", words.onset,
                    "Begin wrinkles gently, below this squeeze, 0..1 (default: 0; 0.001 if bent at rest)")
        ->check(number_within(0, 1, "a squeeze"));
    add_fit_words(command, words.axis, words.rest);
}

void add_refine_word(CLI::App& command, BindWords& words, const std::string& usual) {
    words.refine = usual;
    command
        .add_option("--refine", words.refine,
                    "Add vertices along the body until its mesh carries the folds: off, on, auto (where that "
                    "takes no more than a million triangles)")
        ->expected(0, 1)
        ->check(CLI::IsMember({"auto", "on", "off"}))
        ->default_str(usual);
}

BindRequest::BindRequest(const BindWords& words, std::vector<fit::RegionOptions> regions)
    : axis(parse_axis(words.axis)), rest(words.rest == "auto" ? fit::Rest::automatic : fit::Rest::straight) {
    options.folds = read_folds(words.folds, regions);
    options.regions = std::move(regions);
    options.onset = words.onset;
    options.amplitude = parse_amplitude(words.amplitude);
    options.profile = parse_profile(words.profile);
    options.profile.roundness = words.roundness;
    options.fold_length = words.fold_length;
    if (words.shape == "cylinder") options.shape = fit::ShapeMode::cylinder;
    if (words.paper) {
        const fit::BindOptions paper = fit::BindOptions::as_in_paper();
        options.profile = paper.profile;
        options.shape = paper.shape;
        options.amplitude = paper.amplitude;
        if (!options.onset) options.onset = paper.onset;
    }
    refine = words.refine.empty() ? "on" : words.refine;
    if (refine == "on" && words.folds == "0")
        throw UsageError(
            "--refine: without folds there is nothing to refine for; leave out one of --folds 0, --refine");
}

BoundModel bind_model(const std::filesystem::path& file, const BindRequest& request,
                      const std::filesystem::path& fit) {
    const Progress progress("reading " + file.string());
    mesh::Mesh mesh = mesh::load(file);
    mesh::VertexArrays rest = mesh::vertex_arrays(mesh);
    fit::Geometry geometry{rest.positions, rest.triangles, rest.normals, rest.tangents};
    const bool given = !fit.empty();
    const fit::Cylinder cylinder = in_file(file, [&] {
        fit::check(geometry);
        const fit::Cylinder found =
            given ? read_fit(fit) : fit::fit_cylinder(geometry, request.axis, request.rest);
        const bool shaped = request.options.shape == fit::ShapeMode::automatic && found.radii.empty();
        return shaped ? fit::fit_shape(geometry, found) : found;
    });
    std::optional<Growth> growth;
    if (request.refine != "off" && request.options.amplitude != fit::Amplitude::none) {
        growth =
            in_file(file, [&] { return refine(mesh, cylinder, request.options, request.refine == "auto"); });
        rest = mesh::vertex_arrays(mesh);
        geometry = {rest.positions, rest.triangles, rest.normals, rest.tangents};
    }
    fit::Binding binding =
        in_file(given ? fit : file, [&] { return fit::bind(geometry, cylinder, request.options); });
    return {file, std::move(mesh), std::move(rest), cylinder, std::move(binding), growth};
}

void warn_of_folds(Report& report, const BindWords& words, const BoundModel& model,
                   std::span<const double> angles, const std::string& where) {
    const fit::Binding& binding = model.binding;
    for (std::size_t r = 0; r < angles.size(); ++r) {
        const fit::Cylinder stretch = fit::stretch_of(model.cylinder, binding.regions[r].length);
        const std::string which = where + region_words(r, angles.size());
        const int wanted = fit::sensible_folds(stretch, fit::BindOptions::max_folds);
        const auto capacity = static_cast<std::size_t>(binding.folds_capacity(r));
        if (binding.folds(r) > binding.folds_capacity(r)) {
            report.warn(which + "the mesh has vertices for " + counted(capacity, "fold") + ", not " +
                        std::to_string(binding.folds(r)) +
                        ": wrinkles are coarse, and the area is not kept; goffer refine adds vertices");
        } else if (!words.folds && binding.folds(r) == 0 && wanted > 0 && words.amplitude != "none") {
            report.warn(which + "bent without wrinkles: the mesh has vertices for " +
                        counted(capacity, "fold") + ", and " + std::to_string(wanted) +
                        " would suit its length; use a finer mesh, which goffer refine makes, or --folds K "
                        "to insist");
        }
        if (fit::wrinkle_depth(binding, r, angles[r]) > stretch.radius) {
            report.warn(which +
                        "the wrinkle is deeper than the radius, so that the squeezed side reaches past the "
                        "axis; use more folds");
        }
    }
}

}  // namespace goffer::cli
