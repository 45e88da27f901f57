// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace goffer::test {

/// Ends the program where something does not hold: that is what a fuzzer counts as a find.
inline void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "does not hold: %s\n", what);
    std::abort();
}

/// What an error says has to be one line.
inline void require_one_line(std::string_view text) {
    require(!text.empty() && text.find('\n') == text.npos, "an error is one line");
}

}  // namespace goffer::test
