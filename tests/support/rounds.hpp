// SPDX-License-Identifier: MIT
#pragma once

#include "support/sanitized.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <type_traits>

namespace goffer::test {

/// Whether properties are tested in all rounds, or in a few: GOFFER_TEST_ROUNDS says "all" or "few". Without
/// it a few are enough for a sanitizer, which makes each take ten times as long.
inline bool all_rounds() {
    const char* wanted = std::getenv("GOFFER_TEST_ROUNDS");
    return wanted ? std::string_view(wanted) == "all" : !sanitized;
}

/// Whether an emulator runs the tests, which then take ten times as long as well.
#ifdef GOFFER_EMULATED
inline constexpr bool emulated = true;
#else
inline constexpr bool emulated = false;
#endif

/// How many rounds that is: on an emulator, a third of `few`. What is no number stays.
template <class T>
T rounds(T all, T few) {
    if (all_rounds()) return all;
    if constexpr (emulated && std::is_integral_v<T>) return std::max<T>(few / 3, 1);
    return few;
}

}  // namespace goffer::test
