// SPDX-License-Identifier: MIT
#include <goffer/io/ending.hpp>

#include <algorithm>

namespace goffer::io {

std::string ending_of(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return ending;
}

}  // namespace goffer::io
