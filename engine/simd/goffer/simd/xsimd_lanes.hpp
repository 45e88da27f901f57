// SPDX-License-Identifier: MIT
#pragma once

#include <xsimd/xsimd.hpp>

#include <cstddef>
#include <type_traits>

/// The operations that kernels are written in, on a batch of floats. Only a kernel's file for one instruction
/// set includes this. All is a template on the architecture, so that nothing compiled with that set's flags
/// has the name of something that another file compiles without them.

namespace goffer::simd {

template <class Arch>
struct XsimdLanes {
    using Vec = xsimd::batch<float, Arch>;
    static constexpr std::size_t width = Vec::size;

    static Vec set(float value) { return Vec(value); }
    static Vec load(const float* from) { return Vec::load_unaligned(from); }
    static void store(float* to, Vec value) { value.store_unaligned(to); }

    // xsimd 8.1 has no streaming store.
    static void stream(float* to, Vec value) {
#if defined(__SSE__)
        if constexpr (width == 4) _mm_stream_ps(to, value);
#if defined(__AVX__)
        if constexpr (width == 8) _mm256_stream_ps(to, value);
#endif
#if defined(__AVX512F__)
        if constexpr (width == 16) _mm512_stream_ps(to, value);
#endif
#else
        value.store_unaligned(to);
#endif
    }
    static void fence() {
#if defined(__SSE__)
        _mm_sfence();
#endif
    }
    static Vec madd(Vec a, Vec b, Vec c) {
        return xsimd::fma(a, b, c);
    }
    static Vec nmadd(Vec a, Vec b, Vec c) {
        return xsimd::fnma(a, b, c);
    }
    static Vec abs(Vec a) {
        return xsimd::abs(a);
    }
    static Vec clamp(Vec a, Vec low, Vec high) {
        return xsimd::min(xsimd::max(a, low), high);
    }

    /// The processor's estimate and Newton's steps: one from 12 bits, two from Arm's 8.
    static Vec rsqrt(Vec a) {
        Vec y = xsimd::rsqrt(a);
        constexpr int steps = std::is_base_of_v<xsimd::neon, Arch> ? 2 : 1;
        for (int step = 0; step < steps; ++step) y = y * madd(Vec(-0.5f) * a * y, y, Vec(1.5f));
        return y;
    }

    static Vec where_less(Vec a, Vec b, Vec yes, Vec no) {
        return xsimd::select(a < b, yes, no);
    }
};

}  // namespace goffer::simd
