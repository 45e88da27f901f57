// SPDX-License-Identifier: MIT
#include "body_file.hpp"
#include "commands.hpp"
#include "model.hpp"
#include "poses.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "suitability.hpp"

#include <goffer/bend/sockets.hpp>
#include <goffer/fit/bake.hpp>
#include <goffer/fit/sockets.hpp>
#include <goffer/io/atomic_file.hpp>

#include <CLI/CLI.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace goffer::cli {
namespace {

struct BakeOptions {
    std::filesystem::path model;
    std::vector<std::filesystem::path> levels;
    std::filesystem::path output;
    PoseWords pose;
    BindWords bind;
    std::filesystem::path fit;
    std::vector<std::string> sockets;
    std::filesystem::path json;
};

/// A socket as it was asked for: at the surface, next to a point.
struct SocketWords {
    std::string name;
    glm::dvec3 point{0};
};

SocketWords parse_socket(const std::string& text) {
    const std::size_t sign = text.find('=');
    const std::string mend = "; give NAME=X,Y,Z, as in hat=0,0,9.5";
    if (sign == text.npos || sign == 0)
        throw UsageError("--socket: '" + text + "' has no name before a '='" + mend);
    const std::vector<double> point = read_numbers("--socket", text.substr(sign + 1));
    constexpr double far = 1e30;
    if (std::ranges::any_of(point, [](double x) { return std::fabs(x) > far; }))
        throw UsageError("--socket: '" + text + "' is beyond all floats" + mend);
    if (point.size() != 3) throw UsageError("--socket: '" + text + "' does not have three numbers" + mend);
    return {text.substr(0, sign), {point[0], point[1], point[2]}};
}

/// Everything that can be refused by looking at the words alone.
struct BakeRequest {
    BindRequest bind;
    std::vector<SocketWords> sockets;

