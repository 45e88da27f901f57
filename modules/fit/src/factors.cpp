// SPDX-License-Identifier: MIT
#include "factors.hpp"

#include "rest.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/engine/parallel.hpp>

#include <glm/geometric.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>
#include <numeric>
#include <vector>

namespace goffer::fit {
namespace {

constexpr std::size_t rows = 17;         // of a table of factors
constexpr double most = 2;               // factor
constexpr double most_slice = 1.5;       // factor of a slice
constexpr double area_tolerance = 2e-5;  // of the region's area
constexpr int max_steps = 6;             // of Newton's method, which needs two or three

/// A region's surface in one pose, at the places of the body's vertices. The map is linear in the wrinkle's
/// amplitude, so that the bare bend and the wrinkled one give all of them.
struct Surface {
    std::vector<glm::vec3> bare;
    std::vector<glm::vec3> wrinkle;  // what the wrinkle adds
};

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

/// The triangles that have two corners or more in the region, as vertices of the body.
std::vector<std::uint32_t> triangles_of(const bend::Region& region, std::span<const std::uint32_t> triangles,
                                        std::span<const std::uint32_t> place) {
    std::vector<std::uint32_t> own;
    for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
        int corners = 0;
        for (std::size_t i = t; i < t + 3; ++i) {
            const std::uint32_t vertex = place.empty() ? triangles[i] : place[triangles[i]];
            corners += vertex >= region.first && vertex < region.last ? 1 : 0;
        }
        if (corners < 2) continue;
        for (std::size_t i = t; i < t + 3; ++i)
            own.push_back(place.empty() ? triangles[i] : place[triangles[i]]);
    }
    return own;
}

/// A pose as a vector, which points where it bends and is as long as its angle.
glm::vec2 arc_of(const bend::Pose& pose) {
    return pose.angle * glm::vec2(std::cos(pose.direction), std::sin(pose.direction));
}

bend::Pose bent_by(const bend::Pose& pose, glm::vec2 change) {
    const glm::vec2 arc = arc_of(pose) + change;
    return {glm::length(arc), std::atan2(arc.y, arc.x)};
}

/// Bends a body, one region at a time, together with those that its folds run on into. Sets the part of the
/// surface that `triangles` need, which are vertices of the body, one at least.
class Poser {
public:
    Poser(const bend::Body& body, std::span<const std::uint32_t> triangles)
        : body_(body), poses_(body.rest_poses()) {
        const auto [first, last] = std::ranges::minmax(triangles);
        first_ = first, last_ = last + std::size_t{1};
    }

    /// The surface with a region in a pose, and others at rest, but for those that share its wave: their
    /// curvatures change as its own does, as far as they can, so that what passes over the joints is neither
    /// lost nor gained.
    void bend(std::size_t region, const bend::Pose& pose, Surface& surface) {
        const std::span<const bend::RegionInput> inputs = body_.region_inputs();
        const bend::Pose rest = body_.rest_pose(region);
        const auto follow = [&](std::size_t r) {
            const float share = static_cast<float>(inputs[r].length / inputs[region].length);
            poses_[r] = bent_by(body_.rest_pose(r), share * (arc_of(pose) - arc_of(rest)));
            poses_[r].angle = std::min(poses_[r].angle, body_.max_angle(r));
        };
        for (std::size_t r = region; r > 0 && inputs[r - 1].blend != 0; --r) follow(r - 1);
        for (std::size_t r = region; inputs[r].blend != 0; ++r) follow(r + 1);
        poses_[region] = pose;
        deform(0, surface.bare);
        deform(1, surface.wrinkle);
        for (std::size_t i = first_; i < last_; ++i) surface.wrinkle[i] -= surface.bare[i];
    }

    /// The body at rest.
    [[nodiscard]] Surface rest() {
        Surface surface;
        deform(0, surface.bare);
        surface.wrinkle.resize(surface.bare.size());
        return surface;
    }

private:
    void deform(float wrinkle_weight, std::vector<glm::vec3>& positions) {
        positions.resize(body_.vertex_count());
        bend::DeformJob job;
        job.body = &body_;
        job.poses = poses_;
        job.wrinkle_weight = wrinkle_weight;
        job.transform[3] = -glm::vec3(body_.origin());  // so that no digits are lost far from the origin
        job.positions = interleaved<3>(&positions[0].x, positions.size());
        if (last_ - first_ == body_.vertex_count()) {
            bend::run(job);
        } else {
            bend::run_range(job, first_, last_);
        }
    }

