// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

/// Instruction sets: which kernels this build has, and which of them this machine can run.

namespace goffer {

/// The instruction set that a job's kernels use. Ordered: a later one is wider.
enum class Isa : std::uint8_t {
    automatic,  ///< the widest that was built and that the processor and the system support
    scalar,     ///< portable C++, one vertex at a time; on every machine, and the readable statement of the
                ///< kernel
    sse42,      ///< x86-64, 4 lanes
    avx2,       ///< x86-64, 8 lanes, with FMA
    avx512,     ///< x86-64, 16 lanes (F, CD, DQ, BW)
    neon,       ///< 64-bit Arm, 4 lanes
};

/// Whether kernels for `isa` were built and can run here. True for automatic and scalar. Thread-safe.
[[nodiscard]] bool runs_here(Isa isa) noexcept;

/// The set that `automatic` stands for on this machine; any other set is returned as it is. Thread-safe.
[[nodiscard]] Isa resolve(Isa isa) noexcept;

/// The sets that kernels were built for, narrowest first, scalar always among them. Static storage.
/// Thread-safe.
[[nodiscard]] std::span<const Isa> built_isas() noexcept;

/// "auto", "scalar", "sse4.2", "avx2", "avx512" or "neon". Static storage. Thread-safe.
[[nodiscard]] std::string_view name(Isa isa) noexcept;

/// The set of that name, or nothing. Thread-safe.
[[nodiscard]] std::optional<Isa> parse_isa(std::string_view name) noexcept;

}  // namespace goffer
