// SPDX-License-Identifier: MIT
#include <goffer/bend/body.hpp>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goffer::bend {
namespace {

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool positive(double value) {
    return std::isfinite(value) && value > 0;
}

bool rotation(const glm::dmat3& axes) {
    for (int i = 0; i < 3; ++i) {
        if (!finite(axes[i]) || std::fabs(glm::length(axes[i]) - 1) > 1e-6) return false;
        if (std::fabs(glm::dot(axes[i], axes[(i + 1) % 3])) > 1e-6) return false;
    }
    return glm::determinant(axes) > 0;
}

/// Of a WrinkleTable or a FactorTable.
template <class Table>
bool usable(const Table& table) {
    if (table.empty()) return true;
    if (table.rows.size() < 2 || !positive(static_cast<double>(table.max_angle))) return false;
    return std::ranges::all_of(table.rows, [](const auto& row) {
        return std::ranges::all_of(row, [](float value) { return std::isfinite(value); });
    });
}

BodyFault check(const RegionInput& region, double radius) {
    if (!positive(region.length)) return BodyFault::region_length;
    const double limit = region.length / (2 * radius) * (1 + 1e-6);
    if (!positive(region.max_angle) || region.max_angle > limit) return BodyFault::region_max_angle;
    if (!(region.rest_angle >= 0 && region.rest_angle <= region.max_angle) ||
        !std::isfinite(region.rest_direction)) {
        return BodyFault::region_rest;
    }
    if (!(region.onset >= 0 && region.onset <= 1)) return BodyFault::region_onset;
    if (!usable(region.table)) return BodyFault::region_table;
    return usable(region.factors) ? BodyFault::none : BodyFault::region_factors;
}

bool usable(const RestVertex& v, double length) {
    const double slack = 1e-3 * length;
    return std::isfinite(v.beta) && std::isfinite(v.wrinkle) && std::isfinite(v.slope) &&
           std::isfinite(v.rho) && v.rho >= 0 && v.z >= -slack && v.z <= length + slack;
}

bool unit(const RestVector& v) {
    const double squared = v.rho * v.rho + v.beta * v.beta + v.z * v.z;
    return std::fabs(squared - 1) < 1e-3;
}

bool all_unit(std::span<const RestVector> vectors) {
    return std::all_of(vectors.begin(), vectors.end(), unit);
}

void write_vectors(Columns& columns, std::size_t first, std::span<const RestVector> vectors) {
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        columns[first][i] = static_cast<float>(vectors[i].rho);
        columns[first + 1][i] = static_cast<float>(vectors[i].beta);
        columns[first + 2][i] = static_cast<float>(vectors[i].z);
    }
}

/// Vertices of each region, with what is to be known of them: the region and the index of its first vertex.
template <class Each>
bool each_region(const BodyInput& input, Each each) {
    std::size_t first = 0;
    for (const RegionInput& region : input.regions) {
        if (region.vertex_count > input.vertices.size() - first) return false;
        if (!each(region, first)) return false;
        first += region.vertex_count;
    }
    return first == input.vertices.size();
}

/// S of a column, eq 9 and 10.
double rest_scale(const RegionInput& region, double radius, double beta) {
    const double kappa = region.rest_angle * radius / region.length;
    return 1 - kappa * (1 + std::cos(beta - region.rest_direction));
}

void write_vertices(Columns& columns, const RegionInput& region, double radius, std::size_t first,
                    std::span<const RestVertex> vertices) {
    for (std::size_t i = first; i < first + region.vertex_count; ++i) {
        const RestVertex& v = vertices[i];
        const double scale = rest_scale(region, radius, v.beta);
        columns[Body::cos_half_beta][i] = static_cast<float>(std::numbers::sqrt2 * std::cos(v.beta / 2));
        columns[Body::sin_half_beta][i] = static_cast<float>(std::numbers::sqrt2 * std::sin(v.beta / 2));
        columns[Body::rho][i] = static_cast<float>(v.rho);
        columns[Body::lift][i] = static_cast<float>(scale * v.wrinkle * v.rho);
        columns[Body::height][i] = static_cast<float>(v.z / region.length - 0.5);
        columns[Body::wrinkle][i] = static_cast<float>(scale * v.wrinkle);
        columns[Body::slope][i] = static_cast<float>(scale * v.slope);
    }
}

