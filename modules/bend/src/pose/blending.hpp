// SPDX-License-Identifier: MIT
#pragma once

#include "body/body_data.hpp"
#include "kernel/args.hpp"

#include <cstddef>

namespace goffer::bend {

/// What a kernel of planes or records is called with for some vertices.
struct KernelInput {
    const RestColumns* columns;
    const Coefficients* k;
    Squeeze squeeze;
    std::size_t first;  ///< where their columns begin
};

/// Coefficients and squeezes of an instance, one per region.
struct PosedRegions {
    const Coefficients* k;
    const Squeeze* squeezes;
};

/// Vertices near a joint, with their wrinkles, for kernels that add none. Lives on the stack; 6 KB.
class Blending {
public:
    /// Wrinkles `count` vertices of region `r` from `first` on, at most BlendColumns::vertices. Those that
    /// are not near `joint` become what kernels make of them without it, bit for bit. `in_lines`: the kernel
    /// will begin with a whole unit, or does not care for lines. The result is valid until the next call.
    [[nodiscard]] KernelInput blend(const BodyData& body, const KernelSet& kernels, std::size_t r,
                                    const Joint& joint, const PosedRegions& posed, StreamSet streams,
                                    std::size_t first, std::size_t count, bool in_lines) noexcept;

private:
    void set_columns(const RestColumns& rest, StreamSet streams, std::size_t first) noexcept;

    // Both are reused by all calls, each of which sets what is read. Compilers clear and copy objects of that
    // size by one instruction, which waits until what was written before, past the cache too, is in memory.
    RestColumns columns_;
    BlendColumns blended_;
};

}  // namespace goffer::bend
