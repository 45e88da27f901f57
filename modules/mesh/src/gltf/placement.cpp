// SPDX-License-Identifier: MIT
#include "gltf.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace goffer::mesh::gltf {

namespace {

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The vector at unit length. A zero vector stays one, as in the file.
glm::dvec3 unit(const glm::dvec3& v) {
    const double most = largest(v);
    return most > 0.0 ? glm::normalize(v / most) : v;
}

}  // namespace

Placement::Placement(const glm::dmat4& matrix) : matrix_(matrix), identity_(matrix == glm::dmat4(1.0)) {
    glm::dmat3 linear(matrix);
    const double most = std::max({largest(linear[0]), largest(linear[1]), largest(linear[2])});
    if (most > 0.0) linear = linear / most;
    const glm::dvec3 &x = linear[0], &y = linear[1], &z = linear[2];
    cofactors_ = glm::dmat3(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
    const double volume = glm::dot(x, cofactors_[0]);
    mirrored_ = volume < 0.0;
    if (mirrored_) cofactors_ = cofactors_ * -1.0;
    // The volume that the columns span, compared with that of a box of the same edges: small after much
    // shear.
    singular_ = !(std::abs(volume) > 1e-10 * glm::length(x) * glm::length(y) * glm::length(z));
    if (!singular_) inverse_ = glm::inverse(matrix);
}

glm::vec3 Placement::point(const glm::vec3& local) const {
    return identity_ ? local : glm::vec3(matrix_ * glm::dvec4(local, 1.0));
}

glm::vec3 Placement::normal(const glm::vec3& local) const {
    return identity_ ? local : glm::vec3(unit(cofactors_ * glm::dvec3(local)));
}

// Under a mirror the bitangent changes its side, since normals stay outward.
glm::vec4 Placement::tangent(const glm::vec4& local) const {
    if (identity_) return local;
    return glm::vec4(glm::vec3(unit(glm::dmat3(matrix_) * glm::dvec3(local))),
                     mirrored_ ? -local.w : local.w);
}

glm::vec3 Placement::point_back(const glm::vec3& placed) const {
    return identity_ ? placed : glm::vec3(inverse_ * glm::dvec4(placed, 1.0));
}

glm::vec3 Placement::normal_back(const glm::vec3& placed) const {
    return glm::vec3(unit(glm::transpose(glm::dmat3(matrix_)) * glm::dvec3(placed)));
}

glm::vec4 Placement::tangent_back(const glm::vec4& placed) const {
    return glm::vec4(glm::vec3(unit(glm::dmat3(inverse_) * glm::dvec3(placed))),
                     mirrored_ ? -placed.w : placed.w);
}

glm::vec3 Placement::shift_back(const glm::vec3& placed) const {
    return identity_ ? placed : glm::vec3(glm::dmat3(inverse_) * glm::dvec3(placed));
}

// The transposed matrix takes the placed normal to the direction of `local`. The factor between the two
// lengths is the same for all that is added to the normal.
glm::vec3 Placement::turn_back(const glm::vec3& placed, const glm::vec3& local) const {
    const glm::dmat3 back = glm::transpose(glm::dmat3(matrix_));
    const double length = glm::length(glm::dvec3(local)),
                 whole = identity_ ? 1.0 : glm::length(back * unit(cofactors_ * glm::dvec3(local)));
    return glm::vec3(back * glm::dvec3(placed) * (whole > 0.0 ? length / whole : 0.0));
}

}  // namespace goffer::mesh::gltf
