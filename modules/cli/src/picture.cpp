// SPDX-License-Identifier: MIT
#include "picture.hpp"

#include "model.hpp"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace goffer::cli {
namespace {

view::Camera camera_for(const bend::Body& body, const bend::Pose& pose) {
    const double theta = static_cast<double>(pose.direction) + (pose.angle < 0 ? std::numbers::pi : 0);
    const glm::dmat3& e = body.axes();
    const glm::dvec3 toward = std::cos(theta) * e[0] + std::sin(theta) * e[1];
    const glm::dvec3 across = std::cos(theta) * e[1] - std::sin(theta) * e[0];
    constexpr double elevation = 35 * std::numbers::pi / 180;
    view::Camera camera;
    camera.toward = glm::vec3(-std::cos(elevation) * across - std::sin(elevation) * toward);
    camera.up = glm::vec3(toward);
    return camera;
}

/// A material's color, made readable: wrinkles drown in white and in black. A neutral gray, which is what a
/// material says whose texture is not at hand, is no color; such parts are `plain`.
glm::vec4 readable(const glm::vec4& color, const glm::vec4& plain) {
    const auto [low, high] = std::minmax({color.r, color.g, color.b});
    if (high > 0.5f && high - low < 0.02f) return plain;
    const glm::vec3 dimmed = glm::vec3(color) * std::min(1.0f, 0.75f / std::max(high, 1e-3f));
    return {glm::max(dimmed, glm::vec3(0.06f)), 1.0f};
}

}  // namespace

std::vector<view::Model> part_models(const mesh::Mesh& mesh, const view::Model& vertices,
                                     const glm::vec4& plain) {
    const std::vector<TriangleRange> triangles = triangles_of_parts(mesh);
    std::vector<view::Model> models;
    for (std::size_t p = 0; p < triangles.size(); ++p) {
        const auto [first, count] = triangles[p];
        if (count == 0) continue;
        view::Model model = vertices;
        model.triangles = vertices.triangles.subspan(3 * std::size_t{first}, 3 * std::size_t{count});
        const std::int32_t material = mesh.parts[p].material;
        model.color = material < 0
                          ? plain
                          : readable(mesh.materials[static_cast<std::size_t>(material)].base_color, plain);
        models.push_back(model);
    }
    return models;
}

void write_picture(const BentModel& model, bool ghost, const std::filesystem::path& file,
                   io::AtomicFiles& outputs) {
    const view::Model bent{
        .positions = model.bent_positions, .triangles = model.rest.triangles, .normals = model.bent_normals};
    std::vector<view::Model> models = part_models(model.mesh, bent, bent.color);
    for (view::Model& part : models) {
        part.colors = model.colors;
        if (!model.colors.empty()) part.color = glm::vec4(1);
    }
    if (ghost) {
        view::Model rest;
        rest.positions = model.rest.positions;
        rest.triangles = model.rest.triangles;
        rest.color = {0.30f, 0.42f, 0.62f, 0.28f};
        models.push_back(rest);
    }
    view::save_png(view::render(models, camera_for(model.body, model.pose)), file, outputs);
}

}  // namespace goffer::cli
