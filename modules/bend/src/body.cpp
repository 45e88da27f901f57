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

bool usable(const WrinkleTable& table) {
    if (table.empty()) return true;
    if (table.rows.size() < 2 || !positive(static_cast<double>(table.max_angle))) return false;
    return std::all_of(table.rows.begin(), table.rows.end(), [](const WrinkleRow& row) {
        return std::all_of(row.begin(), row.end(), [](float value) { return std::isfinite(value); });
    });
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

void write_vertices(Columns& columns, const BodyInput& input) {
    for (std::size_t i = 0; i < input.vertices.size(); ++i) {
        const RestVertex& v = input.vertices[i];
        columns[Body::cos_half_beta][i] = static_cast<float>(std::numbers::sqrt2 * std::cos(v.beta / 2));
        columns[Body::sin_half_beta][i] = static_cast<float>(std::numbers::sqrt2 * std::sin(v.beta / 2));
        columns[Body::rho][i] = static_cast<float>(v.rho);
        columns[Body::lift][i] = static_cast<float>(v.wrinkle * v.rho);
        columns[Body::height][i] = static_cast<float>(v.z / input.length - 0.5);
        columns[Body::wrinkle][i] = static_cast<float>(v.wrinkle);
        columns[Body::slope][i] = static_cast<float>(v.slope);
    }
}

BodyFrame frame_of(const BodyInput& input) {
    BodyFrame frame;
    for (int row = 0; row < 3; ++row) {
        for (int c = 0; c < 3; ++c) frame.axes[c][row] = static_cast<float>(input.axes[c][row]);
        frame.origin[row] = static_cast<float>(input.origin[row]);
    }
    frame.length = static_cast<float>(input.length);
    frame.per_length = static_cast<float>(1 / input.length);
    frame.radius = static_cast<float>(input.radius);
    return frame;
}

Bands bands_of(const Columns& columns) {
    Bands bands;
    const std::span<const float> heights = columns[Body::height];
    const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
    bands.lowest = *lowest;
    bands.highest = *highest;
    bands.rho.fill(-1);
    const float per_height =
        *highest > *lowest ? static_cast<float>(Bands::count) / (*highest - *lowest) : 0.0f;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const auto band = static_cast<std::size_t>((heights[i] - *lowest) * per_height);
        const std::size_t place = std::min(band, Bands::count - 1) + 1;
        bands.rho[place] = std::max(bands.rho[place], columns[Body::rho][i]);
        bands.lift[place] = std::max(bands.lift[place], columns[Body::lift][i]);
        bands.dip[place] = std::max(bands.dip[place], -columns[Body::lift][i]);
    }
    return bands;
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
        case BodyFault::length:
            return "length: not a positive number";
        case BodyFault::radius:
            return "radius: not a positive number";
        case BodyFault::max_angle:
            return "max_angle: not above 0 and below length / (2 radius)";
        case BodyFault::table:
            return "table: fewer than two rows, or a number in it is not finite";
        case BodyFault::vertices:
            return "vertices: none, one not finite, a rho below 0 or a z outside 0..length";
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
    if (!positive(input.length)) return BodyFault::length;
    if (!positive(input.radius)) return BodyFault::radius;
    if (!positive(input.max_angle) || input.max_angle > input.length / (2 * input.radius) * (1 + 1e-6)) {
        return BodyFault::max_angle;
    }
    if (!usable(input.table)) return BodyFault::table;
    const bool vertices_usable = std::all_of(input.vertices.begin(), input.vertices.end(),
                                             [&](const RestVertex& v) { return usable(v, input.length); });
    if (input.vertices.empty() || !vertices_usable) return BodyFault::vertices;
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
    body.columns_ = Columns(!input.tangents.empty() ? column_count : column_count_without_tangents,
                            input.vertices.size());
    body.table_ = input.table;
    body.origin_ = input.origin;
    body.axes_ = input.axes;
    body.length_ = input.length;
    body.radius_ = input.radius;
    body.max_angle_ = static_cast<float>(input.max_angle);
    write_vertices(body.columns_, input);
    body.frame_ = frame_of(input);
    body.bands_ = bands_of(body.columns_);
    write_vectors(body.columns_, normal_rho, input.normals);
    write_vectors(body.columns_, tangent_rho, input.tangents);
    if (body.has_tangents()) {
        std::copy(input.tangent_signs.begin(), input.tangent_signs.end(),
                  body.columns_[tangent_sign].begin());
    }
    return body;
}

std::size_t Body::bytes() const noexcept {
    return sizeof(Body) + columns_.bytes() + table_.rows.size() * sizeof(WrinkleRow);
}

}  // namespace goffer::bend
