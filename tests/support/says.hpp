// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace goffer::test {

/// Whether `text` holds `words`.
inline bool says(const std::string& text, std::string_view words) {
    return text.find(words) != std::string::npos;
}

}  // namespace goffer::test