    explicit BakeRequest(const BakeOptions& options)
        : bind(options.bind, PoseRequest(options.pose, options.bind.fit.arcs).regions) {
        bind.with_uvs = true;
        for (const std::string& text : options.sockets) {
            const SocketWords socket = parse_socket(text);
            const auto same = [&](const SocketWords& other) { return other.name == socket.name; };
            if (std::ranges::any_of(sockets, same))
                throw UsageError("--socket: there are two named '" + socket.name + "'");
            sockets.push_back(socket);
        }
        if (!options.fit.empty() && bind.axis)
            throw UsageError("--axis: the axis is in the file of --fit; give one of them");
        if (options.levels.size() + 1 > bend::max_levels)
            throw UsageError("--lod: a body file has " + std::to_string(bend::max_levels) +
                             " levels at most, of which MODEL is one");
        if (mesh::can_save(options.output))
            throw UsageError("-o: " + options.output.string() +
                             " is the name of a model; a body file ends in .goffer, or as you like");
        std::vector<NamedFile> inputs{{"MODEL", options.model}, {"--fit", options.fit}};
        for (const std::filesystem::path& level : options.levels) inputs.push_back({"--lod", level});
        check_places(inputs, {{"-o", options.output}, {"--json", options.json}}, options.bind.load.limits);
        check_output(options.output);
    }
};

/// A level of detail: its mesh, bound to the rig, and what is drawn of it.
struct Level {
    BoundModel model;
    std::vector<bend::DrawPart> parts;
};

BoundModel bind_next(const std::filesystem::path& file, const BindRequest& request, const fit::Binding& rig) {
    refuse_body_file(file);
    BoundModel model = read_model(file, request);
    const Progress progress("binding " + file.string());
    try {
        model.binding = fit::bind_level(geometry_of(model), rig);
    } catch (const fit::Error& error) {
        throw InputError(file.string() +
                         ": is not a level of detail of MODEL but another body: " + error.what());
    }
    model.cylinder = rig.cylinder;
    return model;
}

/// Warns of a level that does not lie where MODEL does: it would jump when it takes MODEL's place.
void warn_of_level(Report& report, const BoundModel& model, const BoundModel& level) {
    const auto box_of = [](const BoundModel& of) {
        bend::Bounds box{of.rest.positions.front(), of.rest.positions.front()};
        for (const glm::vec3& position : of.rest.positions)
            box = {glm::min(box.low, position), glm::max(box.high, position)};
        return box;
    };
    const bend::Bounds box = box_of(model), other = box_of(level);
    const double away = std::max(glm::distance(glm::dvec3(box.low), glm::dvec3(other.low)),
                                 glm::distance(glm::dvec3(box.high), glm::dvec3(other.high)));
    const double size = glm::distance(glm::dvec3(box.low), glm::dvec3(box.high));
    if (away > size / 10)
        report.warn(level.file.string() + ": as a level of detail it is off by up to " + number(away) + ", " +
                    number(100 * away / size) + " % of " + model.file.string() +
                    "'s size; is it the same model, in the same units?");
}

/// Parts as stretches of triangles. `place` of a material: which of the file's it is.
std::vector<bend::DrawPart> parts_of(const mesh::Mesh& mesh, const std::vector<std::int32_t>& place) {
    const std::vector<mesh::TriangleRange> triangles = mesh::triangles_of_parts(mesh);
    std::vector<bend::DrawPart> parts;
    parts.reserve(triangles.size());
    for (std::size_t p = 0; p < triangles.size(); ++p) {
        const std::int32_t material = mesh.parts[p].material;
        parts.push_back({mesh.parts[p].name, triangles[p].first, triangles[p].count,
                         material < 0 ? -1 : place[static_cast<std::size_t>(material)]});
    }
    return parts;
}

/// The levels' materials, those of equal name and color once. Sets the levels' parts.
std::vector<bend::DrawMaterial> materials_of(std::vector<Level>& levels) {
    std::vector<bend::DrawMaterial> all;
    std::map<std::pair<std::string, std::array<float, 4>>, std::int32_t> known;
    for (Level& level : levels) {
        std::vector<std::int32_t> place;
        for (const mesh::Material& own : level.model.mesh.materials) {
            const glm::vec4& color = own.base_color;
            const auto [entry, is_new] = known.try_emplace({own.name, {color.r, color.g, color.b, color.a}},
                                                           static_cast<std::int32_t>(all.size()));
            place.push_back(entry->second);
            if (is_new) all.push_back({own.name, color});
        }
        level.parts = parts_of(level.model.mesh, place);
    }
    return all;
}

std::vector<bend::NamedSocket> sockets_on(const BoundModel& model, const std::vector<SocketWords>& words) {
    const fit::Geometry geometry = geometry_of(model);
    std::vector<bend::NamedSocket> sockets;
    sockets.reserve(words.size());
    for (const SocketWords& socket : words) {
        const bend::Socket place =
            in_file(model.file, [&] { return fit::socket_near(model.binding, geometry, socket.point); });
        sockets.push_back({socket.name, place});
    }
    return sockets;
}

Notes notes_of(const BoundModel& model, const BindRequest& request) {
    Notes notes{model.file.filename().string(), request.words.amplitude, request.words.profile, {}};
    for (const fit::RegionBinding& region : model.binding.regions)
        notes.regions.push_back({region.folds, region.folds_capacity});
    return notes;
}

/// Says where sockets are at rest, and warns of one that was asked for far away from the body.
void report_sockets(Report& report, const BoundModel& model, const std::vector<SocketWords>& words,
                    const std::vector<bend::NamedSocket>& named) {
    const auto sockets = bend::Sockets::make(model.binding.body, named);
    if (!sockets) return;  // there is none
    std::vector<bend::SocketFrame> frames(sockets->count());
    sockets->frames(model.binding.body.rest_poses(), frames);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        glm::dvec3 at = frames[i][3];
        const double noise = 1e-7 * model.binding.body.length();  // of rounding to float
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(at[axis]) < noise) at[axis] = 0;
        }
        const double away = glm::distance(at, words[i].point);
        report.json["sockets"].push_back({{"name", words[i].name}, {"place", {at.x, at.y, at.z}}});
        report.line(i == 0 ? "sockets" : "",
                    words[i].name + " at " + number(at.x) + ", " + number(at.y) + ", " + number(at.z));
        if (away > model.binding.body.length() / 2)
            report.warn("socket '" + words[i].name + "': the surface is " + number(away) +
                        " away from the point; are its numbers in the model's space?");
    }
}

/// Warns of what shows at a right angle, or as far as the body bends.
void warn_of_binding(Report& report, const BakeRequest& request, const BoundModel& model) {
    warn_of_folds(report, request.bind, model, right_angle_of(model.binding.body));
}

