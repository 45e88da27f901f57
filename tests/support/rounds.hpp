// SPDX-License-Identifier: MIT
#pragma once

#include "support/sanitized.hpp"

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

/// Whether an emulator runs the tests, which makes each take ten times as long, too.
#ifdef GOFFER_EMULATED
inline constexpr bool emulated = true;
#else
inline constexpr bool emulated = false;
#endif

/// How many of them that is: on an emulator, a third of a few.
template <class T>
T rounds(T all, T few) {
    if (all_rounds()) return all;
    if constexpr (emulated && std::is_integral_v<T>) return few > 3 ? few / 3 : 1;
    return few;
}

}  // namespace goffer::test
