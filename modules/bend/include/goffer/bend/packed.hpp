// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

/// The packed stream: position and normal in 12 bytes per vertex, for a GPU to decode.
///
/// goffer/bend/packed.glsl decodes it, from vertex attributes or from words, and packed.hlsl does in HLSL.
/// With GLM's types both are also valid C++, which is how the tests run them.

namespace goffer::bend {

/// A vertex in 12 bytes, to be read as the attributes R16G16B16A16_UNORM and R16G16_SNORM, or as three 32-bit
/// words, little-endian. In the space of the job's outputs.
struct PackedVertex {
    /// Position within the instance's bounds(job): low + position / 65535 (high - low) on each axis. Rounding
    /// adds up to half a step, 1 / 131070 of the bounds' length, to the error of the float kernels. 0 on an
    /// axis where the bounds are shorter than 1e-33 or longer than 1e38.
    std::uint16_t position[3];
    std::uint16_t unused;  ///< 0
    /// The unit normal in octahedral coordinates: (x, y) / (|x| + |y| + |z|), the lower half folded outward,
    /// in steps of 1 / 32767. Off by less than 0.004 degrees. Where a transform leaves a normal no length, it
    /// is that of z.
    std::int16_t normal[2];
};

static_assert(sizeof(PackedVertex) == 12 && alignof(PackedVertex) == 2);

/// Where packed vertices go. The memory is the caller's. It must be aligned to 4 bytes and hold `count`
/// vertices, and is never read. A default-constructed stream is empty: the output is not asked for. A plain
/// value that owns nothing.
struct PackedStream {
    PackedVertex* first = nullptr;
    /// Bytes from one vertex to the next: a multiple of 4, at least 12.
    std::size_t stride = sizeof(PackedVertex);
    std::size_t count = 0;  ///< vertices that the memory holds

    [[nodiscard]] bool empty() const noexcept { return first == nullptr; }
};

}  // namespace goffer::bend
