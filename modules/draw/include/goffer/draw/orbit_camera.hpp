// SPDX-License-Identifier: MIT
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

/// A camera that turns around a point, as on a turntable. Plain arithmetic: calls no OpenGL.

namespace goffer::draw {

/// A half-line in world space.
struct Ray {
    glm::vec3 origin, direction;  ///< the direction has length 1
};

/// A camera around a point. Places in its picture are x to the right and y up, -1 to 1 from edge to edge;
/// `aspect` is the picture's width over its height. A plain value.
class OrbitCamera {
public:
    /// Looks along `toward`, with `up` upward; world space, of any length but 0. Where both are parallel,
    /// another direction is upward.
    explicit OrbitCamera(const glm::vec3& toward = {0, 1, 0}, const glm::vec3& up = {0, 0, 1});

    /// Has the sphere of `radius` > 0 about `center` fill the picture, without a turn.
    void look_at(const glm::vec3& center, float radius, float aspect);

    /// Turns around the point by radians: about the vertical, and up to the poles.
    void orbit(float azimuth, float elevation);
    /// Shifts the point in the picture's plane by (x, y) of half the picture's height.
    void pan(const glm::vec2& shift);
    /// Multiplies the distance from the point, within limits.
    void zoom(float factor);

    [[nodiscard]] glm::vec3 eye() const;
    [[nodiscard]] glm::vec3 forward() const;  ///< of length 1, as the next two
    [[nodiscard]] glm::vec3 right() const;
    [[nodiscard]] glm::vec3 up() const;
    [[nodiscard]] glm::mat4 view_projection(float aspect) const;

    /// The ray from the eye through a place in the picture.
    [[nodiscard]] Ray ray(const glm::vec2& place, float aspect) const;
    /// Where a point is in the picture. It must be in front of the eye.
    [[nodiscard]] glm::vec2 place(const glm::vec3& point, float aspect) const;

private:
    glm::vec3 vertical_, level_;  // unit: the axis of the turntable, and where azimuth 0 looks
    float azimuth_ = 0, elevation_ = 0;
    glm::vec3 center_{0};
    float distance_ = 3, size_ = 1;  // size_: the radius that it was made for
};

}  // namespace goffer::draw
