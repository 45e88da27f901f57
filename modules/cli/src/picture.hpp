// SPDX-License-Identifier: MIT
#pragma once

#include "command_line.hpp"
#include "looks.hpp"

#include <goffer/bend/body.hpp>
#include <goffer/bend/pose.hpp>
#include <goffer/mesh/mesh.hpp>
#include <goffer/view/picture.hpp>
#include <goffer/view/texture.hpp>

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace goffer::cli {

/// Words about a picture.
struct PictureWords {
    std::filesystem::path file;  ///< empty: none is wanted
    std::optional<std::string> size;
};

void add_picture_words(CLI::App& command, PictureWords& words, const std::string& of);

/// Throws UsageError if `option`, which is about a picture, is given and no picture is wanted.
void check_wanted(const PictureWords& words, bool given, const std::string& option);

/// WIDTHxHEIGHT. Throws UsageError that names --size.
[[nodiscard]] view::Settings parse_size(const std::string& text);

/// The size that is asked for, and the quality. Throws UsageError for a size that is none, for one without a
/// picture, and for a file that is no PNG; io::Error for one that cannot be written.
[[nodiscard]] view::Settings picture_settings(const PictureWords& words);

/// "side", "inner", "front" or "AZIMUTH,ELEVATION". Throws UsageError.
[[nodiscard]] Viewpoint parse_camera(const std::string& text);

/// What a picture of a bend needs. The caller owns all of it.
struct BentModel {
    const bend::Body& body;
    const mesh::Mesh& mesh;          ///< parts and materials
    const mesh::VertexArrays& rest;  ///< rest positions and triangles
    std::span<const glm::vec3> bent_positions;
    std::span<const glm::vec3> bent_normals;
    std::span<const glm::vec4> colors;  ///< empty: the materials' own; else linear RGBA, one per vertex
    const Textures& textures;           ///< of the mesh, or none; with colors, these are multiplied
    std::span<const bend::Pose> poses;  ///< one per region
    glm::mat4x3 transform{1.0f};        ///< from where the rest positions are to where the bent ones are
};

/// Textures as pictures take them. The textures must outlive it.
struct PictureTextures {
    const Textures& textures;
    std::vector<view::Texture> of_material;  ///< of each material

    explicit PictureTextures(const Textures& decoded);
};

/// One model per part of `mesh`, as looks_of() has them. `vertices` has the positions and normals, and the
/// colors if there are any; its triangles are those of all faces, as mesh::triangles() cuts them, in their
/// order. `textures` are those of `mesh`, or none. The models refer to the same memory, and to that of
/// `textures`.
[[nodiscard]] std::vector<view::Model> part_models(const mesh::Mesh& mesh, const view::Model& vertices,
                                                   const PictureTextures& textures, const glm::vec4& plain);

/// How to draw it.
struct PictureStyle {
    view::Settings settings;
    Viewpoint viewpoint;
    bool ghost = false;  ///< shows the rest shape too, translucent
};

/// Renders the bent model, and writes a PNG, which `outputs` puts in its place.
void write_picture(const BentModel& model, const PictureStyle& style, const std::filesystem::path& file,
                   io::AtomicFiles& outputs);

}  // namespace goffer::cli
