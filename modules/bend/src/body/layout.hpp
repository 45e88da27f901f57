// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/kernel_input.hpp>

#include <cstddef>

/// Where the columns of a body lie: one behind the other, in this order, in memory and in a body file.

namespace goffer::bend {

/// Places of columns. Those from `tangents` on exist only if the body has tangents. The
/// columns of ShapeColumn follow if the body has a shape, then those of RestColumn if a region
/// compares_with_rest.
enum Column : std::size_t {
    cos_half_beta,
    sin_half_beta,
    rho,
    radial_offset,
    height,
    wrinkle,
    slope,
    normals,
    tangents = normals + 3,
    tangent_sign = tangents + 3,
    all_columns
};
enum ShapeColumn : std::size_t { scale, drift, taper, all_shape_columns };
enum RestColumn : std::size_t {
    cos_beta,
    sin_beta,
    rest_cosine,
    rest_sine,
    per_rest_scale,
    all_rest_columns
};

/// Which columns a body has beside those that all have, and where they begin.
struct ColumnLayout {
    bool tangents = false, shape = false, rest = false;

    [[nodiscard]] std::size_t first_shape_column() const noexcept {
        return tangents ? all_columns : Column::tangents;
    }
    [[nodiscard]] std::size_t first_rest_column() const noexcept {
        return first_shape_column() + (shape ? std::size_t{all_shape_columns} : 0);
    }
    [[nodiscard]] std::size_t columns() const noexcept {
        return first_rest_column() + (rest ? std::size_t{all_rest_columns} : 0);
    }
};

/// Pointers to columns that lie `stride` floats apart, of which `first` is the first one.
[[nodiscard]] RestColumns columns_at(const float* first, std::size_t stride,
                                     const ColumnLayout& layout) noexcept;

}  // namespace goffer::bend
