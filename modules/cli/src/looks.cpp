// SPDX-License-Identifier: MIT
#include "looks.hpp"

#include "arguments.hpp"
#include "poses.hpp"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace goffer::cli {
namespace {

constexpr float brightest = 0.75f;

/// Neither so bright nor so dark that its wrinkles do not show.
glm::vec4 dimmed(const glm::vec4& color) {
    const float high = std::max({color.r, color.g, color.b, 1e-3f});
    return {glm::max(glm::vec3(color) * std::min(1.0f, brightest / high), glm::vec3(0.06f)), 1.0f};
}

/// A material's color, made readable: wrinkles drown in white and in black. A neutral gray, which is what a
/// material says whose texture is not at hand, is no color; such parts are `plain`.
glm::vec4 readable(const glm::vec4& color, const glm::vec4& plain) {
    const auto [low, high] = std::minmax({color.r, color.g, color.b});
    return high > 0.5f && high - low < 0.02f ? plain : dimmed(color);
}

const mesh::Material* material_of(const mesh::Mesh& mesh, const mesh::Part& part) {
    return part.material < 0 ? nullptr : &mesh.materials[static_cast<std::size_t>(part.material)];
}

bool is_white(const glm::vec4& color) {
    return color == glm::vec4(1, 1, 1, color.a);
}

/// The colors of a part's vertices, of which `own` are in the file: its material's where they have none,
/// which is white, and both multiplied where the format says so. A texture is multiplied by them later.
void paint(std::span<const glm::vec4> own, std::span<const std::uint32_t> vertices,
           const mesh::Material* material, bool multiplied, const glm::vec4& plain,
           std::vector<glm::vec4>& colors) {
    if (material != nullptr && material->texture) return;
    const auto white = [&](std::uint32_t v) { return is_white(own[v]); };
    if (std::ranges::all_of(vertices, white)) {
        const glm::vec4 color = material == nullptr ? plain : readable(material->base_color, plain);
        for (const std::uint32_t v : vertices) colors[v] = color;
    } else if (multiplied && material != nullptr) {
        for (const std::uint32_t v : vertices) colors[v] = own[v] * material->base_color;
    }
}

/// Which way a pose bends, radians: a negative angle, the other way.
double direction_of(const bend::Pose& pose) {
    return static_cast<double>(pose.direction) + (pose.angle < 0 ? std::numbers::pi : 0);
}

/// Which way a body bends, radians: that of its region, or that of the plane which the bends of several
/// regions are nearest to, and toward the side that more of them is on. Where no plane is nearest, as of two
/// equal bends at right angles, that of their sum; where it has no side, as of an S, that of the first bend.
double main_direction(const bend::Body& body, std::span<const bend::Pose> poses) {
    constexpr double clear = 1e-3;
    double x = 0, y = 0;            // the bends added up
    double cosines = 0, sines = 0;  // of twice their directions, which are those of planes
    double sum = 0, squares = 0;
    double first = direction_of(poses[0]);
    for (std::size_t r = 0; r < poses.size(); ++r) {
        const double angle = used_angle(body, r, poses[r]), direction = direction_of(poses[r]);
        if (sum == 0 && angle > 0) first = direction;
        x += angle * std::cos(direction);
        y += angle * std::sin(direction);
        cosines += angle * angle * std::cos(2 * direction);
        sines += angle * angle * std::sin(2 * direction);
        sum += angle;
        squares += angle * angle;
    }
    if (poses.size() == 1 || sum == 0) return first;
    const bool plane_is_clear = std::hypot(cosines, sines) > clear * squares;
    const bool side_is_clear = std::hypot(x, y) > clear * sum;
    if (!plane_is_clear) return side_is_clear ? std::atan2(y, x) : first;
    const double plane = 0.5 * std::atan2(sines, cosines);
    const double toward = x * std::cos(plane) + y * std::sin(plane);
    const bool other_side = std::fabs(toward) > clear * sum ? toward < 0 : std::cos(first - plane) < 0;
    return plane + (other_side ? std::numbers::pi : 0);
}

}  // namespace

