// SPDX-License-Identifier: MIT
#include "body_file.hpp"

#include "memory.hpp"
#include "poses.hpp"
#include "progress.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/io/ending.hpp>
#include <goffer/io/read_file.hpp>

#include <CLI/CLI.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <span>
#include <utility>

namespace goffer::cli {
namespace {

/// A word that says how to bind is wrong for a body that was bound already.
void refuse_choices(const std::filesystem::path& file, const BindRequest& request) {
    for (const CLI::Option* option : request.words.choices) {
        if (option->count() == 0) continue;
        throw UsageError(option->get_name() + ": " + file.string() +
                         " is a body file, for which that was decided when it was baked; bake its model "
                         "again with it");
    }
}

/// The base cylinder as far as the body knows it: without its radii.
fit::Cylinder cylinder_of(const bend::Body& body) {
    fit::Cylinder cylinder;
    cylinder.origin = body.origin();
    cylinder.axis = body.axes()[2];
    cylinder.zero = body.axes()[0];
    cylinder.length = body.length();
    cylinder.radius = body.radius();
    const std::span<const bend::RegionInput> regions = body.region_inputs();
    if (!is_chain(body)) {
        for (const bend::RegionInput& region : regions) cylinder.rest_angle += region.rest_angle;
        cylinder.rest_direction = regions[0].rest_direction;
    } else {
        for (const bend::RegionInput& region : regions)
            cylinder.arcs.push_back({region.length, region.rest_angle, region.rest_direction});
    }
    return cylinder;
}

/// Streams of a body at rest, as a mesh with the level's triangles.
mesh::Mesh rest_mesh(const bend::BodyFile& file, const bend::BodyFileLevel& level) {
    const bend::Body& body = level.body;
    const std::size_t count = body.vertex_count();
    mesh::Mesh mesh;
    mesh.positions.resize(count);
    mesh.normals.values.resize(count);
    const std::vector<bend::Pose> poses = body.rest_poses();
    bend::DeformJob job{.body = &body, .poses = poses};
    job.positions = interleaved<3>(&mesh.positions[0].x, count);
    job.normals = interleaved<3>(&mesh.normals.values[0].x, count);
    if (body.has_tangents()) {
        mesh.tangents.values.resize(count);
        job.tangents = interleaved<4>(&mesh.tangents.values[0].x, count);
    }
    bend::run(job);
    if (!level.mesh.uvs.empty()) {
        mesh.uvs.emplace_back();
        mesh.uvs[0].values.assign(level.mesh.uvs.begin(), level.mesh.uvs.end());
    }
    mesh.corners.assign(level.mesh.triangles.begin(), level.mesh.triangles.end());
    mesh.faces.assign(mesh.corners.size() / 3, 3);
    for (const bend::DrawPart& part : level.mesh.parts)
        mesh.parts.push_back(
            {std::string(part.name), part.material, part.first_triangle, part.triangle_count});
    if (mesh.parts.empty()) mesh.parts.push_back({"", -1, 0, static_cast<std::uint32_t>(mesh.faces.size())});
    for (const bend::DrawMaterial& material : file.materials)
        mesh.materials.push_back({std::string(material.name), material.base_color});
    return mesh;
}

/// Returns a field that is a text, or its beginning if it is long; nothing where there is no such field.
std::string noted_text(const nlohmann::json& notes, const char* name) {
    constexpr std::size_t longest = 1000;
    const auto field = notes.find(name);
    if (field == notes.end() || !field->is_string()) return {};
    return field->get<std::string>().substr(0, longest);
}

/// Returns a field that is a whole number, clamped to 0..1e6; 0 where there is no such field.
int noted_number(const nlohmann::json& notes, const char* name) {
    const auto field = notes.find(name);
    if (field == notes.end() || !field->is_number_integer()) return 0;
    return static_cast<int>(std::clamp<std::int64_t>(field->get<std::int64_t>(), 0, 1'000'000));
}

/// JSON that is no deeper than notes are; what is deeper is left out while it is read.
nlohmann::json parsed(std::string_view text) {
    constexpr int deepest = 3;
    const auto shallow = [](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
        return depth <= deepest;
    };
    nlohmann::json notes = nlohmann::json::parse(text, shallow, false);
    return notes.is_object() ? notes : nlohmann::json::object();
}

BoundModel baked_model(const std::filesystem::path& file, bend::BodyFile loaded, const BindRequest& request) {
    refuse_choices(file, request);
    if (request.words.level >= loaded.levels.size())
        throw InputError(file.string() + ": has " + counted(loaded.levels.size(), "level") +
                         ", and none of number " + std::to_string(request.words.level) +
                         "; --level counts from 0");
    bend::BodyFileLevel& level = loaded.levels[request.words.level];
    const std::size_t wanted = std::max<std::size_t>(request.options.regions.size(), 1);
    if (level.body.region_count() != wanted)
        throw InputError(file.string() + ": has " + counted(level.body.region_count(), "region") + ", not " +
                         std::to_string(wanted) + "; bend it by itself, or with bodies of as many");
    if (level.mesh.triangles.empty())
        throw InputError(file.string() + ": has no triangles, only what a runtime deforms; bake its model");
    BoundModel model;
    model.file = file;
    model.mesh = rest_mesh(loaded, level);
    check_memory(file.string(), model.mesh, request.words.load.limits);
    model.rest = mesh::vertex_arrays(model.mesh);
    model.cylinder = cylinder_of(level.body);
    model.baked = true;
    for (const bend::NamedSocket& socket : loaded.sockets)
        model.sockets.push_back({std::string(socket.name), socket.socket});
    Notes notes = read_notes(loaded);
    notes.regions.resize(wanted);
    for (std::size_t r = 0; r < wanted; ++r) {
        const auto [folds, capacity] = notes.regions[r];
        model.binding.regions.push_back({level.body.region_inputs()[r].length, folds, capacity});
    }
    model.binding.cylinder = model.cylinder;
    model.binding.body = std::move(level.body);
    return model;
}

}  // namespace

bool is_body_file(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return false;  // a pipe's bytes come once
    if (io::ending_of(file) == ".goffer") return true;                 // or is meant to be one
    std::array<char, 8> first{};
    std::ifstream stream(file, std::ios::binary);
    return stream.read(first.data(), first.size()) && bend::is_body_file(std::as_bytes(std::span(first)));
}

void refuse_body_file(const std::filesystem::path& file) {
    if (is_body_file(file)) throw InputError(file.string() + ": is a body file already; give a model");
}

bend::BodyFile read_body_file(const std::filesystem::path& file, const mesh::Limits& limits) {
    Progress progress("reading " + file.string());
    if (io::size_of_file(file) > limits.memory / 4) {  // the bytes, a copy of them, and what is drawn
        throw InputError(file.string() + ": takes more than the " + io::size_text(limits.memory) +
                         " of memory that are allowed; allow more with --max-memory");
    }
    constexpr double bytes_read = 0.5;  // the share of the time by when they are; then they are checked
    const std::string bytes = io::read_file(file, [&](double share) { progress.at(bytes_read * share); });
    bend::BodyFileFault fault;
    std::optional<bend::BodyFile> loaded = bend::load_copy(std::as_bytes(std::span(bytes)), &fault);
    if (!loaded) throw InputError(file.string() + ": " + bend::describe(fault).c_str());
    return std::move(*loaded);
}

ModelFile::ModelFile(std::filesystem::path name, const mesh::Limits& limits) : file(std::move(name)) {
    if (is_body_file(file)) baked = read_body_file(file, limits);
}

std::vector<fit::RegionOptions> baked_regions(const ModelFile& model) {
    std::vector<fit::RegionOptions> regions;
    if (!model.baked) return regions;
    const bend::Body& body = model.baked->levels[0].body;
    if (body.region_count() == 1) return regions;
    for (const bend::RegionInput& region : body.region_inputs())
        regions.push_back({region.length / body.length(), std::nullopt});
    return regions;
}

std::vector<fit::RegionOptions> baked_regions(std::span<const ModelFile> models) {
    for (const ModelFile& model : models) {
        std::vector<fit::RegionOptions> regions = baked_regions(model);
        if (!regions.empty()) return regions;
    }
    return {};
}

BoundModel bind_model(ModelFile model, const BindRequest& request, const std::filesystem::path& fit) {
    return model.baked ? baked_model(model.file, std::move(*model.baked), request)
                       : bind_model(model.file, request, fit);
}

std::string text_of(const Notes& notes) {
    nlohmann::ordered_json json;
    json["model"] = notes.model;
    json["amplitude"] = notes.amplitude;
    json["profile"] = notes.profile;
    for (const Notes::Region& region : notes.regions)
        json["regions"].push_back({{"folds", region.folds}, {"folds_capacity", region.capacity}});
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Notes read_notes(const bend::BodyFile& file) {
    constexpr std::size_t most = 1 << 16;
    Notes notes;
    if (file.notes.size() > most) return notes;
    const nlohmann::json json = parsed(file.notes);
    notes.model = noted_text(json, "model");
    notes.amplitude = noted_text(json, "amplitude");
    notes.profile = noted_text(json, "profile");
    const auto regions = json.find("regions");
    for (std::size_t r = 0; regions != json.end() && regions->is_array() && r < regions->size(); ++r) {
        const nlohmann::json& own = (*regions)[r];
        Notes::Region region;
        if (own.is_object()) region = {noted_number(own, "folds"), noted_number(own, "folds_capacity")};
        notes.regions.push_back(region);
    }
    return notes;
}

}  // namespace goffer::cli
