// SPDX-License-Identifier: MIT
#include "body/check.hpp"
#include "file/format.hpp"

#include <goffer/bend/body_input.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace goffer::bend {
namespace {

using Range = WorkingRange;

/// What is written was rounded to float, so that a number at its limit may lie beyond by this share of it.
constexpr double rounding = 1e-6;

/// The lowest and the highest of some floats, as integers in the same order: one loop finds both, and what is
/// not finite lies outside all finite ones. The mapping is its own inverse.
struct ColumnExtent {
    std::int32_t lowest = std::numeric_limits<std::int32_t>::max();
    std::int32_t highest = std::numeric_limits<std::int32_t>::min();

    static std::int32_t ordered(std::int32_t bits) noexcept { return bits ^ ((bits >> 31) & 0x7fffffff); }

    [[nodiscard]] bool finite() const noexcept {
        constexpr float most = std::numeric_limits<float>::max();
        return low() >= -most && high() <= most;
    }
    [[nodiscard]] float low() const noexcept { return std::bit_cast<float>(ordered(lowest)); }
    [[nodiscard]] float high() const noexcept { return std::bit_cast<float>(ordered(highest)); }
    [[nodiscard]] double largest() const noexcept {
        return static_cast<double>(std::max(std::fabs(low()), std::fabs(high())));
    }
};

ColumnExtent extent_of(const float* column, std::size_t first, std::size_t last) noexcept {
    ColumnExtent extent;
    for (std::size_t i = first; i < last; ++i) {
        const std::int32_t value = ColumnExtent::ordered(std::bit_cast<std::int32_t>(column[i]));
        extent.lowest = std::min(extent.lowest, value);
        extent.highest = std::max(extent.highest, value);
    }
    return extent;
}

/// Whether the sums of squares of `N` columns lie within `slack` of `wanted`. Compares them as integers,
/// whose order is the same where no sign is, so that compilers make vectors of the loop.
template <std::size_t N>
bool squares_are(double wanted, double slack, const std::array<const float*, N>& columns, std::size_t first,
                 std::size_t last) noexcept {
    std::int32_t lowest = std::bit_cast<std::int32_t>(static_cast<float>(wanted)), highest = lowest;
    for (std::size_t i = first; i < last; ++i) {
        float sum = 0;
        for (const float* column : columns) sum += column[i] * column[i];
        lowest = std::min(lowest, std::bit_cast<std::int32_t>(sum));
        highest = std::max(highest, std::bit_cast<std::int32_t>(sum));
    }
    return static_cast<double>(std::bit_cast<float>(lowest)) >= wanted - slack &&
           static_cast<double>(std::bit_cast<float>(highest)) <= wanted + slack;
}

/// Which number of a vertex a column was made from.
BodyField field_of(const ColumnLayout& layout, std::size_t column) noexcept {
    constexpr std::array named{BodyField::beta, BodyField::beta,    BodyField::rho,  BodyField::wrinkle,
                               BodyField::z,    BodyField::wrinkle, BodyField::slope};
    constexpr std::array shape{BodyField::scale, BodyField::drift, BodyField::scale_slope};
    if (column < named.size()) return named[column];
    if (column < tangents) return BodyField::normals;
    if (column < layout.first_shape_column())
        return column == tangent_sign ? BodyField::tangent_signs : BodyField::tangents;
    return column < layout.first_rest_column() ? shape[column - layout.first_shape_column()]
                                               : BodyField::beta;
}

/// A bound on the numbers of a column, with which products of two of them are floats. Where the true one
/// depends on the region it is found later.
double most_of(const ColumnLayout& layout, std::size_t column) noexcept {
    constexpr double unit = 2, scales = 2 * Range::max_scale, least_rest = (1 - Range::max_rest) / 2;
    const std::size_t shape = layout.first_shape_column(), rest = layout.first_rest_column();
    if (column >= rest) return column < rest + rest_cosine ? unit : scales / least_rest;
    if (column >= shape)
        return column == shape + scale ? scales : static_cast<double>(std::numeric_limits<float>::max());
    const bool direction = column >= normals || column <= sin_half_beta;
    return direction && column != tangent_sign ? unit
                                               : static_cast<double>(std::numeric_limits<float>::max());
}

/// The columns of some vertices of a region.
class Stretch {
public:
    Stretch(const BodyData& data, std::size_t region, double depth) noexcept
        : data_(data),
          region_(data.inputs[region]),
          radius_(radius_of(region_, data.radius)),
          depth_(depth) {}

