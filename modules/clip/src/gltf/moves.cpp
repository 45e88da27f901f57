// SPDX-License-Identifier: MIT
#include "moves.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace goffer::clip {

namespace {

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check(const std::vector<glm::vec3>& values, const char* what, std::size_t frame) {
    const auto bad = std::ranges::find_if_not(values, finite);
    if (bad != values.end())
        throw mesh::Error("frame " + std::to_string(frame) + ": " + what + " " +
                          std::to_string(bad - values.begin()) +
                          " (both counted from 0) is not finite; scale the model to smaller numbers");
}

}  // namespace

Rest rest_of(const mesh::Mesh& mesh) {
    mesh::VertexArrays arrays = mesh::vertex_arrays(mesh);
    Rest rest{std::move(arrays.positions), std::move(arrays.normals)};
    for (glm::vec3& n : rest.normals) {
        const double most = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
        n = most > 0.0 && finite(n) ? glm::vec3(glm::normalize(glm::dvec3(n) / most)) : glm::vec3(0.0f);
    }
    if (rest.positions.empty()) return rest;
    glm::dvec3 least(rest.positions[0]), most = least;
    for (const glm::vec3& p : rest.positions) {
        least = glm::min(least, glm::dvec3(p));
        most = glm::max(most, glm::dvec3(p));
    }
    const glm::dvec3 extent = most - least;
    rest.size = std::max({extent.x, extent.y, extent.z});
    const glm::dvec3 farthest = glm::max(glm::abs(least), glm::abs(most));
    rest.reach = std::max({farthest.x, farthest.y, farthest.z});
    return rest;
}

double Rest::rounding() const {
    return 4.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) * reach;
}

double Rest::noise() const {
    return 3.0 * static_cast<double>(entries()) * rounding() * rounding();
}

Moves::Moves(const Rest& rest, Frames& frames)
    : rest_(rest), frames_(frames), positions_(rest.entries()), normals_(rest.normals.size()) {}

void Moves::read(std::size_t frame, bool with_normals) {
    const bool wanted = with_normals && !normals_.empty();
    frames_.read(frame, positions_, wanted ? std::span(normals_) : std::span<glm::vec3>());
    check(positions_, "vertex", frame);
    if (wanted) check(normals_, "normal", frame);
}

glm::dvec3 Moves::turn(std::size_t entry) const {
    if (rest_.normals[entry] == glm::vec3(0.0f)) return glm::dvec3(0.0);
    return glm::dvec3(normals_[entry]) - glm::dvec3(rest_.normals[entry]);
}

void Moves::copy(std::span<glm::vec3> shifts, std::span<glm::vec3> turns) const {
    for (std::size_t i = 0; i < shifts.size(); ++i) shifts[i] = shift(i);
    for (std::size_t i = 0; i < turns.size(); ++i) turns[i] = turn(i);
}

}  // namespace goffer::clip
