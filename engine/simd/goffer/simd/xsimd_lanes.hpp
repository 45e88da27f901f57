// SPDX-License-Identifier: MIT
#pragma once

#include <xsimd/xsimd.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

/// The operations that kernels are written in, on a batch of floats. Only a kernel's file for one instruction
/// set includes this. All is a template on the architecture, so that nothing compiled with that set's flags
/// has the name of something that another file compiles without them.

namespace goffer::simd {

template <class Arch>
struct XsimdLanes {
    using Vec = xsimd::batch<float, Arch>;
    static constexpr std::size_t width = Vec::size;
    using Single = XsimdLanes;
    static Vec single(Vec value, std::size_t /*part*/) { return value; }
    /// Of Newton's, after an estimate: one from 12 bits, two from Arm's 8.
    static constexpr int estimate_steps = std::is_base_of_v<xsimd::neon, Arch> ? 2 : 1;

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
    static void store_first(float* to, Vec value, std::size_t count) {
        if (count >= width) return store(to, value);
        alignas(64) float lanes[width];
        store(lanes, value);
        // In pieces of known size: a copy of any size is a call that costs more than all the batch.
        std::size_t done = 0;
        const auto piece = [&](auto size) {
            if ((count & size) == 0) return;
            std::memcpy(to + done, lanes + done, size * sizeof(float));
            done += size;
        };
        if constexpr (width > 8) piece(std::integral_constant<std::size_t, 8>());
        if constexpr (width > 4) piece(std::integral_constant<std::size_t, 4>());
        piece(std::integral_constant<std::size_t, 2>());
        piece(std::integral_constant<std::size_t, 1>());
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

    /// The processor's estimate and Newton's steps.
    static Vec rsqrt(Vec a) {
        Vec y = xsimd::rsqrt(a);
        for (int step = 0; step < estimate_steps; ++step) y = y * madd(a * y, Vec(-0.5f) * y, Vec(1.5f));
        return y;
    }

    static Vec where_less(Vec a, Vec b, Vec yes, Vec no) {
        return xsimd::select(a < b, yes, no);
    }
    static Vec larger(Vec a, Vec b) {
        return xsimd::max(a, b);
    }
    static Vec reciprocal(Vec a) {
        Vec y = xsimd::reciprocal(a);
        for (int step = 0; step < estimate_steps; ++step) y = y * nmadd(a, y, Vec(2.0f));
        return y;
    }
    static Vec with_sign(Vec magnitude, Vec sign) {
        return magnitude | (sign & Vec(-0.0f));
    }
    static Vec word(Vec value) {
        return xsimd::bitwise_cast<Vec>(xsimd::nearbyint_as_int(value));
    }
    static Vec pair_words(Vec low, Vec high) {
        using Words = xsimd::batch<std::int32_t, Arch>;
        const Words lower = xsimd::nearbyint_as_int(low) & Words(0xffff);
        return xsimd::bitwise_cast<Vec>(lower | (xsimd::nearbyint_as_int(high) << 16));
    }

    /// Lane l of the result is lane Picks::at(l) of `a`, or of `b` where that is `width` and more.
    template <class Picks>
    static Vec shuffle(Vec a, Vec b) {
        return shuffle<Picks>(a, b, std::make_index_sequence<width>());
    }

private:
    template <class Picks, std::size_t... lane>
    static Vec shuffle(Vec a, Vec b, std::index_sequence<lane...>) {
        return Vec(__builtin_shufflevector(a.data, b.data, Picks::at(static_cast<int>(lane))...));
    }
};

}  // namespace goffer::simd
