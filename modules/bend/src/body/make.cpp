// SPDX-License-Identifier: MIT
#include "body/body_data.hpp"

#include <goffer/bend/body_input.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace goffer::bend {
namespace {

void write_vectors(Columns& storage, std::size_t first, std::span<const RestVector> vectors) {
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        storage[first][i] = static_cast<float>(vectors[i].rho);
        storage[first + 1][i] = static_cast<float>(vectors[i].beta);
        storage[first + 2][i] = static_cast<float>(vectors[i].z);
    }
}

/// A region being made: its input, and which of the body's vertices are its own.
struct Making {
    const RegionInput& region;
    double radius;
    std::size_t first, last;
};

/// S of a vertex' column in the rest pose, by eq 9 and 10 at the radius about it.
double rest_scale_of(const Making& making, const RestVertex& v) {
    const double kappa = v.scale * making.region.rest_angle * making.radius / making.region.length;
    return 1 - kappa * (1 + std::cos(v.beta - making.region.rest_direction));
}

/// What is multiplied into the wrinkle of a vertex, so that kernels need not: S, or the root of s.
struct Stored {
    double factor;
    double slope;  // of the factor, by z; 0 for the root of s, whose change is part of RestColumns::taper
};

Stored stored_of(const Making& making, const RestVertex& v) {
    if (!compares_with_rest(making.region)) return {std::sqrt(v.scale), 0};
    const double scale = rest_scale_of(making, v);
    return {scale, -(1 - scale) * v.scale_slope / v.scale};
}

void write_vertices(Columns& storage, const Making& making, std::span<const RestVertex> vertices) {
    for (std::size_t i = making.first; i < making.last; ++i) {
        const RestVertex& v = vertices[i];
        const auto [factor, factor_slope] = stored_of(making, v);
        storage[cos_half_beta][i] = static_cast<float>(std::numbers::sqrt2 * std::cos(v.beta / 2));
        storage[sin_half_beta][i] = static_cast<float>(std::numbers::sqrt2 * std::sin(v.beta / 2));
        storage[rho][i] = static_cast<float>(v.rho);
        storage[radial_offset][i] = static_cast<float>(factor * v.wrinkle * v.rho);
        storage[height][i] = height_of(v, making.region.length);
        storage[wrinkle][i] = static_cast<float>(factor * v.wrinkle);
        storage[slope][i] = static_cast<float>(factor * v.slope + factor_slope * v.wrinkle * v.rho);
    }
}

/// Writes the columns of ShapeColumn, the first of which is `column`.
void write_shape_columns(Columns& storage, std::size_t column, const Making& making,
                         std::span<const RestVertex> vertices) {
    const bool compares = compares_with_rest(making.region);
    for (std::size_t i = making.first; i < making.last; ++i) {
        const RestVertex& v = vertices[i];
        const double factor = compares ? -1 : std::sqrt(v.scale);
        storage[column + scale][i] = static_cast<float>(v.scale);
        storage[column + drift][i] = static_cast<float>(v.drift / making.region.length);
        storage[column + taper][i] = static_cast<float>(factor * v.wrinkle * v.rho * v.scale_slope / v.scale);
    }
}

/// Writes the columns of RestColumn, the first of which is `column`.
void write_rest_columns(Columns& storage, std::size_t column, const Making& making,
                        std::span<const RestVertex> vertices) {
    for (std::size_t i = making.first; i < making.last; ++i) {
        const double beta = vertices[i].beta, cosine = std::cos(beta), sine = std::sin(beta);
        const double per_scale = vertices[i].scale / rest_scale_of(making, vertices[i]);
        storage[column + cos_beta][i] = static_cast<float>(cosine);
        storage[column + sin_beta][i] = static_cast<float>(sine);
        storage[column + rest_cosine][i] = static_cast<float>(cosine * per_scale);
        storage[column + rest_sine][i] = static_cast<float>(sine * per_scale);
        storage[column + per_rest_scale][i] = static_cast<float>(per_scale);
    }
}

void write_region(Columns& storage, const ColumnLayout& layout, const Making& making,
                  std::span<const RestVertex> vertices) {
    write_vertices(storage, making, vertices);
    if (layout.shape) write_shape_columns(storage, layout.first_shape_column(), making, vertices);
    if (layout.rest) write_rest_columns(storage, layout.first_rest_column(), making, vertices);
}

ColumnLayout layout_of(const BodyInput& input) {
    const auto shaped = [](const RestVertex& v) {
        return v.scale != 1 || v.drift != 0 || v.scale_slope != 0;
    };
    return {!input.tangents.empty(), std::ranges::any_of(input.vertices, shaped),
            std::ranges::any_of(input.regions, compares_with_rest)};
}

}  // namespace

std::optional<Body> Body::make(const BodyInput& input) {
    if (!check(input).none()) return std::nullopt;
    auto data = std::make_unique<BodyData>();
    data->layout = layout_of(input);
    data->storage = Columns(data->layout.columns(), input.vertices.size());
    data->stride = data->storage.stride();
    data->columns = columns_at(data->storage[0].data(), data->stride, data->layout);
    data->vertex_count = input.vertices.size();
    data->inputs.assign(input.regions.begin(), input.regions.end());
    set_frame(*data, input.origin, input.axes, input.radius);
    std::size_t first = 0;
    for (const RegionInput& region : data->inputs) {
        const std::size_t last = first + region.vertex_count;
        const Making making{region, radius_of(region, input.radius), first, last};
        write_region(data->storage, data->layout, making, input.vertices);
        add_region(*data, region, bands_of(data->columns, first, last));
        // What is out of order was a fault of `input`.
        static_cast<void>(find_vertices(data->details.back().joints, data->columns, first, last));
        first = last;
    }
    write_vectors(data->storage, normals, input.normals);
    if (data->layout.tangents) {
        write_vectors(data->storage, tangents, input.tangents);
        std::ranges::copy(input.tangent_signs, data->storage[tangent_sign].begin());
    }
    return Body(data.release());
}

}  // namespace goffer::bend
