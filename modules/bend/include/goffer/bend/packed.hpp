// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

/// The packed stream: position and normal in 12 bytes a vertex, for a GPU to decode.
///
/// The GPU's side is goffer/bend/packed.glsl: two functions in GLSL, which are also valid C++ with GLM (that
/// is how the tests run them).

namespace goffer::bend {

/// A vertex in 12 bytes: as vertex attributes R16G16B16A16_UNORM and R16G16_SNORM, or as three 32-bit words.
struct PackedVertex {
    /// Position in steps of the instance's bounds: low + position / 65535 (high - low) on each axis, with the
    /// Bounds that bounds(job) gives. Rounded to nearest: off by half a step, 1 / 131070 of the bounds'
    /// length, beside what the float kernels are off.
    std::uint16_t position[3];
    std::uint16_t unused;  ///< 0
    /// The unit normal, octahedral: (x, y) / (|x| + |y| + |z|), the lower half folded outward, in steps of 1
    /// / 32767. Off by less than 0.004 degrees.
    std::int16_t normal[2];
};

static_assert(sizeof(PackedVertex) == 12 && alignof(PackedVertex) == 2);

/// Where packed vertices go. The memory is the caller's, aligned to 4 bytes, for `count` vertices. A
/// default-made stream is empty: not asked for.
struct PackedStream {
    PackedVertex* first = nullptr;
    std::size_t stride =
        sizeof(PackedVertex);  ///< bytes from one vertex to the next; at least 12, a multiple of 4
    std::size_t count = 0;     ///< vertices that the memory holds

    [[nodiscard]] bool empty() const noexcept { return first == nullptr; }
};

}  // namespace goffer::bend