    const bend::Body& body_;
    std::size_t first_, last_;
    std::vector<bend::Pose> poses_;
};

/// Solves one direction's column of a region's table. Calls row_done() for each row.
template <class RowDone>
void solve_direction(const bend::Body& body, std::size_t region, std::size_t direction,
                     std::span<const std::uint32_t> triangles, double wanted, bend::FactorTable& table,
                     const RowDone& row_done) {
    Poser poser(body, triangles);
    Surface surface;
    std::vector<NormalPowers> normals;
    double square = 1;
    for (std::size_t row = rows - 1; row > 0; --row) {  // from where it is best determined
        const float root = static_cast<float>(row) / static_cast<float>(rows - 1);
        const float turned = 2 * std::numbers::pi_v<float> * static_cast<float>(direction) /
                             static_cast<float>(bend::FactorTable::directions);
        const float toward = body.rest_pose(region).direction + turned;
        poser.bend(region, {root * root * table.max_angle, toward}, surface);
        gather(surface, triangles, normals);
        square = solve_square(normals, wanted, square > 0 ? std::sqrt(square) : 1);
        table.rows[row][direction] = static_cast<float>(square);
        row_done();
    }
    table.rows[0][direction] = table.rows[1][direction];
}

bend::FactorTable factors_of(const bend::Body& body, std::size_t region,
                             std::span<const std::uint32_t> triangles, double wanted, const Share& share) {
    constexpr std::size_t steps = (rows - 1) * bend::FactorTable::directions;
    bend::FactorTable table;
    table.max_angle = body.max_angle(region);
    table.rows.resize(rows);
    std::atomic<bool> failed = false;
    std::atomic<std::size_t> done = 0;
    parallel_ranges(bend::FactorTable::directions, 1, [&](std::size_t first, std::size_t last) {
        try {
            for (; first < last; ++first)
                solve_direction(body, region, first, triangles, wanted, table,
                                [&] { share.tell(++done, steps); });
        } catch (...) {  // no memory: nothing else throws here
            failed = true;
        }
    });
    if (failed) throw std::bad_alloc();
    return table;
}

/// A triangle's share in the slices about two neighboring knots.
struct Slice {
    std::size_t first;
    double next;  // share of the slice behind `first`; the rest is that of `first`
};

/// Areas of slices, each a sum over triangles.
using SliceAreas = std::vector<double>;

/// Factors along z, in what they change.
class SliceSolver {
public:
    /// The slices lie between the heights `low` and `high`.
    SliceSolver(std::span<const std::uint32_t> triangles, std::span<const double> heights, double low,
                double high, std::size_t knots)
        : triangles_(triangles), knots_(knots) {
        const auto slice = [&](double z) { return slice_at((z - low) / (high - low)); };
        for (const double z : heights) places_.push_back(slice(z));
        for (std::size_t t = 0; t < triangles.size(); t += 3) {
            const double z = heights[triangles[t]] + heights[triangles[t + 1]] + heights[triangles[t + 2]];
            slices_.push_back(slice(z / 3));
        }
    }

    /// Adds the areas of the slices with the wrinkle times `factors`.
    void add_areas(const Surface& surface, std::span<const double> factors, SliceAreas& areas) const {
        const auto [first, last] = std::ranges::minmax(triangles_);
        std::vector<glm::vec3> at(surface.bare.size());
        for (std::size_t i = first; i <= last; ++i) {
            const Slice& place = places_[i];
            const double factor =
                factors[place.first] + place.next * (factors[place.first + 1] - factors[place.first]);
            at[i] = surface.bare[i] + static_cast<float>(factor) * surface.wrinkle[i];
        }
        for (std::size_t t = 0; t < triangles_.size(); t += 3) {
            const glm::vec3 u = at[triangles_[t + 1]] - at[triangles_[t]];
            const glm::vec3 v = at[triangles_[t + 2]] - at[triangles_[t]];
            const double area = static_cast<double>(glm::length(glm::cross(u, v))) / 2;
            const Slice& slice = slices_[t / 3];
            areas[slice.first] += (1 - slice.next) * area;
            areas[slice.first + 1] += slice.next * area;
        }
    }

private:
    [[nodiscard]] Slice slice_at(double share) const {
        const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(knots_ - 1);
        const auto first = std::min(static_cast<std::size_t>(at), knots_ - 2);
        return {first, at - static_cast<double>(first)};
    }