    /// The first fault of the vertices [first, last). Where the most extreme numbers of all of them would
    /// make no good vertex together, looks at each half.
    [[nodiscard]] BodyFault check(std::size_t first, std::size_t last) const noexcept {
        const BodyFault fault = check_together(first, last);
        if (fault.none() || last - first == 1) return fault;
        const std::size_t middle = first + (last - first) / 2;
        const BodyFault before = check(first, middle);
        return before.none() ? check(middle, last) : before;
    }

private:
    [[nodiscard]] BodyFault check_together(std::size_t first, std::size_t last) const noexcept {
        std::array<ColumnExtent, std::size_t{all_columns} + all_shape_columns + all_rest_columns> extents;
        const float* column = data_.columns.cos_half_beta;
        for (std::size_t c = 0; c < data_.layout.columns(); ++c, column += data_.stride) {
            extents[c] = extent_of(column, first, last);
            const BodyField field = field_of(data_.layout, c);
            if (!extents[c].finite()) return {field, Reason::not_finite, first};
            if (extents[c].largest() > most_of(data_.layout, c)) return {field, Reason::out_of_range, first};
        }
        if (const BodyFault fault = check_relations(first, last); !fault.none()) return fault;
        const ColumnExtent* shape = extents.data() + data_.layout.first_shape_column();
        const ColumnExtent* rest = extents.data() + data_.layout.first_rest_column();
        return check_vertices(extents.data(), data_.layout.shape ? shape : nullptr,
                              data_.layout.rest ? rest : nullptr, first);
    }

    /// What holds of each vertex: directions are of unit length, cosines and sines are of one angle, and
    /// columns that follow from others do.
    [[nodiscard]] BodyFault check_relations(std::size_t first, std::size_t last) const noexcept {
        const RestColumns& c = data_.columns;
        constexpr double unit = 1e-3 + rounding, angle = 10 * rounding;
        using Two = std::array<const float*, 2>;
        using Three = std::array<const float*, 3>;
        const auto fault = [&](BodyField field) { return BodyFault{field, Reason::out_of_range, first}; };
        if (!squares_are(2, 2 * angle, Two{c.cos_half_beta, c.sin_half_beta}, first, last))
            return fault(BodyField::beta);
        if (!squares_are(1, unit, Three{c.normal[0], c.normal[1], c.normal[2]}, first, last))
            return fault(BodyField::normals);
        if (data_.layout.rest && !rest_follows(first, last)) return fault(BodyField::beta);
        if (data_.layout.tangents &&
            !squares_are(1, unit, Three{c.tangent[0], c.tangent[1], c.tangent[2]}, first, last))
            return fault(BodyField::tangents);
        return {};
    }

    /// Two vertices of the most extreme numbers, which are what Body::make was given, and what it makes of
    /// these.
    [[nodiscard]] BodyFault check_vertices(const ColumnExtent* plain, const ColumnExtent* shape,
                                           const ColumnExtent* rest, std::size_t index) const noexcept {
        constexpr double inward = 1 - rounding, outward = 1 + rounding;
        RestVertex low, high;
        low.z = (static_cast<double>(plain[height].low()) * inward + 0.5) * region_.length;
        high.z = (static_cast<double>(plain[height].high()) * inward + 0.5) * region_.length;
        low.rho = static_cast<double>(plain[rho].low());
        high.rho = static_cast<double>(plain[rho].high()) * inward;
        if (shape != nullptr) {
            low.scale = std::min(static_cast<double>(shape[scale].low()) * outward, region_.max_scale);
            high.scale = std::max(static_cast<double>(shape[scale].high()) * inward, low.scale);
            low.drift = static_cast<double>(shape[drift].low()) * inward * region_.length;
            high.drift = static_cast<double>(shape[drift].high()) * inward * region_.length;
        }
        const auto out_of_range = [index](BodyField field) {
            return BodyFault{field, Reason::out_of_range, index};
        };
        if (!(low.scale > 0)) return out_of_range(BodyField::scale);
        const bool compares = compares_with_rest(region_);
        double factor = std::sqrt(low.scale), least_rest_scale = 1;
        if (rest != nullptr) {
            least_rest_scale = low.scale / static_cast<double>(rest[per_rest_scale].high());
            if (compares) factor = least_rest_scale;
        }
        const double offset = plain[radial_offset].largest(), most_taper = Range::max_taper / region_.length;
        const double taper = std::min(offset / least_rest_scale * most_taper,
                                      Range::max_growth / depth_ * (compares ? 1 : factor));
        if (offset > plain[wrinkle].largest() * high.rho * (1 + 4 * rounding) + tiny)
            return out_of_range(BodyField::wrinkle);
        if (shape != nullptr && shape[ShapeColumn::taper].largest() > taper * (1 + 4 * rounding) + tiny)
            return out_of_range(BodyField::scale_slope);
        high.wrinkle = plain[wrinkle].largest() * inward / factor;
        const double slope_of_factor = shape != nullptr && compares ? taper : 0;
        high.slope = std::max(plain[slope].largest() * inward - slope_of_factor, 0.0) / factor;
        const BodyFault fault = check_vertex(low, index, region_, radius_, depth_);
        return fault.none() ? check_vertex(high, index, region_, radius_, depth_) : fault;
    }