BodyFrame frame_of(const BodyInput& input) {
    BodyFrame frame;
    for (int row = 0; row < 3; ++row) {
        for (int c = 0; c < 3; ++c) frame.base.axes[c][row] = static_cast<float>(input.axes[c][row]);
        frame.base.origin[row] = static_cast<float>(input.origin[row]);
    }
    frame.radius = static_cast<float>(input.radius);
    return frame;
}

Bands bands_of(const Columns& columns, std::size_t first, std::size_t count) {
    Bands bands;
    bands.rho.fill(-1);
    if (count == 0) return bands;
    const auto of = [&](Body::Column column) {
        return std::span<const float>(columns[column]).subspan(first, count);
    };
    const std::span<const float> heights = of(Body::height), rho = of(Body::rho), lift = of(Body::lift);
    const auto [lowest, highest] = std::ranges::minmax(heights);
    bands.lowest = lowest;
    bands.highest = highest;
    const float per_height = highest > lowest ? static_cast<float>(Bands::count) / (highest - lowest) : 0.0f;
    for (std::size_t i = 0; i < count; ++i) {
        const auto band = static_cast<std::size_t>((heights[i] - lowest) * per_height);
        const std::size_t place = std::min(band, Bands::count - 1) + 1;
        bands.rho[place] = std::max(bands.rho[place], rho[i]);
        bands.lift[place] = std::max(bands.lift[place], lift[i]);
        bands.dip[place] = std::max(bands.dip[place], -lift[i]);
    }
    return bands;
}

Region region_of(const RegionInput& input, const Columns& columns, std::size_t first) {
    Region region;
    region.first = first;
    region.last = first + input.vertex_count;
    region.length = static_cast<float>(input.length);
    region.per_length = static_cast<float>(1 / input.length);
    region.max_angle = static_cast<float>(input.max_angle);
    region.onset = static_cast<float>(input.onset);
    region.rest = {static_cast<float>(input.rest_angle), static_cast<float>(input.rest_direction)};
    region.compares_with_rest = input.rest_angle != 0 || input.onset != 0;
    region.table = input.table;
    region.factors = input.factors;
    region.bands = bands_of(columns, first, input.vertex_count);
    return region;
}

}  // namespace

std::string_view describe(BodyFault fault) noexcept {
    switch (fault) {
        case BodyFault::none:
            return "no fault";
        case BodyFault::origin:
            return "origin: not finite";
        case BodyFault::axes:
            return "axes: not a right-handed orthonormal frame";
        case BodyFault::radius:
            return "radius: not a positive number";
        case BodyFault::regions:
            return "regions: none, or more than max_regions";
        case BodyFault::region_length:
            return "regions.length: not a positive number";
        case BodyFault::region_max_angle:
            return "regions.max_angle: not above 0 and below length / (2 radius)";
        case BodyFault::region_rest:
            return "regions.rest_angle, rest_direction: not finite, or the angle not in 0..max_angle";
        case BodyFault::region_onset:
            return "regions.onset: not in 0..1";
        case BodyFault::region_table:
            return "regions.table: fewer than two rows, or a number in it is not finite";
        case BodyFault::region_factors:
            return "regions.factors: fewer than two rows, or a number in it is not finite";
        case BodyFault::region_vertices:
            return "regions.vertex_count: do not add up to the number of vertices";
        case BodyFault::vertices:
            return "vertices: none, one not finite, a rho below 0 or a z outside 0..its region's length";
        case BodyFault::normals:
            return "normals: not one per vertex, or one not of unit length";
        case BodyFault::tangents:
            return "tangents: neither none nor one per vertex, or one not of unit length";
        case BodyFault::tangent_signs:
            return "tangent_signs: not one per tangent, or one not finite";
    }
    return "unknown fault";
}

