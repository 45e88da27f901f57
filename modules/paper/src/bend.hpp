// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/paper/closed_form.hpp>

#include <glm/vec3.hpp>

namespace goffer::paper {

/// The bend (eq 2-5), without what wrinkles it: shared by the closed form and the grid.
struct Bend {
    double length;
    double radius;
    double alpha;  ///< 0 or more
    double theta;

    [[nodiscard]] double kappa() const { return alpha * radius / length; }

    /// Returns where `rest` goes, displaced by `wrinkle` (f) along the radius of its cross-section; body
    /// frame.
    [[nodiscard]] glm::dvec3 position(const Cylindrical& rest, double wrinkle) const;

    /// Returns the vertex that goes to `point` without a wrinkle. alpha must be below 2 pi.
    [[nodiscard]] Cylindrical inverse(const glm::dvec3& point) const;
};

/// Turns a vector from (e_theta, e_theta_perp, e3) to the body frame.
[[nodiscard]] glm::dvec3 turned(const glm::dvec3& vector, double theta);

/// Returns the bend of `body` in `pose`. Throws std::invalid_argument as ClosedForm's constructor does for
/// length, radius, folds, angle and direction.
[[nodiscard]] Bend bend_of(const Parameters& body, const Pose& pose);

}  // namespace goffer::paper