void report_body(Report& report, const std::vector<Level>& levels, std::size_t bytes,
                 const BakeOptions& options) {
    const fit::Binding& binding = levels[0].model.binding;
    for (std::size_t r = 0; r < binding.regions.size(); ++r) {
        const double limit = degrees(static_cast<double>(binding.body.max_angle(r)));
        report.json["regions"].push_back({{"length", binding.regions[r].length},
                                          {"folds", binding.folds(r)},
                                          {"folds_capacity", binding.folds_capacity(r)},
                                          {"max_angle", limit}});
        report.line(r == 0 ? "body" : "", region_words(r, binding.regions.size()) + "bends by " +
                                              number(limit) + " degrees at most, " +
                                              counted(static_cast<std::size_t>(binding.folds(r)), "fold"));
    }
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const BoundModel& model = levels[i].model;
        const std::size_t triangles = model.rest.triangles.size() / 3;
        report.json["levels"].push_back({{"file", model.file.string()},
                                         {"vertices", model.binding.body.vertex_count()},
                                         {"triangles", triangles},
                                         {"uvs", !model.rest.uvs.empty()},
                                         {"tangents", model.binding.body.has_tangents()}});
        report.line(i == 0 ? "levels" : "", std::to_string(i) + ": " + model.file.string() + ", " +
                                                std::to_string(model.binding.body.vertex_count()) +
                                                " vertices, " + counted(triangles, "triangle"));
    }
    report.json["bytes"] = bytes;
    report.line("written", options.output.string() + ", " + std::to_string(bytes) + " bytes");
}

std::vector<std::byte> bytes_of(std::vector<Level>& levels, std::span<const bend::NamedSocket> sockets,
                                const BindRequest& request) {
    const BoundModel& finest = levels[0].model;
    const std::vector<bend::DrawMaterial> materials = materials_of(levels);
    const std::string notes = text_of(notes_of(finest, request));
    std::vector<fit::BakeLevel> baked;
    for (const Level& level : levels) {
        const mesh::VertexArrays& rest = level.model.rest;
        baked.push_back({&level.model.binding, {rest.triangles, rest.uvs, rest.vertex, level.parts}});
    }
    return in_file(finest.file, [&] { return fit::bake({baked, materials, sockets, notes}); });
}

void run_bake(const BakeOptions& options) {
    const BakeRequest request(options);
    Report report(options.json);
    refuse_body_file(options.model);
    std::vector<Level> levels(1 + options.levels.size());
    levels[0].model = bind_model(options.model, request.bind, options.fit);
    const BoundModel& finest = levels[0].model;
    for (std::size_t i = 0; i < options.levels.size(); ++i)
        levels[i + 1].model = bind_next(options.levels[i], request.bind, finest.binding);

    const std::vector<bend::NamedSocket> sockets = sockets_on(finest, request.sockets);
    const std::vector<std::byte> bytes = bytes_of(levels, sockets, request.bind);
    report_model(report, options.model, finest.mesh,
                 fit::surface_area(finest.rest.positions, finest.rest.triangles));
    report_fit(report, finest.cylinder);
    report_suitability(report, finest);
    if (finest.growth) report_growth(report, *finest.growth);
    report_body(report, levels, bytes.size(), options);
    report_sockets(report, finest, request.sockets, sockets);
    warn_of_binding(report, request, finest);
    for (std::size_t i = 1; i < levels.size(); ++i) {
        if (levels[i].model.binding.body.vertex_count() >= levels[i - 1].model.binding.body.vertex_count())
            report.warn(levels[i].model.file.string() + ": is not coarser than the level before it");
        warn_of_level(report, finest, levels[i].model);
    }
    io::AtomicFiles outputs;
    outputs.add(options.output).write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    report.finish(outputs);
}

}  // namespace

std::vector<std::byte> baked_bytes(BoundModel model, const BindRequest& request) {
    std::vector<Level> levels(1);
    levels[0].model = std::move(model);
    return bytes_of(levels, {}, request);
}

void add_bake(CLI::App& app, Action& action) {
    const auto options = std::make_shared<BakeOptions>();
    CLI::App* command =
        app.add_subcommand("bake", "Bind a model and write a body file, which a game loads without parsing");
    command->add_option("model", options->model, "Model: .glb, .gltf, .obj, .ply or .stl")->required();
    command->add_option("-o,--output", options->output, "Write the body file here")->required();
    command
        ->add_option("--lod", options->levels,
                     "Add a coarser model of the same body as a level of detail; once for each, from fine "
                     "to coarse")
        ->allow_extra_args(false);
    command
        ->add_option("--socket", options->sockets,
                     "Add a socket NAME=X,Y,Z: the place of the surface that is nearest to this point of the "
                     "model's space; once for each")
        ->allow_extra_args(false);
    command->add_option("--regions", options->pose.regions,
                        "Give the body regions that bend on their own: their shares of the length");
    add_bind_words(*command, options->bind);
    add_refine_word(*command, options->bind, "auto");
    command->add_option("--fit", options->fit,
                        "Take the base cylinder from a report of 'goffer inspect --json'");
    add_json_word(*command, options->json);
    command->callback([options, &action] { action = [options] { run_bake(*options); }; });
}

}  // namespace goffer::cli
