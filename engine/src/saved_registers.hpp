// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#if !defined(__GNUC__) && !defined(__clang__)
#include <intrin.h>
#endif

/// Which registers the operating system saves on x86-64. A processor may have registers that an old system or
/// a virtual machine does not save for its threads. xsimd 8.1 does not ask.

namespace goffer {

/// Bits of saved_registers(): both halves of the AVX registers; for 512 bits also the masks, the upper halves
/// and the registers 16 to 31.
constexpr std::uint64_t saves_256_bits = 0x06;
constexpr std::uint64_t saves_512_bits = 0xe6;

/// The registers that the system saves when it switches threads, as the bits of XCR0. 0 where it cannot be
/// asked. Thread-safe.
[[nodiscard]] inline std::uint64_t saved_registers() noexcept {
    constexpr std::uint32_t answers = 1u << 27;  // OSXSAVE in ecx of leaf 1: without it, xgetbv faults
#if defined(__GNUC__) || defined(__clang__)
    // volatile: an instruction that may fault does not move above the test for it.
    std::uint32_t a = 1, b = 0, c = 0, d = 0;
    __asm__ volatile("cpuid" : "+a"(a), "=b"(b), "+c"(c), "=d"(d));
    if ((c & answers) == 0) return 0;
    std::uint32_t low = 0, high = 0;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return std::uint64_t{high} << 32 | low;
#else
    int words[4];
    __cpuid(words, 1);
    return (static_cast<std::uint32_t>(words[2]) & answers) == 0 ? 0 : _xgetbv(0);
#endif
}

}  // namespace goffer
