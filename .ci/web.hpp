// SPDX-License-Identifier: MIT
#pragma once

/// What the standard library of Emscripten 3.1.6 lacks of C++20, which Debian 12 and Ubuntu 24.04 have.
/// Included before everything else in builds for browsers; newer ones have it all, and this adds nothing.

#include <version>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 15000

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <system_error>
#include <type_traits>
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Weverything"
#include <range/v3/algorithm.hpp>
#pragma clang diagnostic pop

namespace std {

namespace ranges {
using ::ranges::adjacent_find;
using ::ranges::all_of;
using ::ranges::any_of;
using ::ranges::binary_search;
using ::ranges::copy;
using ::ranges::copy_backward;
using ::ranges::copy_if;
using ::ranges::count;
using ::ranges::count_if;
using ::ranges::equal;
using ::ranges::equal_range;
using ::ranges::fill;
using ::ranges::fill_n;
using ::ranges::find;
using ::ranges::find_end;
using ::ranges::find_first_of;
using ::ranges::find_if;
using ::ranges::find_if_not;
using ::ranges::for_each;
using ::ranges::generate;
using ::ranges::generate_n;
using ::ranges::includes;
using ::ranges::inplace_merge;
using ::ranges::is_heap;
using ::ranges::is_partitioned;
using ::ranges::is_permutation;
using ::ranges::is_sorted;
using ::ranges::is_sorted_until;
using ::ranges::lexicographical_compare;
using ::ranges::lower_bound;
using ::ranges::make_heap;
using ::ranges::max;
using ::ranges::max_element;
using ::ranges::merge;
using ::ranges::min;
using ::ranges::min_element;
using ::ranges::minmax;
using ::ranges::minmax_element;
using ::ranges::mismatch;
using ::ranges::move;
using ::ranges::move_backward;
using ::ranges::next_permutation;
using ::ranges::none_of;
using ::ranges::nth_element;
using ::ranges::partial_sort;
using ::ranges::partial_sort_copy;
using ::ranges::partition;
using ::ranges::partition_copy;
using ::ranges::partition_point;
using ::ranges::pop_heap;
using ::ranges::prev_permutation;
using ::ranges::push_heap;
using ::ranges::remove;
using ::ranges::remove_copy;
using ::ranges::remove_copy_if;
using ::ranges::remove_if;
using ::ranges::replace;
using ::ranges::replace_copy;
using ::ranges::replace_copy_if;
using ::ranges::replace_if;
using ::ranges::reverse;
using ::ranges::reverse_copy;
using ::ranges::rotate;
using ::ranges::rotate_copy;
using ::ranges::search;
using ::ranges::search_n;
using ::ranges::set_difference;
using ::ranges::set_intersection;
using ::ranges::set_symmetric_difference;
using ::ranges::set_union;
using ::ranges::shuffle;
using ::ranges::sort;
using ::ranges::sort_heap;
using ::ranges::stable_partition;
using ::ranges::stable_sort;
using ::ranges::swap_ranges;
using ::ranges::transform;
using ::ranges::unique_copy;
using ::ranges::upper_bound;
}  // namespace ranges

template <class To, class From>
[[nodiscard]] constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}

/// The fewest digits that read back as `value`.
template <class Float>
requires is_floating_point_v<Float> to_chars_result to_chars(char* first, char* last, Float value) {
    const auto room = static_cast<size_t>(last - first);
    for (int digits = 1;; ++digits) {
        const int length = snprintf(first, room, "%.*g", digits, static_cast<double>(value));
        if (length < 0 || static_cast<size_t>(length) >= room) return {last, errc::value_too_large};
        if (digits == numeric_limits<Float>::max_digits10 ||
            static_cast<Float>(strtod(first, nullptr)) == value)
            return {first + length, errc()};
    }
}

}  // namespace std

#endif

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000

#include <fast_float/fast_float.h>

#include <charconv>
#include <type_traits>

namespace std {

template <class Float>
requires is_floating_point_v<Float> from_chars_result from_chars(const char* first, const char* last,
                                                                 Float& value) {
    const auto [end, error] = fast_float::from_chars(first, last, value);
    return {end, error};
}

}  // namespace std

#endif
