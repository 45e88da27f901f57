// SPDX-License-Identifier: MIT
#include "model.hpp"

#include "memory.hpp"
#include "poses.hpp"
#include "progress.hpp"

#include <goffer/bend/body_file.hpp>
#include <goffer/fit/base.hpp>
#include <goffer/fit/refine.hpp>
#include <goffer/fit/suitability.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <utility>

namespace goffer::cli {
namespace {

/// `words` with those that --paper stands for.
BindWords spelled_out(BindWords words) {
    if (!words.paper) return words;
    words.profile = "damped";
    words.shape = "cylinder";
    words.amplitude = "paper";
    if (!words.onset) words.onset = 0;
    return words;
}

fit::RestPose rest_pose_of(const FitWords& words, bool regions) {
    if (words.arcs > 0 && words.rest != "auto")
        throw UsageError("--arcs: --rest " + words.rest + " is not a chain of arcs; leave out one of them");
    if (words.rest == "straight") return fit::RestPose::straight;
    const bool chain = words.rest == "auto" && (words.arcs > 0 || !regions);
    return chain ? fit::RestPose::chain : fit::RestPose::automatic;
}

fit::WrinkleRange parse_wrinkle_range(const std::string& text) {
    const std::vector<double> shares = read_numbers("--wrinkle-range", text);
    if (shares.size() != 2 || !(shares[0] >= 0 && shares[0] < shares[1] && shares[1] <= 1))
        throw UsageError("--wrinkle-range: '" + text +
                         "' is not a stretch of the body; give two shares of its length, as in 0.1,0.8");
    return {shares[0], shares[1]};
}

/// Which of red, green, blue, alpha.
int parse_wrinkle_mask(const std::string& text) {
    constexpr std::string_view set = "COLOR_0.", channels = "rgba";
    const bool named = text.starts_with(set) && text.size() == set.size() + 1;
    const std::size_t channel = named ? channels.find(text.back()) : channels.npos;
    if (channel == channels.npos)
        throw UsageError("--wrinkle-mask: '" + text +
                         "' is not a channel of vertex colors; give COLOR_0.r, .g, .b or .a");
    return static_cast<int>(channel);
}

/// What to say of a region that has fewer folds than were `asked` for, or than suit it. Empty: nothing.
std::string words_of(fit::FoldShortage shortage, const fit::Binding& binding, std::size_t region, bool asked,
                     int suitable, bool refined) {
    const auto folds_of = [](int folds) { return counted(static_cast<std::size_t>(folds), "fold"); };
    const std::string bare = "bent without wrinkles: ",
                      finer = refined ? "" : "; use a finer mesh, which --refine or goffer refine makes",
                      would_suit = " and " + std::to_string(suitable) + " would suit its length";
    const bool even = binding.profile.kind == fit::Profile::Kind::even;
    const int folds = binding.folds(region), capacity = binding.folds_capacity(region);
    switch (shortage) {
        case fit::FoldShortage::none:
            break;
        case fit::FoldShortage::range:
            return bare + "what --wrinkle-range leaves of it is too short to fade them in, or too coarse";
        case fit::FoldShortage::length:
            return bare + "in so long a body folds would be longer than 2.5 radii; cut it into --regions";
        case fit::FoldShortage::rows:
            if (asked) {
                const bool kept = binding.amplitude == fit::Amplitude::mesh;
                return "the mesh has vertices for " + folds_of(capacity) + ", not " + std::to_string(folds) +
                       ": wrinkles are coarse, and the area " + (kept ? "may not be" : "is not") + " kept" +
                       (refined ? "" : "; goffer refine adds vertices");
            }
            if (folds > 0)
                return "only " + folds_of(folds) + "," + would_suit +
                       ": where the mesh's rows are far apart, folds are longer or there are none" + finer;
            return bare +
                   (even ? "the mesh's rows are too far apart for folds of 2.5 radii,"
                         : "the mesh has vertices for " + folds_of(capacity) + ",") +
                   would_suit + finer + (refined ? "; --folds K insists" : ", or --folds K to insist");
    }
    return {};
}

/// Takes a word of --refine. Since it may have none, a file after it looks like one.
CLI::Validator refine_word() {
    const auto check = [](const std::string& word) {
        const bool known = word == "auto" || word == "on" || word == "off";
        return known ? std::string() : "'" + word + "' is not auto, on or off; a MODEL goes before --refine";
    };
    return {check, ""};
}

/// The arrays of the model's mesh, and the mask in its colors.
void take_arrays(BoundModel& model, const BindRequest& request) {
    const mesh::Mesh& mesh = model.mesh;
    model.rest = request.with_uvs ? mesh::vertex_arrays_with_uvs(mesh) : mesh::vertex_arrays(mesh);
    model.wrinkle_mask.clear();
    if (!request.mask_channel) return;
    if (mesh.colors.empty())
        throw InputError(model.file.string() +
                         ": has no vertex colors for --wrinkle-mask; paint them, or leave it out");
    model.wrinkle_mask.reserve(model.rest.vertex.size());
    for (const std::uint32_t vertex : model.rest.vertex)
        model.wrinkle_mask.push_back(std::clamp(mesh.colors[vertex][*request.mask_channel], 0.0f, 1.0f));
}

/// Adds those of add_bind_words() that say what folds are like where the body may wrinkle.
void add_fold_words(CLI::App& command, BindWords& words) {
    command.add_option("--folds", words.folds,
                       "Make this many folds over the length of a region (with --profile damped or smooth: "
                       "over half of it), of a chain of arcs over all of it, or a list of one number for "
                       "each (default: what suits the body and its mesh)");
    command
        .add_option("--fold-length", words.fold_length,
                    "Make folds this many radii long: the shorter, the shallower (default: " +
                        number(fit::default_fold_length(fit::Profile::even)) +
                        ", and no more than a twelfth of the body; with --profile damped or smooth " +
                        number(fit::default_fold_length(fit::Profile::damped)) + ")")
        ->check(number_within(0.05, 10, "a number of radii"))
        ->excludes(command.get_option("--folds"));
    command
        .add_option("--amplitude", words.amplitude,
                    "Choose the depth of wrinkles: paper (keeps lengths), area (keeps the base's area), mesh "
                    "(keeps the mesh's own area), none")
        ->check(CLI::IsMember({"paper", "area", "mesh", "none"}))
        ->capture_default_str();
    command
        .add_option(
            "--profile", words.profile,
            "Choose the shape of wrinkles: even (of one depth), damped (the paper's, with creases), smooth")
        ->check(CLI::IsMember({"even", "damped", "smooth"}))
        ->capture_default_str();
    command
        .add_option("--roundness", words.roundness,
                    "Round the crests of --profile even, 0 to 0.5; 0 is a plain cosine [" +
                        number(fit::BindOptions{}.profile.roundness) + "]")
        ->check(number_within(0, 0.5, "a roundness"));
}

}  // namespace

void add_level_word(CLI::App& command, std::size_t& level) {
    command
        .add_option("--level", level, "Take this level of detail of a body file; 0 is the finest (default)")
        ->check(CLI::Range(std::size_t{0}, bend::max_levels - 1));
}

void add_load_words(CLI::App& command, mesh::LoadOptions& options) {
    command.add_flag("--allow-outside", options.allow_outside,
                     "Read what a model names outside its folder too (buffers, images, material files), and "
                     "copy it into the output; for models that you trust");
    add_memory_word(command, options.limits);
}

void add_fit_words(CLI::App& command, FitWords& words) {
    command
        .add_option("--axis", words.axis, "Take this axis, from base to tip: auto, x, y, z, -x, .. or X,Y,Z")
        ->capture_default_str();
    command
        .add_option(
            "--rest", words.rest,
            "Fit the center line: auto (an arc where that fits better, or a chain of arcs, each of which "
            "is a region; no chain with --regions, nor by crowd, cache and figures), arc (one, or "
            "straight), straight")
        ->check(CLI::IsMember({"auto", "arc", "straight"}))
        ->capture_default_str();
    command
        .add_option("--arcs", words.arcs,
                    "Make the center line at rest a chain of this many arcs, each of which is a region")
        ->check(CLI::Range(std::size_t{2}, bend::max_regions));
}

void add_bind_words(CLI::App& command, BindWords& words) {
    add_fold_words(command, words);
    command
        .add_option("--shape", words.shape,
                    "Treat the body as: auto (thick and thin where it is), cylinder (of one radius)")
        ->check(CLI::IsMember({"auto", "cylinder"}))
        ->capture_default_str();
    command
        .add_option("--joints", words.joints,
                    "Where regions meet: over (folds of --profile even run on), apart (they end there)")
        ->check(CLI::IsMember({"over", "apart"}))
        ->capture_default_str();
    command
        .add_flag("--paper", words.paper,
                  "Bend as the paper has it: --profile damped --shape cylinder --amplitude paper --onset 0")
        ->excludes(command.get_option("--profile"))
        ->excludes(command.get_option("--roundness"))
        ->excludes(command.get_option("--shape"))
        ->excludes(command.get_option("--amplitude"));
    command.add_option(
        "--wrinkle-range", words.wrinkle_range,
        "Wrinkle this stretch of the body alone, A,B as shares of its length from base to tip, "
        "as in 0.1,0.8 (default: all of it)");
    command.add_option(
        "--wrinkle-mask", words.wrinkle_mask,
        "Wrinkle each vertex as much as this channel of its color says, COLOR_0.r, .g, .b or .a, from 0 "
        "(not at all) to 1 (default: all of them fully)");
    command
        .add_option("--onset", words.onset,
                    "Begin wrinkles gently, below this squeeze, 0..1 (default: 0; 0.001 if bent at rest)")
        ->check(number_within(0, 1, "a squeeze"));
    add_fit_words(command, words.fit);
    for (const char* option :
         {"--folds", "--fold-length", "--amplitude", "--profile", "--roundness", "--shape", "--joints",
          "--paper", "--wrinkle-range", "--wrinkle-mask", "--onset", "--axis", "--rest", "--arcs"})
        words.choices.push_back(command.get_option(option));
    add_load_words(command, words.load);
}

void add_refine_word(CLI::App& command, BindWords& words, const std::string& usual) {
    words.refine = usual;
    command
        .add_option("--refine", words.refine,
                    "Add vertices along the body until its mesh carries the folds, and about it where it has "
                    "few sides: off, on (also where --refine stands alone), auto (where that takes no more "
                    "than a million triangles) (default: " +
                        usual + ")")
        ->expected(0, 1)
        ->check(refine_word());
    words.choices.push_back(command.get_option("--refine"));
}

BindRequest::BindRequest(const BindWords& said, std::vector<fit::RegionOptions> regions)
    : words(spelled_out(said)),
      axis(parse_axis(words.fit.axis)),
      rest(rest_pose_of(words.fit, !regions.empty())) {
    options.folds = read_folds(words.folds, regions);
    options.regions = std::move(regions);
    options.onset = words.onset;
    options.amplitude = parse_amplitude(words.amplitude);
    options.profile = parse_profile(words.profile);
    if (words.roundness) options.profile.roundness = *words.roundness;
    options.fold_length = words.fold_length;
    if (words.wrinkle_range) options.wrinkle_range = parse_wrinkle_range(*words.wrinkle_range);
    if (words.wrinkle_mask) mask_channel = parse_wrinkle_mask(*words.wrinkle_mask);
    if (words.shape == "cylinder") options.shape = fit::ShapeMode::cylinder;
    options.folds_over_joints = words.joints == "over";
    refine = words.refine.empty() ? "on" : words.refine;
    if (words.roundness && words.profile != "even")
        throw UsageError("--roundness: --profile " + words.profile + " has no crests to round; leave it out");
    if (options.amplitude == paper::Amplitude::area && (words.wrinkle_range || words.onset.value_or(0) != 0))
        throw UsageError(
            "--amplitude area: cannot be had with --wrinkle-range or --onset; use --amplitude mesh");
    if (refine == "on" && words.folds == "0")
        throw UsageError(
            "--refine: without folds there is nothing to refine for; leave out one of --folds 0, --refine");
}

fit::Geometry geometry_of(const mesh::VertexArrays& arrays) {
    return {arrays.positions, arrays.triangles, arrays.normals, arrays.tangents};
}

fit::Geometry geometry_of(const BoundModel& model) {
    fit::Geometry geometry = geometry_of(model.rest);
    geometry.wrinkle_mask = model.wrinkle_mask;
    return geometry;
}

mesh::Mesh mesh_of(const paper::BaseMesh& base) {
    mesh::Mesh mesh;
    mesh.positions.assign(base.positions.begin(), base.positions.end());
    mesh.corners = base.triangles;
    mesh.faces.assign(base.triangles.size() / 3, 3);
    mesh.parts.push_back({"base", -1, 0, static_cast<std::uint32_t>(mesh.faces.size())});
    return mesh;
}

BoundModel read_model(const std::filesystem::path& file, const BindRequest& request) {
    BoundModel model;
    model.file = file;
    Progress progress("reading " + file.string());
    mesh::LoadOptions options = request.words.load;
    options.progress = progress.listener();
    model.mesh = mesh::load(file, options);
    check_memory(file.string(), model.mesh, request.words.load.limits);
    take_arrays(model, request);
    return model;
}

BoundModel bind_model(const std::filesystem::path& file, const BindRequest& request,
                      const std::filesystem::path& fit) {
    if (request.words.level > 0)
        throw UsageError("--level: " + file.string() + " is a model, and has no levels; leave it out");
    return bind_mesh(read_model(file, request), request, fit);
}

BoundModel bind_mesh(BoundModel model, const BindRequest& request, const std::filesystem::path& fit) {
    const std::filesystem::path& file = model.file;
    const bool given = !fit.empty();
    const std::filesystem::path& source = given ? fit : file;  // of the cylinder
    const fit::Cylinder cylinder = in_file(file, [&] {
        const Progress progress("fitting " + file.string());
        const fit::Geometry geometry = geometry_of(model.rest);
        fit::check(geometry);
        const fit::Cylinder found =
            given ? read_fit(fit)
                  : fit::fit_cylinder(geometry, request.axis, request.rest, request.words.fit.arcs);
        in_file(source, [&] { fit::check_bindable(found); });  // before vertices are added
        const bool shaped = request.options.shape == fit::ShapeMode::automatic && found.radii.empty();
        return shaped ? fit::fit_shape(geometry, found) : found;
    });
    const std::size_t arcs = cylinder.arcs.size(), said = request.words.fit.arcs;
    if (given && said > 0 && said != arcs)
        throw UsageError("--arcs: the cylinder in " + fit.string() + " has " +
                         (arcs == 0 ? "none; leave out one of them"
                                    : std::to_string(arcs) + "; say the same, or leave out --fit"));
    if (said == 0 && arcs > 0 && !request.options.regions.empty())
        throw UsageError("--fit: the cylinder in " + fit.string() + " is a chain of " + counted(arcs, "arc") +
                         ", which are its regions; leave it out, or --regions and --path, which have others");
    if (request.refine != "off" && request.options.amplitude != fit::Amplitude::none) {
        const bool automatic = request.refine == "auto";
        model.growth = in_file(file, [&] {
            Progress progress("refining " + file.string());
            return refine(model.mesh, cylinder, request.options, request.words.load.limits, automatic,
                          progress.listener());
        });
        if (model.growth->grew()) {
            take_arrays(model, request);
            if (!model.growth->normals.empty()) {
                for (const std::uint32_t vertex : model.rest.vertex)
                    model.rest.normals.push_back(model.growth->normals[vertex]);
            }
        } else if (automatic) {
            model.growth.reset();
        }
    }
    fit::BindOptions options = request.options;
    if (cylinder.radii.empty()) options.shape = fit::ShapeMode::cylinder;  // that was looked for already
    Progress progress("binding " + file.string());
    options.progress = progress.listener();
    model.binding = in_file(source, [&] { return fit::bind(geometry_of(model), cylinder, options); });
    model.cylinder = model.binding.cylinder;
    return model;
}

bool warn_of_folds(Report& report, const BindRequest& request, const BoundModel& model,
                   std::span<const double> angles, const std::string& where) {
    if (const std::vector<float>& mask = model.wrinkle_mask; !mask.empty()) {
        const auto [least, most] = std::ranges::minmax(mask);
        if (least == 1 || most == 0)
            report.warn(where + "--wrinkle-mask: " + request.words.wrinkle_mask.value_or("") + " is " +
                        (most == 0 ? "0 at every vertex: nothing wrinkles"
                                   : "1 at every vertex: nothing stays smooth"));
    }
    const fit::Binding& binding = model.binding;
    const bool asked = request.words.folds.has_value();
    const std::vector<int> suitable = fit::suitable_folds(model.cylinder, request.options);
    const std::vector<fit::FoldShortage> shortages = fit::fold_shortages(binding, request.options);
    const bool refined = model.growth && model.growth->grew();
    bool few = false;
    for (std::size_t r = 0; r < angles.size(); ++r) {
        const std::string which = where + region_words(r, angles.size());
        few = few || shortages[r] != fit::FoldShortage::none;
        const std::string said = words_of(shortages[r], binding, r, asked, suitable[r], refined);
        if (!said.empty()) report.warn(which + said);
        if (fit::wrinkle_depth(binding, r, angles[r]) > model.cylinder.radius) {
            report.warn(which +
                        "the wrinkle is deeper than the radius, so that the squeezed side reaches past the "
                        "axis; use more folds");
        }
    }
    return few;
}

}  // namespace goffer::cli
