// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec2.hpp>

#include <cstdint>

namespace goffer::view {

/// Low-discrepancy points: the Sobol (0,2)-sequence under hash-based Owen scrambling (Burley 2020). The n-th
/// pair of a pixel's k-th sample depends on the pixel, n and k alone, so pictures do not depend on the order
/// of the work.
class Sampler {
public:
    Sampler(std::uint32_t pixel, std::uint32_t sample) : seed_(hash(pixel)), sample_(sample) {}

    /// The next pair of numbers in [0, 1)^2.
    [[nodiscard]] glm::vec2 next() { return point(sample_); }

    /// The `i`-th of the next `count` pairs, for samples that take as many each: those of all samples are
    /// spread evenly as one set.
    [[nodiscard]] glm::vec2 next(std::uint32_t i, std::uint32_t count) {
        if (i > 0) --pair_;
        return point(sample_ * count + i);
    }

private:
    static std::uint32_t hash(std::uint32_t x) {
        x = (x ^ (x >> 16)) * 0x7feb352du;
        x = (x ^ (x >> 15)) * 0x846ca68bu;
        return x ^ (x >> 16);
    }

    static std::uint32_t reversed(std::uint32_t x) {
        x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
        x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
        x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
        x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
        return (x >> 16) | (x << 16);
    }

    // Owen scrambling of a number whose first binary digit is its lowest bit (Laine and Karras 2011).
    static std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
        x += seed;
        x ^= x * 0x6c50b47cu;
        x ^= x * 0xb82f1e52u;
        x ^= x * 0xc7afe638u;
        return x ^ (x * 0x8d22f6e6u);
    }

    // The sequence's second dimension, first digit lowest: bit i is the sum of the bits j of `index` with odd
    // binomial coefficient (j over i), that is where the bits of j contain those of i. (The first dimension
    // is the index itself.)
    static std::uint32_t second_dimension(std::uint32_t index) {
        index ^= (index >> 1) & 0x55555555u;
        index ^= (index >> 2) & 0x33333333u;
        index ^= (index >> 4) & 0x0f0f0f0fu;
        index ^= (index >> 8) & 0x00ff00ffu;
        return index ^ (index >> 16);
    }

    static float to_unit(std::uint32_t x) { return static_cast<float>(reversed(x) >> 8) * 0x1p-24f; }

    glm::vec2 point(std::uint32_t index) {
        const std::uint32_t seed = hash(seed_ + 0x9e3779b9u * ++pair_);
        const std::uint32_t shuffled = reversed(scrambled(reversed(index), seed));
        return {to_unit(scrambled(shuffled, hash(seed ^ 1u))),
                to_unit(scrambled(second_dimension(shuffled), hash(seed ^ 2u)))};
    }

    std::uint32_t seed_;
    std::uint32_t sample_;
    std::uint32_t pair_ = 0;
};

}  // namespace goffer::view
