// SPDX-License-Identifier: MIT
#include "support/angles.hpp"

#include <goffer/paper/chain.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

/// Chains whose folds run on over their joints. See modules/paper/README.md, "Folds over joints".

namespace goffer::paper {
namespace {

using test::pi;

/// Regions of `folds` folds each, of one wave.
std::vector<Parameters> joined(const std::vector<int>& folds, double fold_length, double radius) {
    std::vector<Parameters> regions;
    int total = 0, before = 0;
    for (const int count : folds) total += count;
    for (const int count : folds) {
        Parameters region;
        region.length = fold_length * count;
        region.radius = radius;
        region.profile = Profile::even;
        region.folds = {count, before, total};
        regions.push_back(region);
        before += count;
    }
    return regions;
}

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / pi;
}

const std::vector<Pose> poses{{0.7, 0}, {0.4, 2}, {0, 0}, {0.9, -1}};
const std::vector<Pose> rest_poses{{0.5, 0.3}, {0.3, -2}, {0.6, 1}, {0.2, -0.5}};

/// Regions that are bent along `rest_poses` at rest, each along an arc of its own, and have these onsets.
/// With a shape, each has a radius of its own, and they are of one thickness where they meet.
std::vector<Parameters> bent_at_rest(bool shaped, const std::vector<double>& onsets) {
    std::vector<Parameters> regions = joined({4, 3, 5, 3}, 0.7, 1);
    const double thick[] = {1.3, 0.9, 0.6, 1, 0.8};
    for (std::size_t r = 0; r < regions.size(); ++r) {
        Parameters& region = regions[r];
        region.rest_angle = rest_poses[r].angle;
        region.rest_direction = rest_poses[r].direction;
        region.onset = onsets[r];
        if (!shaped) continue;
        const Shape::Knots knots{.radius = {thick[r], 1, thick[r + 1]}, .weight = {0.7, 1.1}};
        region.shape = std::make_shared<const Shape>(region.length, 1, knots);
        region.radius = region.shape->radius();
    }
    return regions;
}

/// Calls visit(regions) for such regions of every kind.
template <class Visit>
void each_bent_at_rest(const Visit& visit) {
    for (const bool shaped : {false, true}) {
        for (const std::vector<double>& onsets : {std::vector<double>(4, 0), std::vector<double>(4, 0.01),
                                                  std::vector<double>{0, 0.01, 0.1, 0}}) {
            CAPTURE(shaped);
            CAPTURE(onsets[1]);
            CAPTURE(onsets[3]);
            visit(bent_at_rest(shaped, onsets));
        }
    }
}

/// The same without wrinkles.
std::vector<Parameters> bare(std::vector<Parameters> regions) {
    for (Parameters& region : regions) region.folds = 0;
    return regions;
}

/// Whether the squeeze of a region sets in near `beta`. Its depth has a corner there, or an infinite slope.
bool sets_in(const ClosedForm& region, double beta) {
    const auto wrinkles = [&](double at) { return region.depth(at, 1).amplitude > 0; };
    return wrinkles(beta - 0.02) != wrinkles(beta + 0.02);
}

/// Compares what the chain makes of directions at a place with differences of its positions.
void check_derivatives(const Chain& chain, std::size_t region, const Cylindrical& place) {
    constexpr double step = 1e-6;
    const auto at = [&](double turn, double up) {
        return chain.position(region, {place.beta + turn, place.z + up, place.rho});
    };
    const glm::dvec3 along = (at(0, step) - at(0, -step)) / (2 * step);
    const glm::dvec3 around = (at(step, 0) - at(-step, 0)) / (2 * step);
    CHECK(degrees_between(chain.tangent(region, place, {0, 0, 1}), along) < 1e-5);
    CHECK(degrees_between(chain.tangent(region, place, {0, 1, 0}), around) < 1e-5);
    CHECK(degrees_between(chain.normal(region, place, {1, 0, 0}), glm::cross(around, along)) < 1e-5);
}

/// Heights near both ends of a region, and one between.
std::vector<double> heights_of(const Parameters& region) {
    return {0.05, 0.12, 0.5, region.length - 0.12, region.length - 0.05};
}

}  // namespace

