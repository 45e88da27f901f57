// SPDX-License-Identifier: MIT

// A small crowd: one body, bound once, deformed for many instances in parallel, each with a pose and a place
// of its own. goffer reads both from the structs that this program keeps anyway, and writes into its vertex
// buffer. Writes crowd.png and crowd.glb into the given folder.

#include <goffer/bend/crowd.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/mesh/mesh.hpp>
#include <goffer/view/picture.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

namespace {

using namespace goffer;

constexpr std::size_t columns = 6;
constexpr std::size_t rows = 4;

/// What an engine keeps for an instance, and sets in every frame.
struct Worm {
    bend::Pose pose;
    glm::mat4x3 model{1};
};

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
};

std::vector<Worm> make_worms() {
    std::vector<Worm> worms(columns * rows);
    for (std::size_t i = 0; i < worms.size(); ++i) {
        const auto phase = 2.4f * static_cast<float>(i);
        worms[i].pose.angle = 0.9f + 0.7f * std::sin(phase);
        worms[i].pose.direction = std::numbers::pi_v<float> / 2 + 0.5f * std::cos(1.7f * phase);
        worms[i].model[3] = {0.5f * static_cast<float>(i % columns), 0.0f,
                             1.1f * static_cast<float>(i / columns)};
    }
    return worms;
}

/// The vertices of all instances, one behind the other.
std::vector<Vertex> deform(const bend::Body& body, std::span<const Worm> worms) {
    std::vector<Vertex> vertices(worms.size() * body.vertex_count());
    bend::Batch batch{.body = &body, .count = worms.size()};
    batch.poses = strided(worms, &Worm::pose);
    batch.transforms = strided(worms, &Worm::model);
    batch.positions = interleaved<3>(&vertices[0].position.x, vertices.size(), sizeof(Vertex));
    batch.normals = interleaved<3>(&vertices[0].normal.x, vertices.size(), sizeof(Vertex));
    batch.vertex_step = body.vertex_count();  // from one instance's first vertex to the next one's
    const bend::CrowdJob crowd{.batches = {&batch, 1}};
    if (const bend::Fault fault = bend::validate(crowd); !fault.none())  // once; later frames only run
        throw std::invalid_argument(bend::describe(fault).c_str());
    bend::run_parallel(crowd);
    return vertices;
}

/// All instances as one mesh. The model's attributes are one per vertex (a GLB's are).
mesh::Mesh merge(const mesh::Mesh& model, std::span<const Vertex> vertices) {
    mesh::Mesh all;
    all.materials = model.materials;
    all.uvs.resize(model.uvs.size());
    for (const Vertex& vertex : vertices) {
        all.positions.push_back(vertex.position);
        all.normals.values.push_back(vertex.normal);
    }
    for (std::size_t first = 0; first < vertices.size(); first += model.positions.size()) {
        const auto first_vertex = static_cast<std::uint32_t>(first);
        const auto first_face = static_cast<std::uint32_t>(all.faces.size());
        for (std::size_t set = 0; set < model.uvs.size(); ++set) {
            const std::vector<glm::vec2>& uvs = model.uvs[set].values;
            all.uvs[set].values.insert(all.uvs[set].values.end(), uvs.begin(), uvs.end());
        }
        for (const std::uint32_t corner : model.corners) all.corners.push_back(first_vertex + corner);
        all.faces.insert(all.faces.end(), model.faces.begin(), model.faces.end());
        for (mesh::Part part : model.parts) {
            part.first_face += first_face;
            all.parts.push_back(part);
        }
    }
    return all;
}

std::vector<view::Model> view_models(const mesh::Mesh& all) {
    std::vector<view::Model> models;
    for (const mesh::Part& part : all.parts) {
        view::Model model;
        model.positions = all.positions;
        model.normals = all.normals.values;
        model.triangles = std::span(all.corners).subspan(3u * part.first_face, 3u * part.face_count);
        if (part.material >= 0)
            model.color = all.materials[static_cast<std::size_t>(part.material)].base_color;
        models.push_back(model);
    }
    return models;
}

void run(const std::filesystem::path& model_file, const std::filesystem::path& folder) {
    const mesh::Mesh model = mesh::load(model_file);
    const mesh::VertexArrays rest = mesh::vertex_arrays(model);
    const fit::Geometry geometry{rest.positions, rest.triangles, rest.normals};
    fit::BindOptions options;
    options.wrinkle_range = {0, 0.72};  // faces stay smooth
    const fit::Binding binding = fit::bind(geometry, fit::fit_cylinder(geometry), options);
    const mesh::Mesh all = merge(model, deform(binding.body, make_worms()));
    view::Camera camera;
    camera.toward = {-0.25f, -0.6f, -0.75f};
    camera.up = {0, 1, 0};
    view::save_png(view::render(view_models(all), camera), folder / "crowd.png");
    mesh::save(all, folder / "crowd.glb");
    std::printf("%zu instances of %zu vertices\n", columns * rows, binding.body.vertex_count());
}

}  // namespace

int main(int count, char** words) {
    if (count != 3) {
        std::fprintf(stderr, "usage: goffer_crowd_sample MODEL.glb FOLDER\n");
        return 2;
    }
    try {
        run(words[1], words[2]);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "goffer_crowd_sample: %s\n", error.what());
        return 1;
    }
}
