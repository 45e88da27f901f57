// SPDX-License-Identifier: MIT
#pragma once

#include <xsimd/xsimd.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

/// The operations that kernels are written in, on a batch of floats; ScalarLanes documents them. Only the
/// kernel file of an instruction set may include this. All of it is a template on the architecture, so that
/// nothing compiled with the flags of one set shares its name with code compiled without them.

namespace goffer::simd {

template <class Arch>
struct XsimdLanes {
    using Vec = xsimd::batch<float, Arch>;
    static constexpr std::size_t width = Vec::size;
    using Single = XsimdLanes;
    static Vec single(Vec value, std::size_t /*part*/) { return value; }
    /// Newton's steps after an estimate: one where it has 12 bits, two for the 8 bits of Arm.
    static constexpr int estimate_steps = std::is_base_of_v<xsimd::neon, Arch> ? 2 : 1;

    static Vec splat(float value) { return Vec(value); }
    static Vec load(const float* from) { return Vec::load_unaligned(from); }
    static void store(float* to, Vec value) { value.store_unaligned(to); }

    // xsimd 8.1 has no streaming stores.
    static void stream(float* to, Vec value) {
#if XSIMD_WITH_SSE2
        if constexpr (width == 4) _mm_stream_ps(to, value);
#if XSIMD_WITH_AVX
        if constexpr (width == 8) _mm256_stream_ps(to, value);
#endif
#if XSIMD_WITH_AVX512F
        if constexpr (width == 16) _mm512_stream_ps(to, value);
#endif
#else
        value.store_unaligned(to);
#endif
    }
    // A function that does nothing else has no effect in the eyes of g++ 12, which drops calls of it that it
    // has not inlined early: the empty statement is one.
    static void prefetch(const float* at) {
#if defined(__GNUC__)
        asm volatile("" : : "r"(at));
#endif
#if defined(__SSE__)
        _mm_prefetch(reinterpret_cast<const char*>(at), _MM_HINT_T0);
#elif defined(__GNUC__)
        __builtin_prefetch(at, 1);
#endif
    }
    static void store_first(float* to, Vec value, std::size_t count) {
        if (count >= width) return store(to, value);
        alignas(64) float lanes[width];
        store(lanes, value);
        // In pieces of known size: a copy of unknown size is a call that costs more than the whole batch.
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

    /// Refines the processor's estimate, whose last bits are the maker's choice.
    static Vec rsqrt(Vec a) {
        Vec y = xsimd::rsqrt(a);
        for (int step = 0; step < estimate_steps; ++step) y = y * madd(a * y, Vec(-0.5f) * y, Vec(1.5f));
        return y;
    }

    static Vec where_less(Vec a, Vec b, Vec yes, Vec no) {
        return xsimd::select(a < b, yes, no);
    }
    static Vec max(Vec a, Vec b) {
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
        return bits(xsimd::nearbyint_as_int(value));
    }
    static Vec pack_int16(Vec low, Vec high) {
        const Words lower = xsimd::nearbyint_as_int(low) & Words(0xffff);
        return bits(lower | (xsimd::nearbyint_as_int(high) << 16));
    }

    static Vec min(Vec a, Vec b) {
        return xsimd::min(a, b);
    }
    static Vec sqrt(Vec a) {
#if defined(__aarch64__)
        return Vec(vsqrtq_f32(a));  // xsimd's sqrt is an estimate on Arm
#else
        return xsimd::sqrt(a);
#endif
    }

    // Rows for registers of four lanes. Avx2Lanes and Avx512Lanes have their own.
    using Row = Vec;
    /// Sets rows[i] to the rows (a, b, c, d) of lanes i, i + 4, i + 8 ..
    static void make_rows(Vec a, Vec b, Vec c, Vec d, Vec (&rows)[4]) {
        static_assert(width == 4);
        const Vec ac_low = xsimd::zip_lo(a, c), ac_high = xsimd::zip_hi(a, c);
        const Vec bd_low = xsimd::zip_lo(b, d), bd_high = xsimd::zip_hi(b, d);
        rows[0] = xsimd::zip_lo(ac_low, bd_low);
        rows[1] = xsimd::zip_hi(ac_low, bd_low);
        rows[2] = xsimd::zip_lo(ac_high, bd_high);
        rows[3] = xsimd::zip_hi(ac_high, bd_high);
    }
    template <class Visit>
    static void for_rows(Vec a, Vec b, Vec c, Vec d, const Visit& visit) {
        Vec rows[4];
        make_rows(a, b, c, d, rows);
        for (std::size_t i = 0; i < 4; ++i) visit(i, rows[i]);
    }
    static Row first_row(Vec a, Vec b, Vec c, Vec d) {
        return xsimd::zip_lo(xsimd::zip_lo(a, c), xsimd::zip_lo(b, d));
    }
    static Row mixed_row(const float* from, const float* to, float weight, float factor) {
        return Vec(factor) * (load(from) + Vec(weight) * (load(to) - load(from)));
    }
    static Row row_times(Row row, const float* factors) {
        return row * load(factors);
    }
    static void store_row(float* to, Vec row) {
        store(to, row);
    }
    template <std::size_t count>
    static void store_row_first(float* to, Vec row) {
        alignas(16) float values[4];
        row.store_aligned(values);
        std::memcpy(to, values, count * sizeof(float));
    }

    /// Lane l of the result is lane i = Picks::at(l) of `a`, or lane i - width of `b` where i >= width.
    template <class Picks>
    static Vec shuffle(Vec a, Vec b) {
        return shuffle<Picks>(a, b, std::make_index_sequence<width>());
    }

private:
    using Words = xsimd::batch<std::int32_t, Arch>;
    static Vec bits(Words words) {
#if XSIMD_VERSION_MAJOR >= 11
        return xsimd::bitwise_cast<float>(words);
#else
        return xsimd::bitwise_cast<Vec>(words);
#endif
    }

    template <class Picks, std::size_t... lane>
    static Vec shuffle(Vec a, Vec b, std::index_sequence<lane...>) {
        return Vec(__builtin_shufflevector(a.data, b.data, Picks::at(static_cast<int>(lane))...));
    }
};

}  // namespace goffer::simd
