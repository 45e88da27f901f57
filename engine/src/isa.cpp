// SPDX-License-Identifier: MIT
#include <goffer/engine/isa.hpp>

#include <array>

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

// The compiler's own test, not xsimd's: it also asks the system whether it saves the wide registers.
bool processor_has(Isa isa) noexcept {
    switch (isa) {
#if defined(__x86_64__)
        case Isa::sse42:
            return __builtin_cpu_supports("sse4.2");
        case Isa::avx2:
            return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
        case Isa::avx512:
            return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
                   __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#elif defined(__aarch64__)
        case Isa::neon:
            return true;
#endif
        default:
            return isa == Isa::automatic || isa == Isa::scalar;
    }
}

}  // namespace

std::span<const Isa> built_isas() noexcept {
    return built;
}

bool runs_here(Isa isa) noexcept {
    bool is_built = isa == Isa::automatic;
    for (const Isa candidate : built) is_built |= candidate == isa;
    return is_built && processor_has(isa);
}

Isa resolve(Isa isa) noexcept {
    if (isa != Isa::automatic) return isa;
    Isa best = Isa::scalar;
    for (const Isa candidate : built) {
        if (processor_has(candidate)) best = candidate;
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
