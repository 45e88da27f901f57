// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace goffer::test {

/// Values taken from a fuzzer's bytes, front to back: zeros where these have ended. (libFuzzer's own class of
/// this kind comes with clang alone.)
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

    [[nodiscard]] bool empty() const { return left_.empty(); }

    /// Gives half of what is left away, so that what takes much does not leave nothing.
    [[nodiscard]] Bytes half() {
        const std::size_t kept = left_.size() / 2;
        const Bytes given(left_.data() + kept, left_.size() - kept);
        left_ = left_.first(kept);
        return given;
    }

    std::uint8_t byte() {
        if (left_.empty()) return 0;
        const std::uint8_t first = left_.front();
        left_ = left_.subspan(1);
        return first;
    }
    bool flag() { return (byte() & 1) != 0; }

    /// Below `count`, which is 1 to 65536.
    std::size_t below(std::size_t count) {
        const std::size_t high = count > 256 ? byte() : 0u;
        return (256 * high + byte()) % count;
    }

    template <class T, std::size_t N>
    T one_of(const T (&values)[N]) {
        return values[below(N)];
    }

    /// Within low..high, in steps of a 65535th.
    double within(double low, double high) {
        return low + (high - low) * static_cast<double>(below(65536)) / 65535;
    }

    /// A power of ten, and which one.
    double magnitude(double low, double high) { return std::pow(10, within(low, high)); }

    /// Any bits, among them the edges of what floats are.
    float any_float() {
        using Limits = std::numeric_limits<float>;
        constexpr float edges[] = {0,
                                   -0.0f,
                                   1,
                                   1e6f,
                                   -1e18f,
                                   Limits::max(),
                                   -1e30f,
                                   Limits::min(),
                                   Limits::denorm_min(),
                                   1000,
                                   1e-20f,
                                   Limits::infinity(),
                                   -3.2f,
                                   -Limits::infinity(),
                                   Limits::quiet_NaN()};
        if (flag()) return one_of(edges);
        std::uint32_t bits = 0;
        for (int i = 0; i < 4; ++i) bits = bits << 8 | byte();
        return std::bit_cast<float>(bits);
    }

private:
    std::span<const std::uint8_t> left_;
};

}  // namespace goffer::test
