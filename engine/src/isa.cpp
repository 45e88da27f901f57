// SPDX-License-Identifier: MIT
#include <goffer/engine/isa.hpp>

#include <array>
#include <cstdint>

#if defined(GOFFER_HAS_SSE42) || defined(GOFFER_HAS_AVX2) || defined(GOFFER_HAS_AVX512)
#define GOFFER_HAS_X86
#include "saved_registers.hpp"

#include <xsimd/xsimd.hpp>
#endif

namespace goffer {
namespace {

constexpr Isa built[] = {
    Isa::scalar,
#ifdef GOFFER_HAS_SSE42
    Isa::sse42,
#endif
#ifdef GOFFER_HAS_AVX2
    Isa::avx2,
#endif
#ifdef GOFFER_HAS_AVX512
    Isa::avx512,
#endif
#ifdef GOFFER_HAS_NEON
    Isa::neon,
#endif
};

constexpr std::array<std::string_view, 6> names = {"auto", "scalar", "sse4.2", "avx2", "avx512", "neon"};

#ifdef GOFFER_HAS_X86

/// Which of the sets for x86-64 this machine can run.
struct Machine {
    bool sse42, avx2, avx512;
};

Machine look() noexcept {
    const auto processor = xsimd::available_architectures();
    const std::uint64_t saved = saved_registers();
    const bool wide = (saved & saves_256_bits) == saves_256_bits;
    const bool widest = (saved & saves_512_bits) == saves_512_bits;
    Machine machine;
    machine.sse42 = processor.sse4_2;
    machine.avx2 = wide && processor.avx2 && processor.fma3_avx2;
    machine.avx512 = widest && machine.avx2 && processor.avx512f && processor.avx512cd &&
                     processor.avx512dq && processor.avx512bw;
    return machine;
}

bool machine_has(Isa isa) noexcept {
    // Asked once: in a virtual machine the host answers cpuid, which takes longer than many a job.
    static const Machine machine = look();
    switch (isa) {
        case Isa::sse42:
            return machine.sse42;
        case Isa::avx2:
            return machine.avx2;
        case Isa::avx512:
            return machine.avx512;
        default:
            return isa == Isa::automatic || isa == Isa::scalar;
    }
}

#else

/// Every 64-bit Arm has NEON.
bool machine_has(Isa isa) noexcept {
    return isa == Isa::automatic || isa == Isa::scalar || isa == Isa::neon;
}

#endif

}  // namespace

std::span<const Isa> built_isas() noexcept {
    return built;
}

bool runs_here(Isa isa) noexcept {
    bool is_built = isa == Isa::automatic;
    for (const Isa candidate : built) is_built |= candidate == isa;
    return is_built && machine_has(isa);
}

Isa resolve(Isa isa) noexcept {
    if (isa != Isa::automatic) return isa;
    Isa best = Isa::scalar;
    for (const Isa candidate : built) {
        if (machine_has(candidate)) best = candidate;
    }
    return best;
}

std::string_view name(Isa isa) noexcept {
    const auto index = static_cast<std::size_t>(isa);
    return index < names.size() ? names[index] : std::string_view("unknown");
}

std::optional<Isa> parse_isa(std::string_view text) noexcept {
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == text) return static_cast<Isa>(i);
    }
    return std::nullopt;
}

}  // namespace goffer
