// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

/// Output streams: where a run writes its vectors, planar or interleaved.

namespace goffer {

/// `N` floats per vertex: component c of vertex i lies i * stride bytes after component[c].
///
/// The memory is the caller's. It must be aligned to 4 bytes and hold `count` vertices, and is never read.
/// Two streams of a job may be members of the same records, but must not share a byte. A default-constructed
/// stream, whose components are all null, is empty: the output is not asked for. A plain value that owns
/// nothing.
template <std::size_t N>
struct Stream {
    float* component[N] = {};
    std::size_t stride = sizeof(float);  ///< bytes from one vertex to the next: a multiple of 4, not 0
    std::size_t count = 0;               ///< vertices that the memory holds

    [[nodiscard]] bool empty() const noexcept {
        for (const float* first : component) {
            if (first != nullptr) return false;
        }
        return true;
    }
    /// Whether each component is an array of its own.
    [[nodiscard]] bool planar() const noexcept { return stride == sizeof(float); }
};

using Stream3 = Stream<3>;
using Stream4 = Stream<4>;

/// Three arrays x[], y[], z[]. They should be equally long; `count` is the length of the shortest.
[[nodiscard]] inline Stream3 planar(std::span<float> x, std::span<float> y, std::span<float> z) noexcept {
    std::size_t count = x.size() < y.size() ? x.size() : y.size();
    count = count < z.size() ? count : z.size();
    return {{x.data(), y.data(), z.data()}, sizeof(float), count};
}

/// The same with four arrays: for tangents, whose w is the bitangent's sign.
[[nodiscard]] inline Stream4 planar(std::span<float> x, std::span<float> y, std::span<float> z,
                                    std::span<float> w) noexcept {
    const Stream3 xyz = planar(x, y, z);
    return {
        {x.data(), y.data(), z.data(), w.data()}, sizeof(float), xyz.count < w.size() ? xyz.count : w.size()};
}

/// `count` vertices of N consecutive floats, the first vertex at `first`, `stride` bytes from one to the
/// next. A stride of 0 means N floats: no gaps. Null gives an empty stream.
template <std::size_t N>
[[nodiscard]] Stream<N> interleaved(float* first, std::size_t count, std::size_t stride = 0) noexcept {
    Stream<N> stream;
    for (std::size_t c = 0; c < N; ++c) stream.component[c] = first ? first + c : nullptr;
    stream.stride = stride ? stride : N * sizeof(float);
    stream.count = count;
    return stream;
}

}  // namespace goffer
