// SPDX-License-Identifier: MIT

// A small crowd: one body, bound once, deformed for many instances in parallel, each with a pose of its own.
// Writes crowd.png and crowd.glb into the given folder.

#include <goffer/bend/crowd.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/mesh/mesh.hpp>
#include <goffer/view/picture.hpp>

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numbers>
#include <vector>

namespace {

using namespace goffer;

constexpr std::size_t columns = 6;
constexpr std::size_t rows = 4;

bend::Pose pose_of(std::size_t instance) {
    const auto phase = 2.4f * static_cast<float>(instance);
    return {0.9f + 0.7f * std::sin(phase), std::numbers::pi_v<float> / 2 + 0.5f * std::cos(1.7f * phase)};
}

glm::vec3 place_of(std::size_t instance) {
    return {0.5f * static_cast<float>(instance % columns), 0.0f,
            1.1f * static_cast<float>(instance / columns)};
}

std::vector<mesh::Records> deform_crowd(const bend::Body& body, const mesh::Records& rest) {
    std::vector<mesh::Records> crowd(columns * rows, rest);
    std::vector<bend::DeformJob> jobs;  // an engine keeps these, and sets poses in every frame
    for (mesh::Records& instance : crowd) {
        bend::DeformJob job{.body = &body, .pose = pose_of(jobs.size())};
        job.positions = interleaved<3>(&instance.positions[0].x, instance.positions.size());
        job.normals = interleaved<3>(&instance.normals[0].x, instance.normals.size());
        jobs.push_back(job);
    }
    bend::run_parallel(bend::CrowdJob{.instances = jobs});
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        for (glm::vec3& position : crowd[i].positions) position += place_of(i);
    }
    return crowd;
}

/// All instances as one mesh. The model's attributes are one per vertex (a GLB's are).
mesh::Mesh merge(const mesh::Mesh& model, const std::vector<mesh::Records>& crowd) {
    mesh::Mesh all;
    all.materials = model.materials;
    all.uvs.resize(model.uvs.size());
    for (const mesh::Records& instance : crowd) {
        const auto first_vertex = static_cast<std::uint32_t>(all.positions.size());
        const auto first_face = static_cast<std::uint32_t>(all.faces.size());
        all.positions.insert(all.positions.end(), instance.positions.begin(), instance.positions.end());
        all.normals.values.insert(all.normals.values.end(), instance.normals.begin(), instance.normals.end());
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
    const mesh::Records rest = mesh::records(model);
    const fit::Geometry geometry{rest.positions, rest.triangles, rest.normals};
    const fit::Bound bound = fit::bind(geometry, fit::fit_cylinder(geometry));
    const mesh::Mesh all = merge(model, deform_crowd(bound.body, rest));
    view::Camera camera;
    camera.towards = {-0.25f, -0.6f, -0.75f};
    camera.up = {0, 1, 0};
    view::save_png(view::render(view_models(all), camera), folder / "crowd.png");
    mesh::save(all, folder / "crowd.glb");
    std::printf("%zu instances of %zu vertices\n", columns * rows, bound.body.vertex_count());
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
