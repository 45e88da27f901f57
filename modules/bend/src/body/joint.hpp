// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"

#include <goffer/bend/body_input.hpp>
#include <goffer/bend/region.hpp>

#include <cmath>
#include <cstddef>
#include <span>

/// Joints that wrinkles run over: see RegionInput::blend.

namespace goffer::bend {

/// A joint as a region beside it sees it.
struct Joint {
    JointBlend blend = {};
    std::size_t first = 0;  ///< the region's vertices near it are among [first, last); none: nothing passes
    std::size_t last = 0;
    std::size_t neighbor = 0;  ///< the region beyond it
    float max_scale = 1;       ///< largest s of vertices near it; 0: there is none

    [[nodiscard]] bool blends() const noexcept { return blend.per_height != 0; }
    /// Whether a vertex of the region at height v = z / L - 1/2 is near it, and wrinkles pass over it. Rounds
    /// as kernels do.
    [[nodiscard]] bool nears(float v) const noexcept {
        return blends() && blend.per_height * v + blend.at > 0;
    }
};

/// The joints where a region begins and ends.
struct Joints {
    Joint below, above;
};

/// The joints of region `r`, without vertices. `radius`: of the body.
[[nodiscard]] Joints joints_of(std::span<const RegionInput> regions, std::size_t r, double radius) noexcept;

/// Sets which of the region's vertices [first, last) are near joints, or returns false: one that is near the
/// joint above lies before one that is near the joint below. Others may lie among them.
[[nodiscard]] bool find_vertices(Joints& joints, const RestColumns& columns, std::size_t first,
                                 std::size_t last) noexcept;

/// Whether a vertex of that s is near a joint with a region of `max_scale` is within what that region's table
/// is made for.
[[nodiscard]] inline bool bears_scale(const JointBlend& joint, double scale, double max_scale) noexcept {
    constexpr double slack = 1.01;
    return scale * static_cast<double>(joint.radius_ratio) <= slack * max_scale;
}

/// Whether wrinkles may pass into each other so fast about a vertex near a joint: those of amplitude `depth`
/// move it by `offset` times that.
[[nodiscard]] inline bool bears_offset(const JointBlend& joint, double offset, double depth) noexcept {
    return std::fabs(depth * offset * static_cast<double>(joint.per_length)) <= WorkingRange::max_growth;
}

/// Sets what `own` has of wrinkles to that of the region beyond a joint, with amplitudes and squeezes as
/// those of the region itself, and nothing else of it: compilers copy all of them by an instruction that
/// waits until what was written before, past the cache too, is in memory. `relative`: the squeezes are.
void set_as_own(const Coefficients& neighbor, const JointBlend& joint, bool relative,
                Coefficients& own) noexcept;

}  // namespace goffer::bend
