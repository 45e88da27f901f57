// SPDX-License-Identifier: MIT
#pragma once

#include "rest.hpp"

#include <goffer/bend/rest_vertex.hpp>
#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/geometry.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace goffer::fit {

/// Geometry::wrinkle_mask at a point of the surface.
struct MaskValue {
    double value = 1;
    double slope = 0;  ///< by z, 1 / model units
};

/// The mask of a mesh, and how it changes along the body. `geometry` must outlive it.
class Mask {
public:
    Mask(const Geometry& geometry, const Cylinder& cylinder);

    [[nodiscard]] bool empty() const { return mask_.empty(); }
    /// At a vertex. `empty` masks have none.
    [[nodiscard]] MaskValue at(std::size_t vertex) const {
        return {static_cast<double>(mask_[vertex]), slopes_[vertex]};
    }

private:
    std::span<const float> mask_;
    std::vector<double> slopes_;  // of each vertex
};

/// Multiplies a vertex's wrinkle by the mask there.
void apply(const MaskValue& mask, bend::RestVertex& vertex);

/// Multiplies the wrinkles of `mesh`, which was made of `geometry`, by its mask if it has one.
void apply_mask(const Geometry& geometry, const Cylinder& cylinder, RestMesh& mesh);

/// Whether the corners of a triangle follow half of their wrinkle or more, on average.
[[nodiscard]] bool may_wrinkle(const Geometry& geometry, std::span<const std::uint32_t> corners);

}  // namespace goffer::fit
