// SPDX-License-Identifier: MIT
#include "body/body_data.hpp"
#include "body/direction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace goffer::bend {
namespace {

/// Places of columns in BodyData::storage. Those from `tangents` on exist only if the body has tangents. The
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
enum RestColumn : std::size_t { cos_beta, sin_beta, rest_cosine, rest_sine, rest_scale, all_rest_columns };

/// Which columns a body has beside those that all have, and where they begin.
struct Layout {
    bool tangents, shape, rest;

    explicit Layout(const BodyInput& input)
        : tangents(!input.tangents.empty()),
          shape(std::ranges::any_of(input.vertices,
                                    [](const RestVertex& v) { return v.scale != 1 || v.drift != 0; })),
          rest(std::ranges::any_of(input.regions, compares_with_rest)) {}

    [[nodiscard]] std::size_t first_shape_column() const { return tangents ? all_columns : Column::tangents; }
    [[nodiscard]] std::size_t first_rest_column() const {
        return first_shape_column() + (shape ? std::size_t{all_shape_columns} : 0);
    }
    [[nodiscard]] std::size_t columns() const {
        return first_rest_column() + (rest ? std::size_t{all_rest_columns} : 0);
    }
};

RestColumns columns_of(const Columns& storage, const Layout& layout) {
    const auto at = [&](std::size_t column) { return storage[column].data(); };
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
    columns.rest_scale = at(rest + rest_scale);
    return columns;
}

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
        storage[height][i] = static_cast<float>(v.z / making.region.length - 0.5);
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
        storage[column + rest_scale][i] = static_cast<float>(per_scale);
    }
}

Frame frame_of(const BodyInput& input) {
    Frame frame = {};
    for (int row = 0; row < 3; ++row) {
        for (int c = 0; c < 3; ++c) frame.axes[c][row] = static_cast<float>(input.axes[c][row]);
        frame.origin[row] = static_cast<float>(input.origin[row]);
    }
    return frame;
}

/// Takes the drift at an edge from the vertex nearest to it.
void set_drift(Bands& bands, const RestColumns& columns, const Making& making, float per_height) {
    bands.shaped = true;
    std::array<float, Bands::count + 1> distance;
    distance.fill(std::numeric_limits<float>::max());
    for (std::size_t i = making.first; i < making.last; ++i) {
        bands.max_scale = std::max(bands.max_scale, columns.scale[i]);
        const float place = (columns.height[i] - bands.lowest) * per_height;
        for (std::size_t j = 0; j < distance.size(); ++j) {
            const float away = std::fabs(place - static_cast<float>(j));
            if (away < distance[j]) distance[j] = away, bands.drift[j] = columns.drift[i];
        }
    }
    for (std::size_t j = 0; j < Bands::count; ++j)
        bands.max_drift_step = std::max(bands.max_drift_step, std::fabs(bands.drift[j + 1] - bands.drift[j]));
    for (std::size_t i = making.first; i < making.last; ++i) {
        const float at = drift_at(bands, (columns.height[i] - bands.lowest) * per_height);
        bands.drift_error = std::max(bands.drift_error, std::fabs(columns.drift[i] - at));
    }
}

Bands bands_of(const RestColumns& columns, const Making& making) {
    Bands bands;
    bands.rho.fill(-1);
    const std::size_t first = making.first, last = making.last;
    if (first == last) return bands;
    const auto [lowest, highest] = std::minmax_element(columns.height + first, columns.height + last);
    bands.lowest = *lowest;
    bands.highest = *highest;
    const float extent = bands.highest - bands.lowest;
    const float per_height = extent > 0 ? static_cast<float>(Bands::count) / extent : 0.0f;
    if (columns.scale != nullptr) set_drift(bands, columns, making, per_height);
    for (std::size_t i = first; i < last; ++i) {
        const auto band = static_cast<std::size_t>((columns.height[i] - bands.lowest) * per_height);
        const std::size_t place = std::min(band, Bands::count - 1) + 1;
        bands.rho[place] = std::max(bands.rho[place], columns.rho[i]);
        bands.outward[place] = std::max(bands.outward[place], columns.radial_offset[i]);
        bands.inward[place] = std::max(bands.inward[place], -columns.radial_offset[i]);
    }
    return bands;
}

