// SPDX-License-Identifier: MIT
#pragma once

#include "embree.hpp"

#include <goffer/view/picture.hpp>

#include <glm/vec2.hpp>

#include <limits>

namespace goffer::view {

struct Ray {
    glm::vec3 origin;
    glm::vec3 direction;  ///< unit
    float length = std::numeric_limits<float>::infinity();
    glm::vec3 right{0}, up{0};  ///< what the directions of the next pixels' rays have more, if they matter
};

struct Hit {
    std::uint32_t model;
    std::uint32_t triangle;
    float u, v;  ///< barycentric coordinates of the triangle's second and third corner
    float distance;
};

/// What is to be shaded. Normals have unit length and point to where the ray came from.
struct Surface {
    glm::vec3 position;
    glm::vec3 outside;  ///< a little off the surface: where shadow rays start
    glm::vec3 face;     ///< normal of the triangle
    glm::vec3 normal;   ///< interpolated normal, for shading
    glm::vec4 color;
    glm::vec2 uv{0};    ///< in the texture, if there is one
    float uv_step = 0;  ///< how far it moves to the next pixel
};

/// The models, moved and scaled into [-1, 1]^3, so that tolerances are plain numbers. The constructor throws
/// Error as render() does for models. All const functions are thread-safe.
class Scene {
public:
    /// `also` are points that count as if triangles used them, but for that nothing is there.
    explicit Scene(std::span<const Model> models, std::span<const glm::vec3> also = {});

    /// The vertices that triangles use, and those points.
    [[nodiscard]] std::span<const glm::vec3> points() const { return points_; }
    [[nodiscard]] std::optional<Hit> solid(const Ray& ray) const { return nearest(solids_.get(), ray); }
    [[nodiscard]] bool occluded(const Ray& ray) const;
    [[nodiscard]] Surface surface(const Hit& hit, const Ray& ray) const;

    /// Puts the first surface of every translucent model along `ray` into `hits`, from far to near.
    void ghosts(const Ray& ray, std::vector<Hit>& hits) const;

private:
    struct Body {
        Model model;
        const glm::vec3* points;
    };

    [[nodiscard]] static std::optional<Hit> nearest(RTCScene scene, const Ray& ray);
    const glm::vec3* add(RTCScene scene, std::size_t index, const glm::dvec3& center, double scale);

    EmbreeDevice device_;
    EmbreeScene solids_;
    std::vector<EmbreeScene> ghosts_;
    std::vector<Body> bodies_;
    std::vector<glm::vec3> points_;
};

}  // namespace goffer::view