glm::vec4 plain_color(std::size_t model) {
    // Clay, moss, straw, slate, plum.
    constexpr std::array<glm::vec3, 5> colors = {glm::vec3{0.72f, 0.33f, 0.20f},
                                                 {0.30f, 0.48f, 0.24f},
                                                 {0.74f, 0.53f, 0.17f},
                                                 {0.24f, 0.40f, 0.56f},
                                                 {0.50f, 0.24f, 0.42f}};
    return {colors[model % colors.size()], 1};
}

std::vector<glm::vec4> vertex_colors(const mesh::Mesh& mesh, const mesh::VertexArrays& rest,
                                     const glm::vec4& plain) {
    std::vector<glm::vec4> own;
    if (std::ranges::all_of(mesh.colors, is_white)) return own;
    own.reserve(rest.vertex.size());
    for (const std::uint32_t vertex : rest.vertex) {
        glm::vec4 color = mesh.colors[vertex];
        for (int c = 0; !mesh.linear_colors && c < 3; ++c)
            color[c] = view::linear_of(std::clamp(color[c], 0.0f, 1.0f));
        own.push_back(color);
    }
    std::vector<glm::vec4> colors = own;
    const std::vector<mesh::TriangleRange> ranges = mesh::triangles_of_parts(mesh);
    for (std::size_t p = 0; p < ranges.size(); ++p) {
        const auto of_part = std::span(rest.triangles)
                                 .subspan(std::size_t{3} * ranges[p].first, std::size_t{3} * ranges[p].count);
        paint(own, of_part, material_of(mesh, mesh.parts[p]), mesh.linear_colors, plain, colors);
    }
    std::ranges::transform(colors, colors.begin(), dimmed);
    return colors;
}

std::vector<PartLook> looks_of(const mesh::Mesh& mesh, const Textures& textures, bool colored,
                               const glm::vec4& plain) {
    const std::vector<mesh::TriangleRange> triangles = mesh::triangles_of_parts(mesh);
    std::vector<PartLook> looks;
    for (std::size_t p = 0; p < triangles.size(); ++p) {
        if (triangles[p].count == 0) continue;
        PartLook& look = looks.emplace_back();
        look.triangles = triangles[p];
        look.color = colored ? glm::vec4(1) : plain;
        if (mesh.parts[p].material < 0) continue;
        const auto number = static_cast<std::size_t>(mesh.parts[p].material);
        const mesh::Material& material = mesh.materials[number];
        if (number < textures.of_material.size() && textures.of_material[number].image) {
            look.material = number;
            const float bright = colored ? 1 : brightest;  // vertices' are dimmed already
            look.color = glm::vec4(bright * glm::clamp(glm::vec3(material.texture->factor), 0.0f, 1.0f), 1);
        } else if (!colored) {
            look.color = readable(material.base_color, plain);
        }
    }
    return looks;
}

Sight sight_of(const bend::Body& body, std::span<const bend::Pose> poses, const Viewpoint& from) {
    const double theta = main_direction(body, poses);
    const glm::dmat3& e = body.axes();
    const glm::dvec3 toward = std::cos(theta) * e[0] + std::sin(theta) * e[1];
    const glm::dvec3 across = std::cos(theta) * e[1] - std::sin(theta) * e[0];
    const double azimuth = radians(from.azimuth), elevation = radians(from.elevation);
    const glm::dvec3 level = std::cos(azimuth) * across + std::sin(azimuth) * e[2];
    return {.toward = glm::vec3(-std::cos(elevation) * level - std::sin(elevation) * toward),
            .up = glm::vec3(std::cos(elevation) * toward - std::sin(elevation) * level)};
}

}  // namespace goffer::cli
