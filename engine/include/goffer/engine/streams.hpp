// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

/// Output streams: the caller's memory, planar or interleaved, as pointers to components and one byte stride.

namespace goffer {

/// `N` floats per vertex. Component c of vertex i is at reinterpret_cast<std::byte*>(component[c]) + i *
/// stride.
///
/// The memory is the caller's, must be aligned to 4 bytes, and must hold `count` vertices. It is written and
/// never read. Streams of one job must not share a byte; members of the same records at different offsets
/// don't. A default-made stream, all null, is empty: not asked for.
template <std::size_t N>
struct Stream {
    float* component[N] = {};
    std::size_t stride = sizeof(float);  ///< bytes from one vertex to the next; at least 4, a multiple of 4
    std::size_t count = 0;               ///< vertices that the memory holds

    [[nodiscard]] bool empty() const noexcept {
        for (const float* first : component) {
            if (first != nullptr) return false;
        }
        return true;
    }
    [[nodiscard]] bool planar() const noexcept { return stride == sizeof(float); }
};

using Stream3 = Stream<3>;
using Stream4 = Stream<4>;

/// Three arrays x[], y[], z[] of the same length. The shortest span's length counts.
[[nodiscard]] inline Stream3 planar(std::span<float> x, std::span<float> y, std::span<float> z) noexcept {
    std::size_t count = x.size() < y.size() ? x.size() : y.size();
    count = count < z.size() ? count : z.size();
    return {{x.data(), y.data(), z.data()}, sizeof(float), count};
}

/// Four arrays, as `planar` above; for tangents with the bitangent's sign in w.
[[nodiscard]] inline Stream4 planar(std::span<float> x, std::span<float> y, std::span<float> z,
                                    std::span<float> w) noexcept {
    const Stream3 xyz = planar(x, y, z);
    return {
        {x.data(), y.data(), z.data(), w.data()}, sizeof(float), xyz.count < w.size() ? xyz.count : w.size()};
}

/// N consecutive floats per vertex, starting at `first`, `stride` bytes from vertex to vertex (0 stands for
/// tightly packed), `count` vertices.
template <std::size_t N>
[[nodiscard]] Stream<N> interleaved(float* first, std::size_t count, std::size_t stride = 0) noexcept {
    Stream<N> stream;
    for (std::size_t c = 0; c < N; ++c) stream.component[c] = first ? first + c : nullptr;
    stream.stride = stride ? stride : N * sizeof(float);
    stream.count = count;
    return stream;
}

}  // namespace goffer