    std::span<const std::uint32_t> triangles_;
    std::size_t knots_;
    std::vector<Slice> places_, slices_;  // of vertices; of triangles
};

/// A better factor for a slice that gains `gain` area by `factor` and is `missing` so much without a wrinkle.
double next_factor(double factor, double gain, double missing, double area) {
    constexpr double least_gain = 2e-3;  // of the area, below which a factor says nothing
    if (missing <= 0) {
        factor *= 0.5;
    } else if (gain > least_gain * area) {
        factor *= std::clamp(std::sqrt(missing / gain), 0.6, 1.4);  // area is nearly linear in the square
    }
    return std::clamp(factor, 0.0, most_slice);
}

/// The poses in which slices are to keep their area: far, but not as far as the body can be bent. One that is
/// bent at rest is bent further.
std::vector<bend::Pose> slice_poses(const bend::Body& body, std::size_t region) {
    constexpr int directions = 8;
    const bend::Pose rest = body.rest_pose(region);
    const float largest = body.max_angle(region);
    std::vector<bend::Pose> poses;
    if (rest.angle != 0) {
        for (const float turn : {-0.5f, 0.0f, 0.5f})
            poses.push_back({rest.angle + 0.5f * (largest - rest.angle), rest.direction + turn});
        return poses;
    }
    const float angle = std::min(0.6f * largest, std::numbers::pi_v<float> / 2);
    for (int i = 0; i < directions; ++i)
        poses.push_back({angle, 2 * std::numbers::pi_v<float> * static_cast<float>(i) / directions});
    return poses;
}

}  // namespace

std::vector<double> solve_weights(const bend::Body& body, const Geometry& geometry,
                                  std::span<const std::uint32_t> order, std::span<const double> heights,
                                  std::size_t region, int folds, const Share& share) {
    constexpr std::size_t steps = 6;
    // Two folds apart at least: a slice that is shorter than a fold would follow its crest and trough.
    const auto knots = static_cast<std::size_t>(std::clamp(folds / 2 + 1, 3, 13));
    const std::vector<std::uint32_t> triangles =
        triangles_of(body.regions()[region], geometry.triangles, places_in_body(order));
    if (body.region_inputs()[region].table.empty() || triangles.empty()) return {};
    double low = 0;
    for (std::size_t r = 0; r < region; ++r) low += body.region_inputs()[r].length;
    const SliceSolver solver(triangles, heights, low, low + body.region_inputs()[region].length, knots);
    std::vector<Surface> surfaces;
    const std::vector<double> none(knots, 0);
    std::vector<double> factors(knots, 1);
    SliceAreas wanted(knots), bare(knots);
    const Surface at_rest = Poser(body, triangles).rest();
    const std::vector<bend::Pose> poses = slice_poses(body, region);
    for (const bend::Pose& pose : poses) {
        Poser(body, triangles).bend(region, pose, surfaces.emplace_back());
        solver.add_areas(at_rest, none, wanted);
        solver.add_areas(surfaces.back(), none, bare);
        share.step(0, 2).tell(surfaces.size(), poses.size());
    }
    for (std::size_t step = 0; step < steps; ++step) {
        SliceAreas now(knots);
        for (const Surface& surface : surfaces) solver.add_areas(surface, factors, now);
        for (std::size_t i = 0; i < knots; ++i)
            factors[i] = next_factor(factors[i], now[i] - bare[i], wanted[i] - bare[i], wanted[i]);
        share.step(1, 2).tell(step + 1, steps);
    }
    return factors;
}

void solve_factors(const bend::Body& body, const Geometry& geometry, std::span<const std::uint32_t> order,
                   std::span<bend::RegionInput> regions, const Share& share) {
    const std::vector<std::uint32_t> place = places_in_body(order);
    for (std::size_t r = 0; r < regions.size(); ++r) {
        std::vector<std::uint32_t> triangles = triangles_of(body.regions()[r], geometry.triangles, place);
        if (regions[r].table.empty() || triangles.empty()) continue;
        // Whole lanes: points, which have no area.
        while (triangles.size() % (3 * lanes) != 0) triangles.push_back(triangles[0]);
        std::vector<NormalPowers> normals;
        gather(Poser(body, triangles).rest(), triangles, normals);
        const double wanted = area_of(normals, 0).area;
        regions[r].factors = factors_of(body, r, triangles, wanted, share.step(r, regions.size()));
    }
}

}  // namespace goffer::fit
