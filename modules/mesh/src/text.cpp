// SPDX-License-Identifier: MIT
#include "text.hpp"

#include <goffer/io/error.hpp>
#include <goffer/mesh/mesh.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

namespace goffer::mesh {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

bool continues_line(std::string_view text) {
    return text.starts_with("\\\n") || text.starts_with("\\\r") || text == "\\";
}

/// from_chars refuses the plus sign that files may have.
std::string_view without_plus(std::string_view token) {
    return token.starts_with('+') && !token.starts_with("+-") ? token.substr(1) : token;
}

/// Whether the decimal number `token`, which is not 0, is below 1 or above it: by its exponent, which may be
/// beyond any range itself.
bool is_below_one(std::string_view token) {
    const std::size_t e = std::min(token.find_first_of("eE"), token.size());
    const std::string_view digits = token.substr(0, e);
    const std::string_view exponent = without_plus(token.substr(std::min(e + 1, token.size())));
    const auto point = static_cast<double>(std::min(digits.find('.'), digits.size()));
    const auto first = static_cast<double>(digits.find_first_of("123456789"));
    double power = 0;
    if (std::from_chars(exponent.data(), exponent.data() + exponent.size(), power).ec ==
        std::errc::result_out_of_range)
        power = exponent.starts_with('-') ? -1e300 : 1e300;
    return point - first + power <= 0;
}

template <class Real>
std::optional<Real> to_real(std::string_view token) {
    token = without_plus(token);
    Real value = 0;
    const char* end = token.data() + token.size();
    const auto [stop, error] = std::from_chars(token.data(), end, value);
    if (stop != end || error == std::errc::invalid_argument) return std::nullopt;
    if (error == std::errc{}) return value;
    const Real magnitude = is_below_one(token) ? Real{0} : std::numeric_limits<Real>::infinity();
    return token.starts_with('-') ? -magnitude : magnitude;
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
    while (!rest.empty() && (is_blank(rest.front()) || continues_line(rest))) rest.remove_prefix(1);
    std::size_t length = 0;
    while (length < rest.size() && !is_blank(rest[length]) && !continues_line(rest.substr(length))) ++length;
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

std::string_view without_bom(std::string_view text) {
    constexpr std::string_view bom = "\xEF\xBB\xBF";
    return text.starts_with(bom) ? text.substr(bom.size()) : text;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return out;
}

std::optional<float> to_float(std::string_view token) {
    return to_real<float>(token);
}

std::optional<double> to_double(std::string_view token) {
    return to_real<double>(token);
}

std::optional<std::int64_t> to_integer(std::string_view token) {
    token = without_plus(token);
    std::int64_t value = 0;
    const char* end = token.data() + token.size();
    const auto [stop, error] = std::from_chars(token.data(), end, value);
    if (stop != end || error != std::errc{}) return std::nullopt;
    return value;
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