BodyFault Body::check(const BodyInput& input) noexcept {
    if (!finite(input.origin)) return BodyFault::origin;
    if (!rotation(input.axes)) return BodyFault::axes;
    if (!positive(input.radius)) return BodyFault::radius;
    if (input.regions.empty() || input.regions.size() > max_regions) return BodyFault::regions;
    for (const RegionInput& region : input.regions) {
        const BodyFault fault = bend::check(region, input.radius);
        if (fault != BodyFault::none) return fault;
    }
    if (input.vertices.empty()) return BodyFault::vertices;
    if (!each_region(input, [](const RegionInput&, std::size_t) { return true; })) {
        return BodyFault::region_vertices;
    }
    const bool vertices_usable = each_region(input, [&](const RegionInput& region, std::size_t first) {
        return std::ranges::all_of(input.vertices.subspan(first, region.vertex_count),
                                   [&](const RestVertex& v) { return usable(v, region.length); });
    });
    if (!vertices_usable) return BodyFault::vertices;
    const std::size_t count = input.vertices.size();
    if (input.normals.size() != count || !all_unit(input.normals)) return BodyFault::normals;
    if (!input.tangents.empty() && (input.tangents.size() != count || !all_unit(input.tangents))) {
        return BodyFault::tangents;
    }
    const bool signs_finite = std::all_of(input.tangent_signs.begin(), input.tangent_signs.end(),
                                          [](float sign) { return std::isfinite(sign); });
    if (input.tangent_signs.size() != input.tangents.size() || !signs_finite) return BodyFault::tangent_signs;
    return BodyFault::none;
}

std::optional<Body> Body::make(const BodyInput& input) {
    if (check(input) != BodyFault::none) return std::nullopt;
    Body body;
    body.has_tangents_ = !input.tangents.empty();
    const bool compares = std::ranges::any_of(
        input.regions, [](const RegionInput& region) { return region.rest_angle != 0 || region.onset != 0; });
    const std::size_t columns = body.has_tangents_ ? cos_beta : tangent_rho;
    body.columns_ = Columns(columns + (compares ? rest_sine + 1 - cos_beta : 0), input.vertices.size());
    body.origin_ = input.origin;
    body.axes_ = input.axes;
    body.radius_ = input.radius;
    body.frame_ = frame_of(input);
    body.length_ = 0;
    body.regions_.reserve(input.regions.size());
    each_region(input, [&](const RegionInput& region, std::size_t first) {
        body.length_ += region.length;
        write_vertices(body.columns_, region, input.radius, first, input.vertices);
        for (std::size_t i = first; compares && i < first + region.vertex_count; ++i) {
            const double beta = input.vertices[i].beta, cosine = std::cos(beta), sine = std::sin(beta);
            const double scale = rest_scale(region, input.radius, beta);
            std::size_t column = columns;
            for (const double value : {cosine, sine, cosine / scale, sine / scale})  // from cos_beta on
                body.columns_[column++][i] = static_cast<float>(value);
        }
        body.regions_.push_back(region_of(region, body.columns_, first));
        return true;
    });
    body.region_count_ = body.regions_.size();
    write_vectors(body.columns_, normal_rho, input.normals);
    write_vectors(body.columns_, tangent_rho, input.tangents);
    if (body.has_tangents()) {
        std::copy(input.tangent_signs.begin(), input.tangent_signs.end(),
                  body.columns_[tangent_sign].begin());
    }
    return body;
}

std::size_t Body::bytes() const noexcept {
    std::size_t bytes = sizeof(Body) + columns_.bytes() + regions_.size() * sizeof(Region);
    for (const Region& region : regions_) {
        bytes += region.table.rows.size() * sizeof(region.table.rows[0]) +
                 region.factors.rows.size() * sizeof(region.factors.rows[0]);
    }
    return bytes;
}

}  // namespace goffer::bend
