// SPDX-License-Identifier: MIT
#include "animate/request.hpp"

#include "motion/document.hpp"
#include "motion/fields.hpp"
#include "picture.hpp"

#include <goffer/clip/vertex_texture.hpp>
#include <goffer/io/error.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace goffer::cli {
namespace {

using nlohmann::json;

/// Degrees as JSON has them: "max" for an infinity.
json angle_as_json(double angle) {
    if (std::isinf(angle)) return angle > 0 ? "max" : "-max";
    return angle;
}

json swing_document(const AnimateOptions& options) {
    const std::vector<double> ends = read_angles("--swing", *options.swing);
    if (ends.size() > 2)
        throw UsageError("--swing: '" + *options.swing + "' is more than two angles; give one, or two ends");
    for (const double end : ends)
        if (std::isfinite(end) && std::fabs(end) > most_degrees)
            throw UsageError("--swing: " + number(end) + " is not an angle in degrees, within " +
                             number(most_degrees) + ", or max");
    json document{
        {"swing",
         {{"from", ends.size() == 2 ? angle_as_json(ends[0]) : json(0)}, {"to", angle_as_json(ends.back())}}},
        {"seconds", 1},
        {"lag", options.lag}};
    if (options.direction) document["direction"] = *options.direction;
    if (options.from_rest) document["angles_count_from"] = "rest";
    return document;
}

/// How many regions a document is for, by what it has for each.
std::size_t regions_of_document(const json& document) {
    const auto entries = [](const json& object, const char* name) {
        const auto field = object.is_object() ? object.find(name) : object.end();
        return field != object.end() && field->is_array() ? field->size() : std::size_t{1};
    };
    if (!document.is_object()) return 1;
    if (document.contains("path")) return regions_for_path().size();
    if (document.contains("swing")) return entries(document["swing"], "to");
    const auto keys = document.find("keys");
    if (keys == document.end() || !keys->is_array() || keys->empty()) return 1;
    const json& first = keys->front();
    if (first.is_object() && first.contains("path")) return regions_for_path().size();
    return entries(first, "angles");
}

std::string where_of(const AnimateOptions& options) {
    if (options.swing) return "--swing";
    return io::escaped((options.keys.empty() ? options.path.file : options.keys).string());
}

constexpr const char* pictures_words = "pictures; give -o a name such as %04d.png";
constexpr const char* gltf_words = "animated glTF; give -o a name such as out.glb";

/// Refuses a word that says how another kind of output is made.
void check_belongs(bool said, const std::string& option, bool wanted, const char* to) {
    if (said && !wanted) throw UsageError(option + ": belongs to " + to);
}

clip::GltfOptions gltf_options(const AnimateOptions& options) {
    clip::GltfOptions gltf;
    gltf.targets = options.targets;
    if (options.max_error) {
        gltf.max_error = *options.max_error / 100;
    } else if (options.targets) {
        gltf.max_error = 0;  // as close as so many can
    } else {
        gltf.targets = usual_targets;
        gltf.max_error = usual_max_error;
    }
    return gltf;
}

}  // namespace

void add_motion_words(CLI::App& command, AnimateOptions& options) {
    CLI::Option* const keys =
        command.add_option("--keys", options.keys, "Move by the keys in this file (see below)");
    CLI::Option* const swing =
        command
            .add_option("--swing", options.swing,
                        "Swing between straight and this many degrees, or between two angles D,E; max: as "
                        "far as it can. Regions share it by their lengths")
            ->type_name("FLOAT|max");
    add_path_words(command, options.path);
    command.get_option("--path")->description("Walk along the path in this file (see below)");
    command.get_option("--path-scale")->description("Multiply the path by this [1]");
    keys->excludes("--swing")->excludes("--path");
    swing->excludes("--path");
    command
        .add_option("--interpolation", options.interpolation,
                    "Between keys, go: smooth (without a jump in the speed, never beyond them in a plane), "
                    "linear. Along a path: linear (at one speed), smooth (set out and arrive gently)")
        ->check(CLI::IsMember({"smooth", "linear"}))
        ->excludes(swing);
    command.add_option("--direction", options.direction, "Swing in this direction, degrees about the axis")
        ->check(angle_word(false))
        ->needs(swing);
    command
        .add_option(
            "--lag", options.lag,
            "Let each region lag behind those below it: one that begins at mid-length by half of this many "
            "swings")
        ->check(number_within(-100, 100, "a number of swings"))
        ->needs(swing);
    command.add_flag("--from-rest", options.from_rest, "Swing from the rest pose instead of from straight")
        ->needs(swing);
    command
        .add_option(
            "--frames", options.frames,
            "Make this many frames; animated glTF that ends as it begins has one more (default: as many "
            "as the keys last; 48 for a swing and 96 for a walk, which last as long as their frames)")
        ->check(CLI::Range(std::uint64_t{1}, most_frames));
    command.add_option("--fps", options.fps, "Play this many frames a second [24]")
        ->check(number_within(0.01, 1000, "a number"));
    command.add_option("--regions", options.pose.regions,
                       "Bend regions on their own: their shares of the length, as 0.3,0.4,0.3 (default: "
                       "equal ones, as many as the keys have angles for; 8 on a path)");
}

