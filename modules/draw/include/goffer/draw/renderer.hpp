// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/draw/mesh.hpp>
#include <goffer/draw/orbit_camera.hpp>

#include <glm/vec3.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

/// Draws crowds with OpenGL 3.3 or ES 3.0, in a context that the program has made: no window, no events.

namespace goffer::draw {

/// Pixels of the frame buffer, counted from its lower left corner.
struct Viewport {
    int x = 0, y = 0, width = 1, height = 1;

    [[nodiscard]] float aspect() const { return static_cast<float>(width) / static_cast<float>(height); }
};

/// How a mesh is drawn.
struct Look {
    bool wireframe = false;          ///< edges over the surface
    bool tinted = false;             ///< not quite the same colors for any two instances
    bool textured = true;            ///< with the mesh's textures
    std::size_t first_instance = 0;  ///< what the tints of this mesh count from
    float opacity = 1;               ///< below 1: over what has been drawn, and hides nothing
};

/// A corner of a line, or a point.
struct Mark {
    glm::vec3 position, color;  ///< linear
};

/// Draws. Needs the context that it was made in to be current, its destructor too. Texture unit 0 must be
/// active, and how pixels are unpacked and polygons filled as OpenGL begins with. Leaves the state of OpenGL
/// changed. Move-only; for the thread whose context that is.
class Renderer {
public:
    /// Throws Error where the context is older than OpenGL 3.3 and ES 3.0, or refuses a shader.
    Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    /// Begins a picture: clears the viewport to the background. What follows is drawn as `camera` sees it,
    /// lit from above the camera and by the sky, both sides of a surface alike.
    void begin(const OrbitCamera& camera, const Viewport& viewport);
    /// Draws all instances of a mesh, if it has been given some. Makes its edges when they are first wanted.
    void draw(Mesh& mesh, const Look& look = {});
    /// Draws lines between marks 0 and 1, 2 and 3 and so on, hidden by what is in front.
    void draw_lines(std::span<const Mark> marks);
    /// Draws discs of `pixels` across, over everything.
    void draw_points(std::span<const Mark> marks, float pixels);
    /// Ends the picture. Throws Error where OpenGL has reported an error.
    void end();

    /// Milliseconds that the GPU took for a picture of some frames ago; nothing where it does not say.
    [[nodiscard]] std::optional<double> draw_milliseconds() const;
    /// The version and the device, in one line.
    [[nodiscard]] std::string device() const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace goffer::draw
