// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/rest_vertex.hpp>
#include <goffer/fit/geometry.hpp>
#include <goffer/paper/closed_form.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace goffer::fit {

/// Geometry::wrinkle_mask, and how it changes along the body.
class Mask {
public:
    /// `at`: the geometry's vertices, straightened.
    Mask(const Geometry& geometry, std::span<const paper::Cylindrical> at);

    /// Makes the wrinkle of vertex `i` of the geometry so much shallower.
    void apply(std::size_t i, bend::RestVertex& vertex) const;

private:
    std::span<const float> mask_;
    std::vector<double> slopes_;  // dm/dz at each vertex
};

/// Whether the corners of a triangle follow half of their wrinkle or more, on average.
[[nodiscard]] bool may_wrinkle(const Geometry& geometry, std::span<const std::uint32_t> corners);

}  // namespace goffer::fit