Region region_of(const Making& making) {
    const RegionInput& input = making.region;
    return {making.first,
            making.last,
            static_cast<float>(input.length),
            static_cast<float>(input.max_angle),
            static_cast<float>(input.onset),
            {static_cast<float>(input.rest_angle), static_cast<float>(input.rest_direction)}};
}

/// `shape`: the body has one.
Squeeze squeeze_of(const RegionInput& region, bool shape) {
    const Squeeze straight = shape ? Squeeze::shaped : Squeeze::plain;
    if (region.table.empty()) return shape ? Squeeze::shaped : Squeeze::none;
    return compares_with_rest(region) ? Squeeze::relative : straight;
}

SetupRegion setup_of(const RegionInput& region, double radius, bool shape) {
    SetupRegion setup = {};
    setup.length = static_cast<float>(region.length);
    setup.per_length = static_cast<float>(1 / region.length);
    setup.radius = static_cast<float>(radius);
    setup.max_angle = static_cast<float>(region.max_angle);
    setup.relative = squeeze_of(region, shape) == Squeeze::relative;
    setup.shaped = shape;
    setup.onset = static_cast<float>(region.onset);
    setup.rest_angle = static_cast<float>(region.rest_angle);
    setup.rest_direction = wrapped_direction(static_cast<float>(region.rest_direction));
    if (region.table.empty()) return setup;
    setup.rows = reinterpret_cast<const float(*)[amplitude_terms]>(region.table.rows.front().data());
    setup.row_count = region.table.rows.size();
    setup.table_max_angle = region.table.max_angle;
    return setup;
}

RegionData data_of(const Making& making, const RestColumns& columns) {
    const RegionInput& input = making.region;
    const bool shape = columns.scale != nullptr;
    return {setup_of(input, making.radius, shape), squeeze_of(input, shape), &input.factors,
            bands_of(columns, making)};
}

void add_region(BodyData& data, const Layout& layout, const Making& making,
                std::span<const RestVertex> vertices) {
    const RegionInput& input = making.region;
    write_vertices(data.storage, making, vertices);
    if (layout.shape) write_shape_columns(data.storage, layout.first_shape_column(), making, vertices);
    if (layout.rest) write_rest_columns(data.storage, layout.first_rest_column(), making, vertices);
    data.regions.push_back(region_of(making));
    data.details.push_back(data_of(making, data.columns));
    data.length += input.length;
}

}  // namespace

std::optional<Body> Body::make(const BodyInput& input) {
    if (!check(input).none()) return std::nullopt;
    auto data = std::make_unique<BodyData>();
    const Layout layout(input);
    data->storage = Columns(layout.columns(), input.vertices.size());
    data->columns = columns_of(data->storage, layout);
    data->vertex_count = input.vertices.size();
    data->base = frame_of(input);
    data->origin = input.origin;
    data->axes = input.axes;
    data->radius = input.radius;
    data->inputs.assign(input.regions.begin(), input.regions.end());
    std::size_t first = 0;
    for (const RegionInput& region : data->inputs) {
        const Making making{region, radius_of(region, input.radius), first, first + region.vertex_count};
        add_region(*data, layout, making, input.vertices);
        first += region.vertex_count;
    }
    write_vectors(data->storage, normals, input.normals);
    if (layout.tangents) {
        write_vectors(data->storage, tangents, input.tangents);
        std::ranges::copy(input.tangent_signs, data->storage[tangent_sign].begin());
    }
    Body body;
    body.data_ = std::move(data);
    return body;
}

}  // namespace goffer::bend
