// SPDX-License-Identifier: MIT
#include "picture.hpp"

#include "arguments.hpp"
#include "model.hpp"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <system_error>
#include <vector>

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

float linear(float encoded) {
    const float value = std::clamp(encoded, 0.0f, 1.0f);
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

[[noreturn]] void refuse_size(const std::string& text) {
    throw UsageError("--size: '" + text + "' is no size; give WIDTHxHEIGHT, each 1 to " +
                     std::to_string(view::largest_side));
}

int read_side(const std::string& side, const std::string& text) {
    int pixels = 0;
    const auto [end, error] = std::from_chars(side.data(), side.data() + side.size(), pixels);
    if (error != std::errc() || end != side.data() + side.size() || pixels < 1 || pixels > view::largest_side)
        refuse_size(text);
    return pixels;
}

}  // namespace

void add_picture_words(CLI::App& command, PictureWords& words, const std::string& of) {
    command.add_option("--png", words.file, "Write a picture" + of);
    command.add_option("--size", words.size, "Make the picture WIDTHxHEIGHT pixels [1280x960]");
}

void check_wanted(const PictureWords& words, bool given, const std::string& option) {
    if (given && words.file.empty()) throw UsageError(option + ": belongs to a picture; add --png FILE");
}

view::Settings parse_size(const std::string& text) {
    const std::size_t by = text.find('x');
    if (by == std::string::npos) refuse_size(text);
    view::Settings settings;
    settings.width = read_side(text.substr(0, by), text);
    settings.height = read_side(text.substr(by + 1), text);
    return settings;
}

view::Settings picture_settings(const PictureWords& words) {
    check_wanted(words, words.size.has_value(), "--size");
    if (!words.file.empty()) check_picture_output(words.file);
    return words.size ? parse_size(*words.size) : view::Settings{};
}

Viewpoint parse_camera(const std::string& text) {
    if (text == "side") return {0, 0};
    if (text == "inner") return {0, 90};
    if (text == "front") return {90, 0};
    if (text.find(',') == std::string::npos)
        throw UsageError("--camera: '" + text +
                         "' is no place for a camera; give side, inner, front or AZIMUTH,ELEVATION");
    const std::vector<double> angles = read_numbers("--camera", text);
    if (angles.size() != 2 || std::abs(angles[1]) > 90)
        throw UsageError("--camera: '" + text +
                         "' is not an azimuth and an elevation of -90 to 90; give two angles in degrees");
    return {std::remainder(angles[0], 360.0), angles[1]};
}

glm::vec4 plain_color(std::size_t model) {
    // Clay, moss, straw, slate, plum.
    constexpr std::array<glm::vec3, 5> colors = {glm::vec3{0.72f, 0.33f, 0.20f},
                                                 {0.30f, 0.48f, 0.24f},
                                                 {0.74f, 0.53f, 0.17f},
                                                 {0.24f, 0.40f, 0.56f},
                                                 {0.50f, 0.24f, 0.42f}};
    return {colors[model % colors.size()], 1};
}

view::Camera camera_for(const bend::Body& body, const bend::Pose& pose, const Viewpoint& from) {
    const double theta = static_cast<double>(pose.direction) + (pose.angle < 0 ? std::numbers::pi : 0);
    const glm::dmat3& e = body.axes();
    const glm::dvec3 toward = std::cos(theta) * e[0] + std::sin(theta) * e[1];
    const glm::dvec3 across = std::cos(theta) * e[1] - std::sin(theta) * e[0];
    const double azimuth = radians(from.azimuth), elevation = radians(from.elevation);
    const glm::dvec3 level = std::cos(azimuth) * across + std::sin(azimuth) * e[2];
    view::Camera camera;
    camera.toward = glm::vec3(-std::cos(elevation) * level - std::sin(elevation) * toward);
    camera.up = glm::vec3(std::cos(elevation) * toward - std::sin(elevation) * level);
    return camera;
}

std::vector<glm::vec4> vertex_colors(const std::filesystem::path& file, const mesh::Mesh& mesh,
                                     const mesh::VertexArrays& rest) {
    const auto white = [](const glm::vec4& color) { return color == glm::vec4(1, 1, 1, color.a); };
    std::vector<glm::vec4> colors;
    if (std::ranges::all_of(mesh.colors, white)) return colors;
    const std::string ending = file.extension().string();
    const bool encoded = ending != ".glb" && ending != ".gltf";
    colors.reserve(rest.vertex.size());
    for (const std::uint32_t vertex : rest.vertex) {
        glm::vec4 color = mesh.colors[vertex];
        for (int c = 0; encoded && c < 3; ++c) color[c] = linear(color[c]);
        colors.push_back(dimmed(color));
    }
    return colors;
}

std::vector<view::Model> part_models(const mesh::Mesh& mesh, const view::Model& vertices,
                                     const Textures& textures, const glm::vec4& plain) {
    const std::vector<TriangleRange> triangles = triangles_of_parts(mesh);
    std::vector<view::Model> models;
    for (std::size_t p = 0; p < triangles.size(); ++p) {
        const auto [first, count] = triangles[p];
        if (count == 0) continue;
        view::Model& model = models.emplace_back(vertices);
        model.triangles = vertices.triangles.subspan(3 * std::size_t{first}, 3 * std::size_t{count});
        model.color = vertices.colors.empty() ? plain : glm::vec4(1);
        if (mesh.parts[p].material < 0) continue;
        const auto number = static_cast<std::size_t>(mesh.parts[p].material);
        const mesh::Material& material = mesh.materials[number];
        if (number < textures.of_material.size() && textures.of_material[number].image) {
            model.texture = textures.of_material[number];
            model.uvs = std::span(textures.uvs).subspan(3 * std::size_t{first}, 3 * std::size_t{count});
            const float bright = vertices.colors.empty() ? brightest : 1;  // vertices' are dimmed already
            model.color = glm::vec4(bright * glm::clamp(glm::vec3(material.texture->factor), 0.0f, 1.0f), 1);
        } else if (vertices.colors.empty()) {
            model.color = readable(material.base_color, plain);
        }
    }
    return models;
}

void write_picture(const BentModel& model, const PictureStyle& style, const std::filesystem::path& file,
                   io::AtomicFiles& outputs) {
    const view::Model bent{.positions = model.bent_positions,
                           .triangles = model.rest.triangles,
                           .normals = model.bent_normals,
                           .colors = model.colors};
    std::vector<view::Model> models = part_models(model.mesh, bent, model.textures, bent.color);
    if (style.ghost) {
        view::Model rest;
        rest.positions = model.rest.positions;
        rest.triangles = model.rest.triangles;
        rest.color = {0.30f, 0.42f, 0.62f, 0.28f};
        models.push_back(rest);
    }
    const view::Camera camera = camera_for(model.body, model.pose, style.viewpoint);
    view::save_png(view::render(models, camera, style.settings), file, outputs);
}

}  // namespace goffer::cli