    /// What columns of RestColumn say of each vertex follows from others: its angle twice over, and S. Where
    /// a region is not compared with rest, S is 1.
    [[nodiscard]] bool rest_follows(std::size_t first, std::size_t last) const noexcept {
        const RestColumns& c = data_.columns;
        const bool compares = compares_with_rest(region_);
        const double kappa = compares ? region_.rest_angle * radius_ / region_.length : 0;
        const auto toward = static_cast<float>(kappa * std::cos(region_.rest_direction));
        const auto aside = static_cast<float>(kappa * std::sin(region_.rest_direction));
        const auto outline = static_cast<float>(kappa);
        constexpr float slack = 4e-6f;
        float beyond = 0;  // the largest distance beyond what rounding explains
        for (std::size_t i = first; i < last; ++i) {
            const float s = c.scale != nullptr ? c.scale[i] : 1, cosine = c.cos_beta[i], sine = c.sin_beta[i];
            const float rest = 1 - s * (outline + toward * cosine + aside * sine), per = c.per_rest_scale[i];
            const float half = c.cos_half_beta[i];
            const float angle =
                std::max(std::fabs(half * half - 1 - cosine), std::fabs(half * c.sin_half_beta[i] - sine));
            const float scaled =
                std::max(std::fabs(c.rest_cosine[i] - per * cosine), std::fabs(c.rest_sine[i] - per * sine));
            const float scale = std::fabs(per * rest - s) - slack * (s + per);
            beyond = std::max({beyond, angle - slack, scaled - slack * per, scale});
        }
        return beyond <= 0;
    }

    /// What a product of numbers that were rounded to 0 may differ by.
    static constexpr double tiny = 2e-33;

    const BodyData& data_;
    const RegionInput& region_;
    double radius_;
    double depth_;
};

/// Whether wrinkles pass into each other over a joint of `region` as check_near_joints() asks for. `depth`:
/// of the region's.
bool bears_offsets(const RestColumns& columns, const RegionInput& region, const Joint& joint,
                   double depth) noexcept {
    double most = 0;
    for (std::size_t i = joint.first; i < joint.last; ++i) {
        if (!joint.nears(columns.height[i])) continue;
        const double scale = columns.scale != nullptr ? static_cast<double>(columns.scale[i]) : 1;
        const double factor = compares_with_rest(region)
                                  ? scale / static_cast<double>(columns.per_rest_scale[i])
                                  : std::sqrt(scale);
        most = std::max(most, std::fabs(static_cast<double>(columns.radial_offset[i])) / factor);
    }
    return bears_offset(joint.blend, most * (1 - 4 * rounding), depth);
}

}  // namespace

bool all_below(std::size_t count, std::span<const std::uint32_t> indices) noexcept {
    std::uint32_t largest = 0;
    for (const std::uint32_t index : indices) largest = std::max(largest, index);
    return indices.empty() || largest < count;
}

BodyFault check_columns(BodyData& data) noexcept {
    for (std::size_t r = 0; r < data.regions.size(); ++r) {
        const auto [first, last] = std::pair(data.regions[r].first, data.regions[r].last);
        if (first == last) continue;
        Joints& joints = data.details[r].joints;
        if (!find_vertices(joints, data.columns, first, last))
            return {BodyField::vertices, Reason::out_of_range, first};
        for (const Joint& joint : {joints.below, joints.above}) {
            const double max_scale = data.inputs[joint.neighbor].max_scale;
            if (joint.first != joint.last &&
                !bears_scale(joint.blend, static_cast<double>(joint.max_scale), max_scale))
                return {BodyField::scale, Reason::out_of_range, joint.first};
        }
        const double depth = deepest_wrinkle(data.inputs, r, data.radius);
        const BodyFault fault = Stretch(data, r, depth).check(first, last);
        if (!fault.none()) return fault;
        for (const Joint& joint : {joints.below, joints.above}) {
            if (!bears_offsets(data.columns, data.inputs[r], joint, depth))
                return {BodyField::wrinkle, Reason::out_of_range, joint.first};
        }
    }
    return {};
}

}  // namespace goffer::bend
