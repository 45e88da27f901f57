// SPDX-License-Identifier: MIT
#pragma once

#include "support/sanitized.hpp"

#include <cstdlib>
#include <string_view>

namespace goffer::test {

/// Whether properties are tested in all rounds, or in a few: GOFFER_TEST_ROUNDS says "all" or "few". Without
/// it a few are enough for a sanitizer, which makes each take ten times as long.
inline bool all_rounds() {
    const char* wanted = std::getenv("GOFFER_TEST_ROUNDS");
    return wanted ? std::string_view(wanted) == "all" : !sanitized;
}

/// How many of them that is.
template <class T>
T rounds(T all, T few) {
    return all_rounds() ? all : few;
}

}  // namespace goffer::test
