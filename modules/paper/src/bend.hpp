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

    /// Where a vertex goes whose column is lifted by `wrinkle` (f), in the body frame.
    [[nodiscard]] glm::dvec3 position(const Cylindrical& rest, double wrinkle) const;

    /// The vertex that is at `point` without a wrinkle. alpha < 2 pi.
    [[nodiscard]] Cylindrical inverse(const glm::dvec3& point) const;
};

/// A vector from (e_theta, e_theta_perp, e3) to the body frame.
[[nodiscard]] glm::dvec3 turned(const glm::dvec3& vector, double theta);

/// The bend of `body` in `pose`. Throws std::invalid_argument as the constructor of ClosedForm documents.
[[nodiscard]] Bend bend_of(const Parameters& body, const Pose& pose);

}  // namespace goffer::paper