AnimateRequest::AnimateRequest(const AnimateOptions& options, const ModelFile& file) {
    if (options.keys.empty() && !options.swing && options.path.file.empty())
        throw UsageError("animate: nothing says how to move; give --keys FILE, --swing D or --path FILE");
    read_outputs(options);
    read_document(options);
    const bool known = options.pose.regions.has_value() || file.baked.has_value();
    const std::size_t count = regions_of_document(document);
    const bool several = count > 1 && count <= bend::max_regions;
    regions = PoseRequest(options.pose, options.bind.fit.arcs,
                          known     ? baked_regions(file)
                          : several ? equal_regions(count)
                                    : std::vector<fit::RegionOptions>())
                  .regions;
    read_motion_of(options);
}

void AnimateRequest::read_outputs(const AnimateOptions& options) {
    pattern = Pattern::read(options.output);
    writer = &writer_for(options.output, pattern.has_value());
    const bool pictures_wanted = pattern && writer->write == &write_pictures;
    gltf_wanted = !pattern && writer->write == &write_gltf;
    with_uvs = !pattern && writer->write == &write_vertex_texture;
    check_belongs(options.size.has_value(), "--size", pictures_wanted, pictures_words);
    check_belongs(options.camera.has_value(), "--camera", pictures_wanted, pictures_words);
    check_belongs(options.max_error.has_value(), "--max-error", gltf_wanted, gltf_words);
    check_belongs(options.targets.has_value(), "--targets", gltf_wanted, gltf_words);
    if (pictures_wanted) {
        picture = options.size ? parse_size(*options.size) : view::Settings{};
        pictures = SurveyView{options.camera ? parse_camera(*options.camera) : Viewpoint{}, picture};
    }
    gltf = gltf_options(options);
    check_files(options);
}

void AnimateRequest::check_files(const AnimateOptions& options) const {
    const std::vector<NamedFile> inputs = {
        {"MODEL", options.model}, {"--keys", options.keys}, {"--path", options.path.file}};
    std::vector<NamedFile> outputs = {{"--json", options.json}};
    if (writer->write == &write_vertex_texture) {
        for (std::filesystem::path& file : clip::vertex_texture_files(options.output))
            outputs.push_back({"-o", std::move(file)});
    } else {
        outputs.push_back({"-o", options.output});
    }
    if (writer->write == &write_mdd || writer->write == &write_pc2)
        outputs.push_back({"-o", mesh_beside(options.output)});
    const mesh::Limits& limits = options.bind.load.limits;
    check_places(inputs, outputs, limits);
    std::vector<NamedFile> others = inputs;
    others.push_back({"--json", options.json});
    if (pattern) std::ranges::move(files_named_by(inputs, limits), std::back_inserter(others));
    for (const NamedFile& other : others) {
        if (pattern && !other.file.empty() && pattern->writes(other.file))
            throw UsageError("-o: " + options.output.string() + " would replace the file of " +
                             std::string(other.option) + "; give another name");
    }
    check_output(pattern ? pattern->file(0) : options.output);
}

void AnimateRequest::read_document(const AnimateOptions& options) {
    if (options.path.scale == "fit")
        throw UsageError("--path-scale: a body has no room to walk on a path of its length; give a number");
    const double scale = read_path_scale(options.path.scale);
    if (options.swing) {
        document = swing_document(options);
    } else if (!options.keys.empty()) {
        document = read_keys_file(options.keys);
    } else {
        document = {{"path", read_path_file(options.path.file)}, {"scale", scale}, {"seconds", 1}};
    }
    if (options.interpolation && document.is_object()) document["interpolation"] = *options.interpolation;
}

/// A swing and a walk last as long as their frames. What ends as it begins has no frame for its end, which is
/// the first one of the next round.
void AnimateRequest::read_motion_of(const AnimateOptions& options) {
    const std::size_t count = std::max<std::size_t>(regions.size(), 1);
    motion = read_motion(document, count, where_of(options));
    if (options.keys.empty()) {
        constexpr std::size_t frames_of_swing = 48, frames_of_walk = 96;
        frames = options.frames.value_or(options.swing ? frames_of_swing : frames_of_walk);
        const std::size_t steps = motion->repeats() ? frames : std::max<std::size_t>(frames, 2) - 1;
        const double seconds = static_cast<double>(steps) / options.fps;
        if (seconds < least_seconds || seconds > most_seconds)
            throw UsageError("--frames: " + std::to_string(frames) + " at " + number(options.fps) +
                             " a second last " + number(seconds) + " s, which is outside " +
                             number(least_seconds) + ".." + number(most_seconds) +
                             "; change --frames or --fps");
        document["seconds"] = seconds;
        motion = read_motion(document, count, where_of(options));
        frames += closing_frame();
        return;
    }
    const double steps = motion->seconds() * options.fps;
    if (!options.frames && steps >= static_cast<double>(most_frames))
        throw InputError(where_of(options) + ": lasts " + number(motion->seconds()) +
                         " seconds, which are more than a million frames; give fewer --fps, or --frames N");
    const double whole = motion->repeats() ? std::max(std::round(steps), 1.0) : std::floor(steps + 1e-6) + 1;
    frames = options.frames.value_or(static_cast<std::size_t>(whole));
    if (!options.frames || static_cast<double>(*options.frames) >= whole) frames += closing_frame();
}

}  // namespace goffer::cli
