// SPDX-License-Identifier: MIT
#include <goffer/io/error.hpp>

#include <algorithm>

namespace goffer::io {

std::string one_line(std::string_view text) {
    std::string out(text);
    std::ranges::replace_if(
        out, [](char c) { return (c >= 0 && c < ' ') || c == 127; }, '_');
    return out;
}

std::string about(const std::filesystem::path& file, std::string_view what) {
    return one_line(file.string()).append(": ").append(what);
}

}  // namespace goffer::io
