// SPDX-License-Identifier: MIT
#include "body/layout.hpp"

namespace goffer::bend {

RestColumns columns_at(const float* first, std::size_t stride, const ColumnLayout& layout) noexcept {
    const auto at = [&](std::size_t column) { return first + column * stride; };
    RestColumns columns;
    columns.cos_half_beta = at(cos_half_beta);
    columns.sin_half_beta = at(sin_half_beta);
    columns.rho = at(rho);
    columns.radial_offset = at(radial_offset);
    columns.height = at(height);
    columns.wrinkle = at(wrinkle);
    columns.slope = at(slope);
    for (std::size_t c = 0; c < 3; ++c) columns.normal[c] = at(normals + c);
    for (std::size_t c = 0; layout.tangents && c < 3; ++c) columns.tangent[c] = at(tangents + c);
    if (layout.tangents) columns.tangent_sign = at(tangent_sign);
    if (layout.shape) {
        columns.scale = at(layout.first_shape_column() + scale);
        columns.drift = at(layout.first_shape_column() + drift);
        columns.taper = at(layout.first_shape_column() + taper);
    }
    if (!layout.rest) return columns;
    const std::size_t rest = layout.first_rest_column();
    columns.cos_beta = at(rest + cos_beta);
    columns.sin_beta = at(rest + sin_beta);
    columns.rest_cosine = at(rest + rest_cosine);
    columns.rest_sine = at(rest + rest_sine);
    columns.per_rest_scale = at(rest + per_rest_scale);
    return columns;
}

}  // namespace goffer::bend
