// SPDX-License-Identifier: MIT
#include <goffer/io/error.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace goffer::io {
namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};

struct Character {
    std::uint32_t code = none;  ///< none: these bytes are no UTF-8
    std::size_t length = 1;
};

/// The first character of `text`, which is not empty.
Character first_of(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::uint32_t lead = byte(0);
    if (lead < 0x80) return {lead, 1};
    const std::size_t length = lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return {};
    std::uint32_t code = lead & (0x7fu >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if (byte(i) < 0x80 || byte(i) > 0xbf) return {};
        code = code << 6 | (byte(i) & 0x3fu);
    }
    constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    return code < least[length] || code > 0x10ffff || surrogate ? Character{} : Character{code, length};
}

/// Whether a terminal does something else with a character than to show it: control characters, ends of
/// lines and paragraphs, and those that turn the direction of what follows.
bool commands(std::uint32_t code) {
    return code < ' ' || (code >= 127 && code < 0xa0) || code == 0x200e || code == 0x200f ||
           (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

std::string one_line(std::string_view text) {
    std::string out(text);
    std::ranges::replace_if(
        out, [](char c) { return (c >= 0 && c < ' ') || c == 127; }, '_');
    return out;
}

std::string escaped(std::string_view text) {
    constexpr std::string_view hex = "0123456789abcdef";
    std::string out;
    while (!text.empty()) {
        const auto [code, length] = first_of(text);
        if (code != none && !commands(code)) {
            out += text.substr(0, length);
        } else {
            for (const char c : text.substr(0, length)) {
                const auto byte = static_cast<unsigned char>(c);
                out += {'\\', 'x', hex[byte / 16], hex[byte % 16]};
            }
        }
        text.remove_prefix(length);
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
