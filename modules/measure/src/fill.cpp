// SPDX-License-Identifier: MIT
#include <goffer/engine/columns.hpp>
#include <goffer/engine/parallel.hpp>
#include <goffer/measure/fill.hpp>
#include <goffer/simd/fence.hpp>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__) || defined(_M_X64)
#define GOFFER_STREAMS
#include <emmintrin.h>
#endif

namespace goffer::measure {
namespace {

constexpr std::size_t line_floats = column_alignment / sizeof(float);

bool starts_line(const float* at) noexcept {
    return reinterpret_cast<std::uintptr_t>(at) % column_alignment == 0;
}

/// Four lines of different numbers. From the first-level cache, since two vectors of it are read in the time
/// that one is stored; arithmetic on counters would take longer.
class Pattern {
public:
    explicit Pattern(float seed) noexcept {
        // 2^32 / golden ratio, and the bits of 1.0f.
        constexpr std::uint32_t apart = 0x9e3779b1, one = 0x3f800000;
        std::uint32_t bits = std::bit_cast<std::uint32_t>(seed) * apart;
        for (float& number : numbers_) number = std::bit_cast<float>(one | (bits += apart) >> 9);
    }

    /// What belongs to `place`, and behind it as far as its line goes.
    [[nodiscard]] const float* at(const float* place) const noexcept {
        return numbers_ + reinterpret_cast<std::uintptr_t>(place) / sizeof(float) % count;
    }

private:
    static constexpr std::size_t count = 4 * line_floats;
    alignas(column_alignment) float numbers_[count];
};

void store_line(const float* from, float* to) noexcept {
    std::memcpy(to, from, column_alignment);
}

/// `to` is where a line begins.
void stream_line(const float* from, float* to) noexcept {
#ifdef GOFFER_STREAMS
    for (std::size_t i = 0; i < line_floats; i += 4) _mm_stream_ps(to + i, _mm_loadu_ps(from + i));
#else
    store_line(from, to);
#endif
}

/// Sets each float of `to` to *from(its address): alone, or by `line` where a whole line begins.
template <class From, class Line>
void write(std::span<float> to, const From& from, const Line& line) noexcept {
    float* at = to.data();
    float* const end = at + to.size();
    for (; at != end && !starts_line(at); ++at) *at = *from(at);
    for (; end - at >= static_cast<std::ptrdiff_t>(line_floats); at += line_floats) line(from(at), at);
    for (; at != end; ++at) *at = *from(at);
}

template <class From>
void write(std::span<float> to, bool non_temporal, const From& from) noexcept {
    if (!non_temporal) return write(to, from, [](const float* a, float* b) { store_line(a, b); });
    write(to, from, [](const float* a, float* b) { stream_line(a, b); });
    simd::fence();
}

/// Calls `part` for all of [0, count): at once, or in ranges of whole lines for the threads to share.
template <class Part>
void share(std::size_t count, int threads, const Part& part) {
    if (threads <= 1) {
        part(0, count);
        return;
    }
    constexpr std::size_t most = 16384;  // lines of a range: a megabyte
    const std::size_t lines = (count + line_floats - 1) / line_floats;
    const std::size_t grain = std::clamp<std::size_t>(lines / static_cast<std::size_t>(threads), 1, most);
    parallel_ranges(lines, grain, [&](std::size_t first, std::size_t last) {
        part(first * line_floats, std::min(last * line_floats, count));
    });
}

}  // namespace

void fill(std::span<float> to, float seed, bool non_temporal) noexcept {
    const Pattern pattern(seed);
    write(to, non_temporal, [&](const float* place) { return pattern.at(place); });
}

void copy(std::span<const float> from, std::span<float> to, bool non_temporal) noexcept {
    assert(from.size() <= to.size());
    if (!non_temporal) {
        if (!from.empty()) std::memcpy(to.data(), from.data(), from.size_bytes());
        return;
    }
    const float* const begin = to.data();
    write(to.first(from.size()), true, [&](const float* place) { return from.data() + (place - begin); });
}

void fill(std::span<float> to, float seed, bool non_temporal, int threads) {
    share(to.size(), threads, [&](std::size_t first, std::size_t last) {
        fill(to.subspan(first, last - first), seed, non_temporal);
    });
}

void copy(std::span<const float> from, std::span<float> to, bool non_temporal, int threads) {
    share(from.size(), threads, [&](std::size_t first, std::size_t last) {
        copy(from.subspan(first, last - first), to.subspan(first, last - first), non_temporal);
    });
}

}  // namespace goffer::measure
