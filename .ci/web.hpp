// SPDX-License-Identifier: MIT
#pragma once

/// What the standard library of Emscripten 3.1.6 lacks of C++20, which Debian 12 and Ubuntu 24.04 have.
/// Included before everything else in builds for browsers; newer ones have it all, and this adds nothing.

#include <version>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 15000

#include <fast_float/fast_float.h>

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <system_error>
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Weverything"
#include <range/v3/algorithm/adjacent_find.hpp>
#include <range/v3/algorithm/all_of.hpp>
#include <range/v3/algorithm/any_of.hpp>
#include <range/v3/algorithm/copy.hpp>
#include <range/v3/algorithm/copy_if.hpp>
#include <range/v3/algorithm/count.hpp>
#include <range/v3/algorithm/count_if.hpp>
#include <range/v3/algorithm/equal.hpp>
#include <range/v3/algorithm/fill.hpp>
#include <range/v3/algorithm/find.hpp>
#include <range/v3/algorithm/find_if.hpp>
#include <range/v3/algorithm/find_if_not.hpp>
#include <range/v3/algorithm/for_each.hpp>
#include <range/v3/algorithm/generate.hpp>
#include <range/v3/algorithm/is_sorted.hpp>
#include <range/v3/algorithm/lexicographical_compare.hpp>
#include <range/v3/algorithm/lower_bound.hpp>
#include <range/v3/algorithm/max.hpp>
#include <range/v3/algorithm/max_element.hpp>
#include <range/v3/algorithm/min.hpp>
#include <range/v3/algorithm/min_element.hpp>
#include <range/v3/algorithm/minmax.hpp>
#include <range/v3/algorithm/mismatch.hpp>
#include <range/v3/algorithm/none_of.hpp>
#include <range/v3/algorithm/partition.hpp>
#include <range/v3/algorithm/remove_if.hpp>
#include <range/v3/algorithm/replace.hpp>
#include <range/v3/algorithm/replace_if.hpp>
#include <range/v3/algorithm/reverse.hpp>
#include <range/v3/algorithm/rotate.hpp>
#include <range/v3/algorithm/sort.hpp>
#include <range/v3/algorithm/stable_sort.hpp>
#include <range/v3/algorithm/swap_ranges.hpp>
#include <range/v3/algorithm/transform.hpp>
#include <range/v3/algorithm/upper_bound.hpp>
#pragma clang diagnostic pop

namespace std {

namespace ranges {
using ::ranges::adjacent_find;
using ::ranges::all_of;
using ::ranges::any_of;
using ::ranges::copy;
using ::ranges::copy_if;
using ::ranges::count;
using ::ranges::count_if;
using ::ranges::equal;
using ::ranges::fill;
using ::ranges::find;
using ::ranges::find_if;
using ::ranges::find_if_not;
using ::ranges::for_each;
using ::ranges::generate;
using ::ranges::is_sorted;
using ::ranges::lexicographical_compare;
using ::ranges::lower_bound;
using ::ranges::max;
using ::ranges::max_element;
using ::ranges::min;
using ::ranges::min_element;
using ::ranges::minmax;
using ::ranges::mismatch;
using ::ranges::none_of;
using ::ranges::partition;
using ::ranges::remove_if;
using ::ranges::replace;
using ::ranges::replace_if;
using ::ranges::reverse;
using ::ranges::rotate;
using ::ranges::sort;
using ::ranges::stable_sort;
using ::ranges::swap_ranges;
using ::ranges::transform;
using ::ranges::upper_bound;
}  // namespace ranges

template <class To, class From>
[[nodiscard]] constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}

inline from_chars_result from_chars(const char* first, const char* last, double& value) {
    const auto [end, error] = fast_float::from_chars(first, last, value);
    return {end, error};
}
inline from_chars_result from_chars(const char* first, const char* last, float& value) {
    const auto [end, error] = fast_float::from_chars(first, last, value);
    return {end, error};
}

/// The fewest digits that read back as `value`.
inline to_chars_result to_chars(char* first, char* last, double value, int most = 17) {
    const auto room = static_cast<size_t>(last - first);
    for (int digits = 1;; ++digits) {
        const int length = snprintf(first, room, "%.*g", digits, value);
        if (length < 0 || static_cast<size_t>(length) >= room) return {last, errc::value_too_large};
        if (digits == most || strtod(first, nullptr) == value) return {first + length, errc()};
    }
}
inline to_chars_result to_chars(char* first, char* last, float value) {
    const auto room = static_cast<size_t>(last - first);
    for (int digits = 1;; ++digits) {
        const int length = snprintf(first, room, "%.*g", digits, static_cast<double>(value));
        if (length < 0 || static_cast<size_t>(length) >= room) return {last, errc::value_too_large};
        if (digits == 9 || strtof(first, nullptr) == value) return {first + length, errc()};
    }
}

}  // namespace std

#endif
