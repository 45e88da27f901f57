// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/crowd.hpp>

namespace goffer::bend {

/// Where a layout has the numbers of a matrix, in floats from its first one.
struct MatrixSteps {
    int column, row;  ///< from one column, or row, to the next

    /// From the first number to behind the last one that is read.
    [[nodiscard]] constexpr int floats() const noexcept { return 3 * column + 2 * row + 1; }
};

[[nodiscard]] constexpr MatrixSteps steps_of(TransformColumn::MatrixLayout layout) noexcept {
    if (layout == TransformColumn::MatrixLayout::columns4) return {4, 1};
    if (layout == TransformColumn::MatrixLayout::rows4) return {1, 4};
    return {3, 1};
}

}  // namespace goffer::bend
