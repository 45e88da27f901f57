// SPDX-License-Identifier: MIT
#include <goffer/engine/columns.hpp>
#include <goffer/engine/fill.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace goffer {
namespace {

#if defined(__SSE2__)

constexpr std::size_t line_floats = column_alignment / sizeof(float);

std::size_t floats_before_line(const float* at) noexcept {
    const std::size_t past = reinterpret_cast<std::uintptr_t>(at) % column_alignment;
    return past == 0 ? 0 : (column_alignment - past) / sizeof(float);
}

// `to` starts on a line and is whole lines.
void stream_lines(std::span<float> to, float value) noexcept {
    const __m128 values = _mm_set1_ps(value);
    float* const end = to.data() + to.size();
    for (float* line = to.data(); line != end; line += line_floats) {
        _mm_stream_ps(line, values);
        _mm_stream_ps(line + 4, values);
        _mm_stream_ps(line + 8, values);
        _mm_stream_ps(line + 12, values);
    }
    _mm_sfence();  // these stores are not ordered with those that tell another thread that all is done
}

void fill_streaming(std::span<float> to, float value) noexcept {
    const std::size_t before = std::min(floats_before_line(to.data()), to.size());
    const std::size_t lines = (to.size() - before) / line_floats * line_floats;
    std::ranges::fill(to.first(before), value);
    stream_lines(to.subspan(before, lines), value);
    std::ranges::fill(to.subspan(before + lines), value);
}

#else

void fill_streaming(std::span<float> to, float value) noexcept {
    std::ranges::fill(to, value);
}

#endif

}  // namespace

void fill(std::span<float> to, float value, bool streaming) noexcept {
    if (streaming) {
        fill_streaming(to, value);
    } else {
        std::ranges::fill(to, value);
    }
}

}  // namespace goffer
