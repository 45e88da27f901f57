// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace goffer::simd {

template <class Visit, std::size_t... i>
constexpr void unrolled(const Visit& visit, std::index_sequence<i...>) {
    (visit(std::integral_constant<std::size_t, i>()), ...);
}

/// Calls visit(i) with the constants i = 0, 1, .., count - 1. For short loops over registers: where a
/// compiler leaves such a loop rolled, as g++ does with -O2, an array of registers stays in memory.
template <std::size_t count, class Visit>
constexpr void unrolled(const Visit& visit) {
    unrolled(visit, std::make_index_sequence<count>());
}

}  // namespace goffer::simd