TEST_CASE("P9: a chain of one curvature whose folds run on is one region, wrinkles and all") {
    const std::vector<Parameters> regions = joined({3, 6, 2}, 0.7, 1);
    Parameters whole = regions[0];
    whole.length = 11 * 0.7;
    whole.folds = 11;
    const ClosedForm one(whole, {2.2, 0.3});
    const std::vector<Pose> alike{{0.6, 0.3}, {1.2, 0.3}, {0.4, 0.3}};
    const std::vector<double> blends{0.2, 0.35};
    const Chain chain(regions, alike, blends);
    double start = 0;
    for (std::size_t r = 0; r < regions.size(); ++r) {
        for (const double share : {0.0, 0.01, 0.2, 0.5, 0.77, 0.98, 1.0}) {
            for (double beta = -3; beta < 3; beta += 0.37) {
                const Cylindrical at{beta, share * regions[r].length, 1.02};
                const Cylindrical same{beta, start + at.z, 1.02};
                CHECK(glm::distance(chain.position(r, at), one.position(same)) < 1e-12);
                CHECK(degrees_between(chain.normal(r, at, {1, 0, 0}), one.normal(same, {1, 0, 0})) < 1e-9);
            }
        }
        start += regions[r].length;
    }
}

TEST_CASE("folds over joints: both sides of a joint meet, on a cylinder with their normals") {
    std::vector<Parameters> regions = joined({4, 3, 5, 3}, 0.7, 1);
    const std::vector<double> blends{0.2, 0.3, 0.1};
    for (const bool shaped : {false, true}) {
        if (shaped) {
            double radius = 1.2;
            for (Parameters& region : regions) {
                const Shape::Knots knots{.radius = {radius, radius - 0.05, radius - 0.1}};
                region.shape = std::make_shared<const Shape>(region.length, 1, knots);
                region.radius = region.shape->radius();
                radius -= 0.1;
            }
        }
        const Chain chain(regions, poses, blends);
        for (std::size_t r = 0; r + 1 < regions.size(); ++r) {
            for (double beta = -3; beta < 3; beta += 0.2) {
                const Cylindrical end{beta, regions[r].length, 1}, begin{beta, 0, 1};
                CHECK(glm::distance(chain.position(r, end), chain.position(r + 1, begin)) < 1e-12);
                if (shaped) continue;
                const CylindricalVector outward{1, 0, 0};
                CHECK(degrees_between(chain.normal(r, end, outward), chain.normal(r + 1, begin, outward)) <
                      1e-9);
            }
        }
    }
}

TEST_CASE("folds over joints: tangents are the map's derivatives, normals stand on them") {
    std::vector<Parameters> regions = joined({4, 3, 5, 3}, 0.7, 1);
    for (Parameters& region : regions) {
        const Shape::Knots knots{.radius = {1.1, 0.9, 1.05}, .weight = {0.7, 1.1}};
        region.shape = std::make_shared<const Shape>(region.length, 1, knots);
        region.radius = region.shape->radius();
    }
    for (const double onset : {0.0, 0.01}) {
        for (Parameters& region : regions) region.onset = onset;
        const Chain chain(regions, poses, std::vector<double>{0.3, 0.2, 0.3});
        for (std::size_t r = 0; r < regions.size(); ++r) {
            for (const double z : heights_of(regions[r])) {
                for (double beta = -2.9; beta < 3; beta += 0.31) check_derivatives(chain, r, {beta, z, 1.1});
            }
        }
    }
}

