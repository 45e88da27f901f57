// SPDX-License-Identifier: MIT
#include "text.hpp"

#include <goffer/io/error.hpp>
#include <goffer/io/text.hpp>
#include <goffer/mesh/mesh.hpp>

#include <algorithm>
#include <array>
#include <charconv>

namespace goffer::mesh {
namespace {

bool continues_line(std::string_view text) {
    return text.starts_with("\\\n") || text.starts_with("\\\r") || text == "\\";
}

template <class Real>
void append_real(std::string& out, Real value) {
    std::array<char, 32> text;
    out.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
}

}  // namespace

void fail(const std::filesystem::path& file, const std::string& what) {
    throw Error(io::about(file, what));
}

std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 40;
    const auto is_inside = [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) == 0x80; };
    std::size_t length = std::min(text.size(), longest);
    while (length < text.size() && length > 0 && is_inside(text[length])) --length;  // no half of a character
    return "'" + io::escaped(text.substr(0, length)) + (text.size() > length ? "...'" : "'");
}

std::string line_of(std::string_view text, const char* place) {
    const std::string_view before = text.substr(0, static_cast<std::size_t>(place - text.data()));
    const auto feeds = std::ranges::count(before, '\n');
    return "line " + std::to_string(1 + (feeds > 0 ? feeds : std::ranges::count(before, '\r')));
}

std::string number_of(std::uint64_t count, std::string_view one, std::string_view several) {
    return std::to_string(count) + " " + std::string(count == 1 ? one : several);
}

std::string short_faces_warning(std::uint64_t faces) {
    return number_of(faces, "face has", "faces have") + " fewer than 3 corners: left out";
}

std::string not_finite_warning(std::uint64_t values) {
    return number_of(values, "uv or color value is", "uv or color values are") +
           " not finite: taken as 0, but kept in a file of the same format";
}

std::string_view next_token(std::string_view& rest) {
    while (!rest.empty() && (io::is_blank(rest.front()) || continues_line(rest))) rest.remove_prefix(1);
    std::size_t length = 0;
    while (length < rest.size() && !io::is_blank(rest[length]) && !continues_line(rest.substr(length)))
        ++length;
    const std::string_view token = rest.substr(0, length);
    rest.remove_prefix(length);
    return token;
}

std::string_view next_line(std::string_view& rest) {
    const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end);
    rest.remove_prefix(rest.starts_with("\r\n") ? 2 : rest.empty() ? 0 : 1);
    return line;
}

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return out;
}

void append(std::string& out, float value) {
    append_real(out, value);
}

void append(std::string& out, double value) {
    append_real(out, value);
}

void append(std::string& out, std::uint64_t value) {
    out += std::to_string(value);
}

void Editor::replace(std::string_view old, std::string_view with) {
    const auto place = static_cast<std::size_t>(old.data() - source_.data());
    out_ += source_.substr(done_, place - done_);
    out_ += with;
    done_ = place + old.size();
}

void Editor::replace(std::string_view old, float with) {
    std::string text;
    append(text, with);
    replace(old, text);
}

std::string Editor::finish() {
    out_ += source_.substr(done_);
    return std::move(out_);
}

}  // namespace goffer::mesh
