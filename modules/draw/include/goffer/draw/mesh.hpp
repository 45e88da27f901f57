// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>

/// A body's mesh in the memory of OpenGL. All functions here need the context that the mesh was made in to be
/// current, destructors too, texture unit 0 to be active, and pixels to be unpacked as OpenGL begins with.

namespace goffer::bend {
class Body;
struct Coefficients;
}  // namespace goffer::bend

namespace goffer::draw {

/// Thrown where OpenGL cannot do what is asked. what() is one line.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A vertex as the processor deforms it.
struct Vertex {
    glm::vec3 position, normal;
};

/// How a texture goes on beyond 0..1.
enum class Wrap : std::uint8_t { repeat, clamp, mirror };

/// An image on a mesh: coordinates 0, 0 are its lower left corner, 1, 1 its upper right one.
struct Texture {
    int width = 0, height = 0;
    std::span<const std::uint8_t> rgba;  ///< 8-bit sRGB, rows from top to bottom; alpha is not looked at
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool nearest = false;  ///< when enlarged, pixels are squares rather than blended
};

/// Triangles in one color.
struct Part {
    std::uint32_t first = 0, count = 0;    ///< triangles
    glm::vec3 color{0.72f, 0.33f, 0.20f};  ///< linear, multiplied by the texture's
    std::size_t texture = none;            ///< of Skin::textures, or none

    static constexpr std::size_t none = ~std::size_t{0};
};

/// Textures, and where in them triangles are. The caller owns the memory, which must last for the call.
struct Skin {
    std::span<const Texture> textures;
    /// One for each entry of the triangles, or none without textures. They belong to corners, so that a
    /// vertex on a seam may have several; what deforms the body knows of none of them.
    std::span<const glm::vec2> uvs;
};

/// What is drawn of a body, and how its instances were deformed last. Move-only.
class Mesh {
public:
    /// Uploads what never changes: the body's columns, and `triangles`, 3 vertices of the body each, every
    /// one < body.vertex_count(). `parts` lie within them. `body` is not empty, and not needed afterward. If
    /// a texture is larger than the device takes, some of its rows and columns are left out.
    Mesh(const bend::Body& body, std::span<const std::uint32_t> triangles, std::span<const Part> parts,
         const Skin& skin = {});
    Mesh(Mesh&&) noexcept;
    Mesh& operator=(Mesh&&) noexcept;
    ~Mesh();

    /// Uploads instances that the processor has deformed, body.vertex_count() vertices each, one instance
    /// behind the other. From then on they are drawn. Throws Error where 256 MiB or more are refused by the
    /// device.
    void set_vertices(std::span<const Vertex> vertices);

    /// Uploads instances that the vertex shader is to deform: what bend::set_up() wrote, as many for each
    /// instance as the body has regions. From then on they are drawn. Throws Error where they are more than a
    /// texture holds.
    void set_coefficients(std::span<const bend::Coefficients> coefficients);

    /// Gives each of body.vertex_count() vertices a color, linear, in place of its part's or, with a texture,
    /// multiplied by that; none: takes the colors away. Errors as set_vertices().
    void set_colors(std::span<const glm::vec3> colors);

private:
    friend class Renderer;
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace goffer::draw