TEST_CASE("folds over joints: regions bent along different arcs at rest meet, normals too on a cylinder") {
    const std::vector<double> blends{0.2, 0.3, 0.1};
    each_bent_at_rest([&](const std::vector<Parameters>& regions) {
        const Chain chain(regions, poses, blends), without(bare(regions), poses);
        double deepest = 0;
        for (std::size_t r = 0; r + 1 < regions.size(); ++r) {
            for (double beta = -3; beta < 3; beta += 0.2) {
                const Cylindrical end{beta, regions[r].length, 1}, begin{beta, 0, 1};
                CHECK(glm::distance(chain.position(r, end), chain.position(r + 1, begin)) < 1e-12);
                deepest = std::max(deepest, glm::distance(chain.position(r, end), without.position(r, end)));
                if (regions[r].shape) continue;
                const CylindricalVector outward{1, 0, 0};
                CHECK(degrees_between(chain.normal(r, end, outward), chain.normal(r + 1, begin, outward)) <
                      1e-9);
            }
        }
        CHECK(deepest > 0.05);
    });
}

TEST_CASE("folds over joints: tangents are the map's derivatives between different arcs at rest, too") {
    each_bent_at_rest([&](const std::vector<Parameters>& regions) {
        const Chain chain(regions, poses, std::vector<double>{0.3, 0.2, 0.3});
        std::vector<ClosedForm> alone;
        for (std::size_t r = 0; r < regions.size(); ++r) alone.emplace_back(regions[r], poses[r]);
        int compared = 0;
        for (double beta = -2.9; beta < 3; beta += 0.31) {
            if (std::ranges::any_of(alone, [&](const ClosedForm& map) { return sets_in(map, beta); }))
                continue;
            ++compared;
            for (std::size_t r = 0; r < regions.size(); ++r) {
                for (const double z : heights_of(regions[r])) {
                    for (const double rho : {0.2, 1.1}) check_derivatives(chain, r, {beta, z, rho});
                }
            }
        }
        CHECK(compared > 10);
    });
}

TEST_CASE("P1: at rest, folds over joints are flat, between different arcs too") {
    each_bent_at_rest([&](const std::vector<Parameters>& regions) {
        const Chain chain(regions, rest_poses, std::vector<double>{0.3, 0.2, 0.3});
        const Chain rest(bare(regions), rest_poses);
        for (std::size_t r = 0; r < regions.size(); ++r) {
            for (const double z : heights_of(regions[r])) {
                for (double beta = -3; beta < 3; beta += 0.2) {
                    const Cylindrical at{beta, z, 1.1};
                    // The depth goes with the root of the squeeze, which is 0 but for rounding.
                    CHECK(glm::distance(chain.position(r, at), rest.position(r, at)) < 1e-7);
                    CHECK(degrees_between(chain.normal(r, at, {1, 0, 0}), rest.normal(r, at, {1, 0, 0})) <
                          1e-5);
                }
            }
        }
    });
}

TEST_CASE("folds over joints: what cannot be is refused") {
    const std::vector<Parameters> regions = joined({4, 3, 5, 3}, 0.7, 1);
    const auto refused = [&](const std::vector<Parameters>& given, const std::vector<double>& blends) {
        CHECK_THROWS_AS(Chain(given, poses, blends), std::invalid_argument);
    };
    CHECK_NOTHROW(Chain(regions, poses, std::vector<double>{0.1, 0, 0.1}));
    refused(regions, {0.1, 0.1});
    refused(regions, {-0.1, 0.1, 0.1});
    refused(regions, {std::nan(""), 0.1, 0.1});
    refused(regions, {1.5, 1.5, 0.1});
    std::vector<Parameters> changed = regions;
    changed[1].folds = 3;  // a wave of its own
    refused(changed, {0.1, 0.1, 0.1});
    changed = regions;
    changed[1].folds = {3, 13, 15};
    refused(changed, {});
    changed = regions;
    changed[1].shape = std::make_shared<const Shape>(changed[1].length, changed[1].radius,
                                                     Shape::Knots{.weight = {0, 0, 0, 0}});
    refused(changed, {0.1, 0.1, 0.1});
    changed = regions;
    changed[1].profile = Profile::smooth;
    refused(changed, {});
    changed = regions;
    changed[1].amplitude = Amplitude::area;
    refused(changed, {});
}

}  // namespace goffer::paper
