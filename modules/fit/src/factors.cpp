// SPDX-License-Identifier: MIT
#include "factors.hpp"

#include "poser.hpp"
#include "rest.hpp"

#include <goffer/engine/parallel.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace goffer::fit {
namespace {

constexpr std::size_t rows = 17;         // of a table of factors
constexpr double most = 2;               // factor
constexpr double area_tolerance = 2e-5;  // of the region's area
constexpr int max_steps = 6;             // of Newton's method, which needs two or three

/// Triangles that are computed side by side, so that compilers take vectors for them.
constexpr std::size_t lanes = 8;

using Lanes = std::array<float, lanes>;

/// Vectors, one in each lane.
struct Vectors {
    Lanes x{}, y{}, z{};

    void set(std::size_t lane, const glm::vec3& v) { x[lane] = v.x, y[lane] = v.y, z[lane] = v.z; }
};

/// Adds ay bz - az by to `sum`.
void add_product(const Lanes& ay, const Lanes& az, const Lanes& by, const Lanes& bz, Lanes& sum) {
    for (std::size_t i = 0; i < lanes; ++i) sum[i] += ay[i] * bz[i] - az[i] * by[i];
}

void add_cross(const Vectors& a, const Vectors& b, Vectors& sum) {
    add_product(a.y, a.z, b.y, b.z, sum.x);
    add_product(a.z, a.x, b.z, b.x, sum.y);
    add_product(a.x, a.y, b.x, b.y, sum.z);
}

/// The normals of triangles, twice as long as their areas, in powers of the factor.
struct NormalPowers {
    Vectors bare, linear, square;
};

/// Gathers the normals of a region's triangles in one pose. This is done once, since Newton's method looks at
/// them for several factors.
void gather(const Surface& surface, std::span<const std::uint32_t> triangles,
            std::vector<NormalPowers>& normals) {
    normals.clear();
    normals.reserve(triangles.size() / 3 / lanes + 1);
    for (std::size_t first = 0; first < triangles.size(); first += 3 * lanes) {
        Vectors u, v, du, dv;
        for (std::size_t i = 0; i < lanes; ++i) {
            const std::size_t t = first + 3 * i;
            const std::uint32_t a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
            u.set(i, surface.bare[b] - surface.bare[a]);
            v.set(i, surface.bare[c] - surface.bare[a]);
            du.set(i, surface.wrinkle[b] - surface.wrinkle[a]);
            dv.set(i, surface.wrinkle[c] - surface.wrinkle[a]);
        }
        NormalPowers& n = normals.emplace_back();
        add_cross(u, v, n.bare);
        add_cross(u, dv, n.linear);
        add_cross(du, v, n.linear);
        add_cross(du, dv, n.square);
    }
}

/// Sum of the triangles' areas, and its derivative by the factor.
struct Area {
    double area = 0;
    double slope = 0;
};

Area area_of(const std::vector<NormalPowers>& normals, double factor) {
    const auto m = static_cast<float>(factor);
    std::array<double, lanes> areas{}, slopes{};
    for (const NormalPowers& n : normals) {
        for (std::size_t i = 0; i < lanes; ++i) {
            const float x = n.bare.x[i] + m * (n.linear.x[i] + m * n.square.x[i]);
            const float y = n.bare.y[i] + m * (n.linear.y[i] + m * n.square.y[i]);
            const float z = n.bare.z[i] + m * (n.linear.z[i] + m * n.square.z[i]);
            const float length = std::sqrt(x * x + y * y + z * z);
            const float along = x * (n.linear.x[i] + 2 * m * n.square.x[i]) +
                                y * (n.linear.y[i] + 2 * m * n.square.y[i]) +
                                z * (n.linear.z[i] + 2 * m * n.square.z[i]);
            areas[i] += static_cast<double>(length);
            // The smallest float in place of 0, where x, y and z are 0 too.
            slopes[i] += static_cast<double>(along / std::max(length, std::numeric_limits<float>::min()));
        }
    }
    return {std::accumulate(areas.begin(), areas.end(), 0.0) / 2,
            std::accumulate(slopes.begin(), slopes.end(), 0.0) / 2};
}

/// The factor in 0..most at which the surface has `wanted` area, or comes nearest to it.
double solve(const std::vector<NormalPowers>& normals, double wanted, double guess) {
    double factor = guess;
    double best = guess, best_error = std::numeric_limits<double>::infinity();
    for (int step = 0; step < max_steps; ++step) {
        const Area at = area_of(normals, factor);
        const double error = at.area - wanted;
        if (std::fabs(error) < best_error) best = factor, best_error = std::fabs(error);
        if (best_error <= area_tolerance * wanted) break;
        // Toward 0 the area no longer depends on the factor: a step is then no more than a try.
        const double change = at.slope > 1e-6 * wanted ? -error / at.slope : error < 0 ? 0.25 : -0.25;
        const double next = std::clamp(factor + std::clamp(change, -0.5, 0.5), 0.0, most);
        if (next == factor) break;
        factor = next;
    }
    return best;
}

/// The square of that factor. Where even the bare bend has more area than is wanted, it is below 0, as if
/// area grew evenly with the square, so that the table interpolates well up to where wrinkles begin. Where
/// there is nothing to wrinkle it is that of the guess.
double solve_square(const std::vector<NormalPowers>& normals, double wanted, double guess) {
    constexpr double least = -4;
    const double factor = solve(normals, wanted, guess);
    if (factor > 0) return factor * factor;
    const double bare = area_of(normals, 0).area;
    const double gain = area_of(normals, 1).area - bare;
    return gain > 1e-6 * wanted ? std::clamp((wanted - bare) / gain, least, 0.0) : guess * guess;
}

/// Solves one direction's column of a region's table. Calls row_done() for each row. Returns the area that is
/// missing in the last pose whose angle is `told_angle` at most.
template <class RowDone>
double solve_direction(const bend::Body& body, std::size_t region, std::size_t direction,
                       std::span<const std::uint32_t> triangles, double wanted, double told_angle,
                       bend::FactorTable& table, const RowDone& row_done) {
    Poser poser(body, triangles);
    Surface surface;
    std::vector<NormalPowers> normals;
    double square = 1;
    std::optional<double> missing;
    for (std::size_t row = rows - 1; row > 0; --row) {  // from where it is best determined
        const float root = static_cast<float>(row) / static_cast<float>(rows - 1);
        const float turned = 2 * std::numbers::pi_v<float> * static_cast<float>(direction) /
                             static_cast<float>(bend::FactorTable::directions);
        const float toward = body.rest_pose(region).direction + turned;
        poser.bend(region, {root * root * table.max_angle, toward}, surface);
        gather(surface, triangles, normals);
        square = solve_square(normals, wanted, square > 0 ? std::sqrt(square) : 1);
        if (!missing && static_cast<double>(root * root * table.max_angle) <= told_angle)
            missing = wanted - area_of(normals, std::sqrt(std::max(square, 0.0))).area;
        table.rows[row][direction] = static_cast<float>(square);
        row_done();
    }
    table.rows[0][direction] = table.rows[1][direction];
    return missing.value_or(0);
}

/// A region's table, and the area that is missing with it, on the mean of all directions.
struct SolvedTable {
    bend::FactorTable factors;
    double missing = 0;
};

SolvedTable factors_of(const bend::Body& body, std::size_t region, std::span<const std::uint32_t> triangles,
                       double wanted, const Share& share) {
    constexpr std::size_t steps = (rows - 1) * bend::FactorTable::directions;
    bend::FactorTable table;
    table.max_angle = body.max_angle(region);
    table.rows.resize(rows);
    const double told_angle = std::numbers::pi / 2 * static_cast<double>(body.regions()[region].length) /
                              static_cast<double>(body.length());
    std::array<double, bend::FactorTable::directions> missing{};
    std::atomic<bool> failed = false;
    std::atomic<std::size_t> done = 0;
    parallel_ranges(bend::FactorTable::directions, 1, [&](std::size_t first, std::size_t last) {
        try {
            for (; first < last; ++first)
                missing[first] = solve_direction(body, region, first, triangles, wanted, told_angle, table,
                                                 [&] { share.tell(++done, steps); });
        } catch (...) {  // no memory: nothing else throws here
            failed = true;
        }
    });
    if (failed) throw std::bad_alloc();
    const double sum = std::accumulate(missing.begin(), missing.end(), 0.0);
    return {std::move(table), sum / bend::FactorTable::directions};
}

}  // namespace

double solve_factors(const bend::Body& body, const Geometry& geometry, std::span<const std::uint32_t> order,
                     std::span<bend::RegionInput> regions, const Share& share) {
    const std::vector<std::uint32_t> place = places_in_body(order);
    double all = 0, missing = 0;
    for (std::size_t r = 0; r < regions.size(); ++r) {
        std::vector<std::uint32_t> triangles = triangles_of(body.regions()[r], geometry.triangles, place);
        if (regions[r].table.empty() || triangles.empty()) continue;
        // Whole lanes: points, which have no area.
        while (triangles.size() % (3 * lanes) != 0) triangles.push_back(triangles[0]);
        std::vector<NormalPowers> normals;
        gather(Poser(body, triangles).rest(), triangles, normals);
        const double wanted = area_of(normals, 0).area;
        SolvedTable solved = factors_of(body, r, triangles, wanted, share.step(r, regions.size()));
        regions[r].factors = std::move(solved.factors);
        all += wanted;
        missing += solved.missing;
    }
    return all > 0 ? missing / all : 0;
}

}  // namespace goffer::fit
