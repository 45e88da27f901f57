// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/args.hpp"

/// Where set-up leaves the coefficients of the instances in one register of lanes `L`.

namespace goffer::bend {

/// How many lanes of a register hold instances.
enum class Lanes { one, some, all };

/// Coefficients of the instances in one register, each instance's by themselves: those of lane i at
/// k[i * step].
template <class L, Lanes lanes>
struct SeparateResult {
    Coefficients* k;
    std::size_t step, count;

    /// Stores four coefficients that follow each other. row(k) is the address of the first one.
    template <class Row>
    void put(const Row& row, typename L::Vec a, typename L::Vec b, typename L::Vec c,
             typename L::Vec d) const {
        if constexpr (lanes == Lanes::one) {
            L::store_row(row(k[0]), L::first_row(a, b, c, d));
        } else {
            L::for_rows(a, b, c, d, [&](std::size_t i, typename L::Row values) {
                if (lanes == Lanes::all || i < count) L::store_row(row(k[i * step]), values);
            });
        }
    }
};

/// Coefficients of the instances in one register, among those of all instances side by side.
template <class L>
struct LaneResult {
    LaneCoefficients& k;
    std::size_t first;  ///< the register's first lane among them

    template <class Row>
    void put(const Row& row, typename L::Vec a, typename L::Vec b, typename L::Vec c,
             typename L::Vec d) const {
        InstanceLanes* const to = row(k);
        L::store(to[0] + first, a);
        L::store(to[1] + first, b);
        L::store(to[2] + first, c);
        L::store(to[3] + first, d);
    }
};

}  // namespace goffer::bend
