// SPDX-License-Identifier: MIT
#include "picture.hpp"

#include "arguments.hpp"
#include "model.hpp"

#include <CLI/CLI.hpp>
#include <glm/mat3x3.hpp>

#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <system_error>
#include <vector>

namespace goffer::cli {
namespace {

[[noreturn]] void refuse_size(const std::string& text) {
    throw UsageError("--size: '" + text + "' is not a size; give WIDTHxHEIGHT, each 1 to " +
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
                         "' is not a place for a camera; give side, inner, front or AZIMUTH,ELEVATION");
    const std::vector<double> angles = read_numbers("--camera", text);
    if (angles.size() != 2 || std::abs(angles[1]) > 90)
        throw UsageError("--camera: '" + text +
                         "' is not an azimuth and an elevation of -90 to 90; give two angles in degrees");
    return {std::remainder(angles[0], 360.0), angles[1]};
}

PictureTextures::PictureTextures(const Textures& decoded) : textures(decoded) {
    std::map<const view::Image*, std::shared_ptr<const view::MipMap>> made;
    for (const ShownTexture& texture : decoded.of_material) {
        view::Texture& out = of_material.emplace_back();
        if (!texture.image) continue;
        std::shared_ptr<const view::MipMap>& image = made[texture.image.get()];
        if (!image) image = std::make_shared<view::MipMap>(*texture.image);
        out = {image, wrap_as<view::Wrap>(texture.wrap_u), wrap_as<view::Wrap>(texture.wrap_v),
               texture.nearest};
    }
}

std::vector<view::Model> part_models(const mesh::Mesh& mesh, const view::Model& vertices,
                                     const PictureTextures& textures, const glm::vec4& plain) {
    std::vector<view::Model> models;
    for (const PartLook& part : looks_of(mesh, textures.textures, !vertices.colors.empty(), plain)) {
        const std::size_t first = 3 * std::size_t{part.triangles.first},
                          count = 3 * std::size_t{part.triangles.count};
        view::Model& model = models.emplace_back(vertices);
        model.triangles = vertices.triangles.subspan(first, count);
        model.color = part.color;
        if (part.material == PartLook::none) continue;
        model.texture = textures.of_material[part.material];
        model.uvs = std::span(textures.textures.uvs).subspan(first, count);
    }
    return models;
}

void write_picture(const BentModel& model, const PictureStyle& style, const std::filesystem::path& file,
                   io::AtomicFiles& outputs) {
    const view::Model bent{.positions = model.bent_positions,
                           .triangles = model.rest.triangles,
                           .normals = model.bent_normals,
                           .colors = model.colors};
    std::vector<view::Model> models =
        part_models(model.mesh, bent, PictureTextures(model.textures), bent.color);
    std::vector<glm::vec3> ghost;
    if (style.ghost) {
        ghost.reserve(model.rest.positions.size());
        for (const glm::vec3& position : model.rest.positions)
            ghost.push_back(model.transform * glm::vec4(position, 1));
        view::Model rest;
        rest.positions = ghost;
        rest.triangles = model.rest.triangles;
        rest.color = {0.30f, 0.42f, 0.62f, 0.28f};
        models.push_back(rest);
    }
    const Sight sight = sight_of(model.body, model.poses, style.viewpoint);
    view::Camera camera;
    camera.toward = glm::mat3(model.transform) * sight.toward;
    camera.up = glm::mat3(model.transform) * sight.up;
    view::save_png(view::render(models, camera, style.settings), file, outputs);
}

}  // namespace goffer::cli
