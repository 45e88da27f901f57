// SPDX-License-Identifier: MIT
#include <goffer/draw/orbit_camera.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goffer::draw {
namespace {

constexpr float field_of_view = 0.5f;  // vertical, radians
constexpr float steepest = 0.4999f * std::numbers::pi_v<float>;

glm::vec3 level_of(const glm::vec3& toward, const glm::vec3& vertical) {
    glm::vec3 level = toward - glm::dot(toward, vertical) * vertical;
    if (glm::length(level) < 1e-4f * glm::length(toward)) {
        const glm::vec3 other = std::abs(vertical.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        level = glm::cross(vertical, other);
    }
    return glm::normalize(level);
}

}  // namespace

OrbitCamera::OrbitCamera(const glm::vec3& toward, const glm::vec3& up)
    : vertical_(glm::normalize(up)), level_(level_of(toward, vertical_)) {
    const float rise = -glm::dot(glm::normalize(toward), vertical_);
    elevation_ = std::clamp(std::asin(std::clamp(rise, -1.0f, 1.0f)), -steepest, steepest);
}

void OrbitCamera::look_at(const glm::vec3& center, float radius, float aspect) {
    const float half = std::atan(std::tan(field_of_view / 2) * std::min(aspect, 1.0f));
    center_ = center;
    size_ = radius;
    distance_ = radius / std::sin(half);
}

void OrbitCamera::orbit(float azimuth, float elevation) {
    azimuth_ = std::remainder(azimuth_ + azimuth, 2 * std::numbers::pi_v<float>);
    elevation_ = std::clamp(elevation_ + elevation, -steepest, steepest);
}

void OrbitCamera::pan(const glm::vec2& shift) {
    center_ -= std::tan(field_of_view / 2) * distance_ * (shift.x * right() + shift.y * up());
}

void OrbitCamera::zoom(float factor) {
    distance_ = std::clamp(distance_ * factor, 0.02f * size_, 100 * size_);
}

glm::vec3 OrbitCamera::forward() const {
    const glm::vec3 level = glm::cross(vertical_, right());
    return std::cos(elevation_) * level - std::sin(elevation_) * vertical_;
}

glm::vec3 OrbitCamera::right() const {
    return std::cos(azimuth_) * glm::cross(level_, vertical_) - std::sin(azimuth_) * level_;
}

glm::vec3 OrbitCamera::up() const {
    return glm::cross(right(), forward());
}

glm::vec3 OrbitCamera::eye() const {
    return center_ - distance_ * forward();
}

glm::mat4 OrbitCamera::view_projection(float aspect) const {
    const float far_plane = distance_ + 20 * size_;
    const float near_plane = std::max(distance_ - 20 * size_, 0.02f * distance_);
    const glm::mat4 axes(glm::vec4(right(), 0), glm::vec4(up(), 0), glm::vec4(-forward(), 0), {0, 0, 0, 1});
    return glm::perspective(field_of_view, aspect, near_plane, far_plane) *
           glm::translate(glm::transpose(axes), -eye());
}

Ray OrbitCamera::ray(const glm::vec2& place, float aspect) const {
    const float half = std::tan(field_of_view / 2);
    return {eye(), glm::normalize(forward() + half * (aspect * place.x * right() + place.y * up()))};
}

glm::vec2 OrbitCamera::place(const glm::vec3& point, float aspect) const {
    const glm::vec4 at = view_projection(aspect) * glm::vec4(point, 1);
    return glm::vec2(at) / at.w;
}

}  // namespace goffer::draw
