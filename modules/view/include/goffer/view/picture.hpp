// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/view/texture.hpp>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vector>

/// Pictures of meshes, rendered on the CPU, without a display or a GPU (Embree).

namespace goffer::io {
class AtomicFiles;
}

namespace goffer::view {

/// One mesh of the scene. The caller owns the memory, which must last for the call.
struct Model {
    std::span<const glm::vec3> positions;      ///< world space; those that triangles use must be finite
    std::span<const std::uint32_t> triangles;  ///< 3 vertex indices each, every one < positions.size()
    std::span<const glm::vec3> normals = {};   ///< empty (flat shading), or one per vertex, of any length
    std::span<const glm::vec4> colors = {};    ///< empty, or linear RGBA per vertex, multiplied by `color`
    glm::vec4 color{0.72f, 0.33f, 0.20f, 1};  ///< linear RGBA. An alpha below 1 anywhere: a ghost, see render
    Texture texture = {};                     ///< multiplied by the colors; its own alpha is not looked at
    /// With a texture: where in it each entry of `triangles` is, as many; else not looked at. They belong to
    /// corners, so that a vertex on a seam may have several. Those that are not finite count as 0.
    std::span<const glm::vec2> uvs = {};
};

/// How the camera looks at the scene. Its place follows: the nearest from which all models are seen.
struct Camera {
    glm::vec3 toward{-0.4f, -1.0f, -0.35f};  ///< viewing direction, world space, of any length but 0
    glm::vec3 up{0, 0, 1};       ///< up in the picture, world space, of any length but 0; where it
                                 ///< is parallel to `toward`, another direction is taken
    float field_of_view = 0.5f;  ///< vertical, radians, 0.01..3
    /// World space, finite: points that are to be seen like those of the models. Pictures of a motion stay in
    /// place with those that deciding_points() keeps of all its poses.
    std::span<const glm::vec3> also_seen = {};
};

/// The most pixels along a side of a picture, and the most samples of a pixel.
inline constexpr int largest_side = 16384, most_samples = 16384;

/// The size and quality of a picture.
struct Settings {
    int width = 1280;  ///< pixels, 1..largest_side
    int height = 960;  ///< pixels, 1..largest_side
    /// Samples of a pixel that has an edge in it, 1..most_samples; other pixels take one. Every pixel sends
    /// an eighth as many rays to each light. More are smoother and slower.
    int samples = 16;
    /// Called with the share of the rows that are done, ascending to 1, from the calling thread. Empty:
    /// nobody is told.
    std::function<void(double)> progress = {};
};

/// A picture in 8-bit sRGB: rows from top to bottom, 3 bytes a pixel.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};

/// Renders the models on a light background without a ground, lit by a key light from above the camera and by
/// the sky, with soft shadows, so that wrinkles show. Both sides of a surface look the same. A ghost is
/// translucent, casts no shadow, shows only its front, and fades where it is close in front of a solid, so
/// that it hides nothing. Light is found by a few rays from every pixel, and smoothed over the surface;
/// what is thinner than a pixel may be missed; textures are averaged over the pixel. Runs
/// in parallel in the caller's oneTBB arena; the same input gives the same bytes on one machine, whatever the
/// number of threads. Thread-safe.
///
/// Throws Error if there is nothing to see (no triangles, or all vertices in one point), a setting is out of
/// range, the camera has no direction or no up direction, a point that is to be seen is not finite, there is
/// not enough memory, or a model is broken (an index out of range or not 3 per triangle, a vertex that is not
/// finite, normals or colors that are not one per vertex, coordinates that are not one per corner). It is
/// then named by its index in `models`.
[[nodiscard]] Picture render(std::span<const Model> models, const Camera& camera,
                             const Settings& settings = {});

/// Returns the few of `points` (finite, in world space) that decide where `camera` stands so as to see all of
/// them, in pictures of `settings`, and how large the scene is. Those of two sets together are among those of
/// each. Throws Error if the camera has no direction, or a setting is out of range. Thread-safe.
[[nodiscard]] std::vector<glm::vec3> deciding_points(const Camera& camera, std::span<const glm::vec3> points,
                                                     const Settings& settings = {});

/// Writes a PNG. The file is written beside its place and renamed: on failure an existing file stays as it
/// was. Throws Error if the picture is empty or `rgb` is not width x height x 3 bytes, and io::Error if the
/// file cannot be written. Thread-safe.
void save_png(const Picture& picture, const std::filesystem::path& file);

/// Writes a PNG likewise, but leaves it to files.commit() to put it in its place.
void save_png(const Picture& picture, const std::filesystem::path& file, io::AtomicFiles& files);

}  // namespace goffer::view
