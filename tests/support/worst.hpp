// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <type_traits>

/// The worst of many values, of which NaN is the worst of all: std::max and std::min would pass over it.

namespace goffer::test {

/// Takes the larger one.
template <std::floating_point T>
void take_worst(T& worst, std::type_identity_t<T> value) {
    if (value > worst || std::isnan(value)) worst = value;
}

/// Takes the smaller one, for values that are the better the larger they are.
template <std::floating_point T>
void take_least(T& least, std::type_identity_t<T> value) {
    if (value < least || std::isnan(value)) least = value;
}

}  // namespace goffer::test
