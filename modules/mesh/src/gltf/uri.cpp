// SPDX-License-Identifier: MIT
#include "gltf.hpp"
#include "text.hpp"

namespace goffer::mesh::gltf {

namespace {

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::optional<std::string> from_base64(std::string_view text) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::array<unsigned char, 256> value;
    value.fill(64);
    for (std::size_t i = 0; i < 64; ++i)
        value[static_cast<unsigned char>(base64_digits[i])] = static_cast<unsigned char>(i);
    std::uint32_t bits = 0;
    int held = 0;
    for (const char letter : text) {
        const unsigned char digit = value[static_cast<unsigned char>(letter)];
        if (digit == 64) return std::nullopt;
        bits = (bits << 6) | digit;
        held += 6;
        if (held < 8) continue;
        held -= 8;
        bytes += static_cast<char>((bits >> held) & 0xff);
    }
    return bytes;
}

std::string to_base64(std::string_view bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            bits = (bits << 8) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const bool data = i + k <= bytes.size();  // 1 byte fills 2 digits, 2 bytes fill 3
            text += data ? base64_digits[(bits >> (18 - 6 * k)) & 63] : '=';
        }
    }
    return text;
}

int hex_digit(char letter) {
    if (letter >= '0' && letter <= '9') return letter - '0';
    if (letter >= 'a' && letter <= 'f') return letter - 'a' + 10;
    if (letter >= 'A' && letter <= 'F') return letter - 'A' + 10;
    return -1;
}

std::string percent_decoded(std::string_view text) {
    std::string bytes;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool escape = text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 &&
                            hex_digit(text[i + 2]) >= 0;
        if (!escape) {
            bytes += text[i];
            continue;
        }
        bytes += static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2]));
        i += 2;
    }
    return bytes;
}

}  // namespace

bool is_data_uri(std::string_view uri) {
    return uri.substr(0, 5) == "data:";
}

bool has_scheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');  // a scheme ends there, unless a folder comes first
    return colon != uri.npos && uri.find('/') > colon;
}

std::optional<std::string> data_of(std::string_view data_uri) {
    const std::size_t comma = data_uri.find(',');
    if (comma == data_uri.npos) return std::nullopt;
    const std::string_view data = data_uri.substr(comma + 1);
    return data_uri.substr(0, comma).ends_with(";base64") ? from_base64(data) : percent_decoded(data);
}

std::string data_uri(std::string_view mime_type, std::string_view bytes) {
    return "data:" + std::string(mime_type) + ";base64," + to_base64(bytes);
}

std::filesystem::path path_of(std::string_view uri) {
    const std::string bytes = percent_decoded(uri);
    return std::filesystem::path(std::u8string(bytes.begin(), bytes.end()));
}

std::string uri_of(const std::filesystem::path& relative) {
    constexpr std::string_view plain = "-._~/!$&'()*+,;=@";
    constexpr std::string_view hex = "0123456789ABCDEF";
    std::string uri;
    for (const char8_t unit : relative.generic_u8string()) {
        const auto letter = static_cast<unsigned char>(unit);
        const bool word = (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z') ||
                          (letter >= 'A' && letter <= 'Z');
        if (word || plain.find(static_cast<char>(letter)) != plain.npos) {
            uri += static_cast<char>(letter);
        } else {
            uri += {'%', hex[letter / 16], hex[letter % 16]};
        }
    }
    return uri;
}

}  // namespace goffer::mesh::gltf
