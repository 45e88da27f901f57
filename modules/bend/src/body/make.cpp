// SPDX-License-Identifier: MIT
#include "body/body_data.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace goffer::bend {
namespace {

/// Places of columns in BodyData::storage. Those from `tangents` on exist only if the body has tangents. The
/// columns of RestColumn follow if a region compares_with_rest.
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
enum RestColumn : std::size_t { cos_beta, sin_beta, rest_cosine, rest_sine, all_rest_columns };

/// The place of the first RestColumn.
std::size_t first_rest_column(bool has_tangents) {
    return has_tangents ? all_columns : tangents;
}

Columns storage_for(const BodyInput& input) {
    const bool compares = std::ranges::any_of(input.regions, compares_with_rest);
    return {first_rest_column(!input.tangents.empty()) + (compares ? std::size_t{all_rest_columns} : 0),
            input.vertices.size()};
}

RestColumns columns_of(const Columns& storage, bool has_tangents) {
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
    for (std::size_t c = 0; has_tangents && c < 3; ++c) columns.tangent[c] = at(tangents + c);
    if (has_tangents) columns.tangent_sign = at(tangent_sign);
    const std::size_t rest = first_rest_column(has_tangents);
    if (storage.columns() == rest) return columns;
    columns.cos_beta = at(rest + cos_beta);
    columns.sin_beta = at(rest + sin_beta);
    columns.rest_cosine = at(rest + rest_cosine);
    columns.rest_sine = at(rest + rest_sine);
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

/// S of the column at `beta` in the rest pose, by eq 9 and 10.
double rest_scale(const Making& making, double beta) {
    const double kappa = making.region.rest_angle * making.radius / making.region.length;
    return 1 - kappa * (1 + std::cos(beta - making.region.rest_direction));
}

void write_vertices(Columns& storage, const Making& making, std::span<const RestVertex> vertices) {
    for (std::size_t i = making.first; i < making.last; ++i) {
        const RestVertex& v = vertices[i];
        const double scale = rest_scale(making, v.beta);
        storage[cos_half_beta][i] = static_cast<float>(std::numbers::sqrt2 * std::cos(v.beta / 2));
        storage[sin_half_beta][i] = static_cast<float>(std::numbers::sqrt2 * std::sin(v.beta / 2));
        storage[rho][i] = static_cast<float>(v.rho);
        storage[radial_offset][i] = static_cast<float>(scale * v.wrinkle * v.rho);
        storage[height][i] = static_cast<float>(v.z / making.region.length - 0.5);
        storage[wrinkle][i] = static_cast<float>(scale * v.wrinkle);
        storage[slope][i] = static_cast<float>(scale * v.slope);
    }
}

/// Writes the columns of RestColumn, the first of which is `column`.
void write_rest_columns(Columns& storage, std::size_t column, const Making& making,
                        std::span<const RestVertex> vertices) {
    for (std::size_t i = making.first; i < making.last; ++i) {
        const double beta = vertices[i].beta, cosine = std::cos(beta), sine = std::sin(beta);
        const double scale = rest_scale(making, beta);
        storage[column + cos_beta][i] = static_cast<float>(cosine);
        storage[column + sin_beta][i] = static_cast<float>(sine);
        storage[column + rest_cosine][i] = static_cast<float>(cosine / scale);
        storage[column + rest_sine][i] = static_cast<float>(sine / scale);
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

Squeeze squeeze_of(const RegionInput& region) {
    if (region.table.empty()) return Squeeze::none;
    return compares_with_rest(region) ? Squeeze::relative : Squeeze::plain;
}

/// Takes a direction to -pi..pi.
float reduced(double direction) {
    return static_cast<float>(
        std::remainder(static_cast<double>(static_cast<float>(direction)), 2 * std::numbers::pi));
}

SetupRegion setup_of(const RegionInput& region, double radius) {
    SetupRegion setup = {};
    setup.length = static_cast<float>(region.length);
    setup.per_length = static_cast<float>(1 / region.length);
    setup.radius = static_cast<float>(radius);
    setup.max_angle = static_cast<float>(region.max_angle);
    setup.relative = squeeze_of(region) == Squeeze::relative;
    setup.onset = static_cast<float>(region.onset);
    setup.rest_angle = static_cast<float>(region.rest_angle);
    setup.rest_direction = reduced(region.rest_direction);
    if (region.table.empty()) return setup;
    setup.rows = reinterpret_cast<const float(*)[amplitude_terms]>(region.table.rows.front().data());
    setup.row_count = region.table.rows.size();
    setup.table_max_angle = region.table.max_angle;
    return setup;
}

RegionData data_of(const Making& making, const RestColumns& columns) {
    const RegionInput& input = making.region;
    return {setup_of(input, making.radius), squeeze_of(input), &input.factors, bands_of(columns, making)};
}

void add_region(BodyData& data, const Making& making, std::span<const RestVertex> vertices) {
    const RegionInput& input = making.region;
    write_vertices(data.storage, making, vertices);
    if (data.columns.cos_beta != nullptr) {
        const std::size_t column = first_rest_column(data.columns.tangent_sign != nullptr);
        write_rest_columns(data.storage, column, making, vertices);
    }
    data.regions.push_back(region_of(making));
    data.details.push_back(data_of(making, data.columns));
    data.length += input.length;
}

}  // namespace

std::optional<Body> Body::make(const BodyInput& input) {
    if (!check(input).none()) return std::nullopt;
    auto data = std::make_unique<BodyData>();
    const bool has_tangents = !input.tangents.empty();
    data->storage = storage_for(input);
    data->columns = columns_of(data->storage, has_tangents);
    data->vertex_count = input.vertices.size();
    data->base = frame_of(input);
    data->origin = input.origin;
    data->axes = input.axes;
    data->radius = input.radius;
    data->inputs.assign(input.regions.begin(), input.regions.end());
    std::size_t first = 0;
    for (const RegionInput& region : data->inputs) {
        add_region(*data, {region, input.radius, first, first + region.vertex_count}, input.vertices);
        first += region.vertex_count;
    }
    write_vectors(data->storage, normals, input.normals);
    if (has_tangents) {
        write_vectors(data->storage, tangents, input.tangents);
        std::ranges::copy(input.tangent_signs, data->storage[tangent_sign].begin());
    }
    Body body;
    body.data_ = std::move(data);
    return body;
}

}  // namespace goffer::bend
