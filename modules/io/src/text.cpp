// SPDX-License-Identifier: MIT
#include <goffer/io/text.hpp>

#include <algorithm>
#include <charconv>
#include <limits>

namespace goffer::io {
namespace {

/// from_chars refuses the plus sign that files may have.
std::string_view without_plus(std::string_view word) {
    return word.starts_with('+') && !word.starts_with("+-") ? word.substr(1) : word;
}

/// Whether the decimal number `word`, which is not 0, is below 1 or above it: by its exponent, which may be
/// beyond any range itself.
bool is_below_one(std::string_view word) {
    const std::size_t e = std::min(word.find_first_of("eE"), word.size());
    const std::string_view digits = word.substr(0, e);
    const std::string_view exponent = without_plus(word.substr(std::min(e + 1, word.size())));
    const auto point = static_cast<double>(std::min(digits.find('.'), digits.size()));
    const auto first = static_cast<double>(digits.find_first_of("123456789"));
    double power = 0;
    if (std::from_chars(exponent.data(), exponent.data() + exponent.size(), power).ec ==
        std::errc::result_out_of_range)
        power = exponent.starts_with('-') ? -1e300 : 1e300;
    return point - first + power <= 0;
}

template <class Real>
std::optional<Real> to_real(std::string_view word) {
    word = without_plus(word);
    Real value = 0;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop != end || error == std::errc::invalid_argument) return std::nullopt;
    if (error == std::errc{}) return value;
    const Real magnitude = is_below_one(word) ? Real{0} : std::numeric_limits<Real>::infinity();
    return word.starts_with('-') ? -magnitude : magnitude;
}

}  // namespace

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
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

std::optional<float> to_float(std::string_view word) {
    return to_real<float>(word);
}

std::optional<double> to_double(std::string_view word) {
    return to_real<double>(word);
}

std::optional<std::int64_t> to_integer(std::string_view word) {
    word = without_plus(word);
    std::int64_t value = 0;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop != end || error != std::errc{}) return std::nullopt;
    return value;
}

}  // namespace goffer::io
