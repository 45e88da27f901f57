// SPDX-License-Identifier: MIT
#include <goffer/io/error.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace goffer::io {

std::string one_line(std::string_view text) {
    std::string out(text);
    std::ranges::replace_if(
        out, [](char c) { return (c >= 0 && c < ' ') || c == 127; }, '_');
    return out;
}

std::string escaped(std::string_view text) {
    constexpr std::string_view hex = "0123456789abcdef";
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const unsigned char before = i > 0 ? static_cast<unsigned char>(text[i - 1]) : 0;
        // In UTF-8 the bytes 0xc2 0x80 to 0xc2 0x9f are control characters too.
        const bool control = byte < ' ' || byte == 127 || (before == 0xc2 && byte >= 0x80 && byte < 0xa0);
        if (control) {
            out += {'\\', 'x', hex[byte / 16], hex[byte % 16]};
        } else {
            out += text[i];
        }
    }
    return out;
}

std::string size_text(std::uint64_t bytes) {
    constexpr std::array<std::pair<const char*, int>, 3> units{{{" GiB", 30}, {" MiB", 20}, {" KiB", 10}}};
    for (const auto& [name, bits] : units) {
        if (bytes != 0 && bytes % (std::uint64_t{1} << bits) == 0)
            return std::to_string(bytes >> bits) + name;
    }
    return std::to_string(bytes) + " bytes";
}

std::string about(const std::filesystem::path& file, std::string_view what) {
    return escaped(file.string()).append(": ").append(what);
}

}  // namespace goffer::io
