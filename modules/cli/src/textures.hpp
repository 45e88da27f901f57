// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/mesh/mesh.hpp>
#include <goffer/view/image.hpp>

#include <glm/vec2.hpp>

#include <memory>
#include <string>
#include <vector>

namespace goffer::cli {

/// A texture that is shown.
struct ShownTexture {
    std::shared_ptr<const view::Image> image;  ///< null: none
    mesh::Wrap wrap_u = mesh::Wrap::repeat, wrap_v = mesh::Wrap::repeat;
    bool nearest = false;  ///< when enlarged, pixels are squares rather than blended

    bool operator==(const ShownTexture&) const = default;
};

/// The same in the words of another module.
template <class To>
[[nodiscard]] To wrap_as(mesh::Wrap wrap) {
    switch (wrap) {
        case mesh::Wrap::clamp:
            return To::clamp;
        case mesh::Wrap::mirror:
            return To::mirror;
        case mesh::Wrap::repeat:
            break;
    }
    return To::repeat;
}

/// The textures of a model, decoded: for pictures and for the viewer.
struct Textures {
    std::vector<ShownTexture> of_material;  ///< of each material; without an image where it has none
    /// Where in them the corners of the model's triangles are (mesh::texture_uvs); empty if it shows none.
    std::vector<glm::vec2> uvs;
    std::vector<std::string> warnings;  ///< which images cannot be shown, in one line each
};

/// Reads and decodes the images that `mesh` shows, each once. What cannot be shown is left out, and warned
/// of; that goes for images that together have more pixels than a sixteenth of limits.memory, too.
[[nodiscard]] Textures textures_of(const mesh::Mesh& mesh, const mesh::Limits& limits);

}  // namespace goffer::cli
