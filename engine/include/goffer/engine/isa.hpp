// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

/// Instruction sets: which kernels this build has, and which of them this machine can run. All functions are
/// thread-safe and do not allocate.

namespace goffer {

/// The instruction set that a job's kernels use. Among the sets of one architecture, a later one is wider.
enum class Isa : std::uint8_t {
    automatic,  ///< the widest set that was built and that processor and system support
    scalar,     ///< portable C++, one vertex at a time: runs on every machine
    sse42,      ///< x86-64, 4 lanes
    avx2,       ///< x86-64, 8 lanes, with FMA
    avx512,     ///< x86-64, 16 lanes (F, CD, DQ, BW)
    neon,       ///< 64-bit Arm, 4 lanes
};

/// Whether kernels for `isa` were built and can run on this machine. Always true for automatic and scalar.
[[nodiscard]] bool runs_here(Isa isa) noexcept;

/// Replaces `automatic` with the set that it chooses on this machine. Returns any other set unchanged,
/// whether or not it runs here.
[[nodiscard]] Isa resolve(Isa isa) noexcept;

/// The sets that kernels were built for, in the order of Isa; scalar is always one of them. Static storage.
[[nodiscard]] std::span<const Isa> built_isas() noexcept;

/// "auto", "scalar", "sse4.2", "avx2", "avx512" or "neon"; "unknown" for any other value. Static storage.
[[nodiscard]] std::string_view name(Isa isa) noexcept;

/// The set that has exactly this name(), or nothing.
[[nodiscard]] std::optional<Isa> parse_isa(std::string_view name) noexcept;

}  // namespace goffer
