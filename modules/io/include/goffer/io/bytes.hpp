// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <string_view>

/// Numbers in a file's byte order.

namespace goffer::io {

/// Returns the number in the first bytes of `bytes`, which must have enough of them. Thread-safe.
template <class T>
[[nodiscard]] T from_bytes(std::string_view bytes, std::endian order = std::endian::little) {
    std::array<char, sizeof(T)> raw;
    std::copy_n(bytes.begin(), raw.size(), raw.begin());
    if (order != std::endian::native) std::ranges::reverse(raw);
    return std::bit_cast<T>(raw);
}

/// Appends the bytes of each value to `out`. Thread-safe.
template <class... T>
void append_bytes(std::string& out, std::endian order, T... values) {
    const auto append_one = [&](auto raw) {
        if (order != std::endian::native) std::ranges::reverse(raw);
        out.append(raw.data(), raw.size());
    };
    (append_one(std::bit_cast<std::array<char, sizeof(T)>>(values)), ...);
}

}  // namespace goffer::io
