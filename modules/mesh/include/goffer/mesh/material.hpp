// SPDX-License-Identifier: MIT
#pragma once

#include <glm/mat3x2.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

/// What a surface looks like, as far as it is read: goffer/mesh/mesh.hpp. Plain values.

namespace goffer::mesh {

/// An image that a file holds or names, encoded: PNG, JPEG or what else its maker took. It is not read before
/// its bytes are asked for, so that it costs nothing where nobody looks at it. Immutable; it may hold on to
/// the file that was loaded, but needs no Mesh.
class Image {
public:
    virtual ~Image() = default;

    /// Returns all bytes. An image in a file of its own is read from there, by the rules that load() had.
    /// Throws Error in one line if there are none to be had, or more than the limits of that load() allow.
    [[nodiscard]] virtual std::string bytes() const = 0;
};

/// How a texture goes on beyond 0..1.
enum class Wrap : std::uint8_t { repeat, clamp, mirror };

/// An image on a surface.
struct Texture {
    std::shared_ptr<const Image> image;  ///< not null; textures with the same image share it
    std::size_t uv_set = 0;              ///< which of Mesh::uvs; the mesh need not have it
    glm::mat3x2 transform{1.0f};         ///< times (u, v, 1): where in the image a coordinate is, v up
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool nearest = false;    ///< when enlarged, texels are squares rather than blended
    glm::vec4 factor{1.0f};  ///< linear RGBA, by which the image's color is multiplied
};

/// What is read of a material. Other textures and the rest stay with Mesh::source.
struct Material {
    std::string name;
    glm::vec4 base_color{0.8f, 0.8f, 0.8f, 1.0f};  ///< linear RGBA; of a texture, the factor counts instead
    /// For looking at alone. Nothing writes it: save() gives back that of the source, where it does so at
    /// all. Hence it has no part in whether a mesh is still that of its source.
    std::optional<Texture> texture = {};

    bool operator==(const Material& other) const {
        return name == other.name && base_color == other.base_color;
    }
};

}  // namespace goffer::mesh
