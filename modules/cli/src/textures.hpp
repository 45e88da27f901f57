// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/mesh/mesh.hpp>
#include <goffer/view/texture.hpp>

#include <glm/vec2.hpp>

#include <string>
#include <vector>

namespace goffer::cli {

/// The textures of a model, decoded: for pictures and for the viewer.
struct Textures {
    std::vector<view::Texture> of_material;  ///< of each material; without an image where it has none
    /// Where in them the corners of the model's triangles are (mesh::texture_uvs); empty if it shows none.
    std::vector<glm::vec2> uvs;
    std::vector<std::string> warnings;  ///< which images cannot be shown, in one line each
};

/// Reads and decodes the images that `mesh` shows, each once. What cannot be shown is left out, and warned
/// of; that goes for images that together have more pixels than a sixteenth of limits.memory, too.
[[nodiscard]] Textures textures_of(const mesh::Mesh& mesh, const mesh::Limits& limits);

}  // namespace goffer::cli
