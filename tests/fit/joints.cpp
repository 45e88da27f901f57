// SPDX-License-Identifier: MIT
#include "synthetic.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/fit/patches.hpp>

#include <doctest/doctest.h>

#include <numbers>
#include <random>
#include <string>
#include <vector>

/// What folds that run on over joints do to the area of chains.

namespace goffer {
namespace {

constexpr float one_degree = std::numbers::pi_v<float> / 180;

/// Equal regions of a tube of radius 1.
struct TestChain {
    const char* name;
    double length;
    std::vector<float> angles, directions;  // degrees
    double most;                            // rms of the local change, in percent
};

/// Changes of area over 24 slices by 4 sides, and of the whole.
struct ChainChange {
    double local, whole;
};

ChainChange chain_change_of(const TestChain& chain, bool over_joints) {
    std::mt19937 random(11);
    test::Recipe tube{.columns = 96, .rows = 1200};
    tube.length = chain.length;
    const test::Solid solid = test::cylinder(tube, random);
    fit::Cylinder base = test::upright();
    base.length = chain.length;
    fit::BindOptions options;
    options.fold_length = 0.6;
    options.folds_over_joints = over_joints;
    options.regions.assign(chain.angles.size(), {1.0 / static_cast<double>(chain.angles.size()), {}});
    const fit::Binding binding = fit::bind(solid.geometry(), base, options);
    std::vector<bend::Pose> poses;
    for (std::size_t r = 0; r < chain.angles.size(); ++r)
        poses.push_back({chain.angles[r] * one_degree, chain.directions[r] * one_degree});
    std::vector<glm::vec3> bent(solid.positions.size()), sorted(bent.size());
    bend::DeformJob job{.body = &binding.body, .poses = poses};
    job.positions = interleaved<3>(&bent[0].x, bent.size());
    bend::run(job);
    for (std::size_t i = 0; i < bent.size(); ++i) sorted[binding.order[i]] = bent[i];
    const std::vector<std::uint32_t> patches = fit::patches_of(solid.geometry(), base, {24, 4});
    const std::vector<std::uint32_t> one(patches.size(), 0);
    return {100 * fit::patch_change(solid.geometry(), sorted, patches).rms,
            100 * fit::patch_change(solid.geometry(), sorted, one).worst};
}

}  // namespace

TEST_CASE(
    "folds over joints: chains keep their area, place by place, better than with folds that end at joints") {
    const TestChain chains[] = {
        {"spiral", 30, {30, 50, 80, 110, 130, 130}, std::vector<float>(6, 0), 2.4},
        {"S", 20, {70, 70}, {0, 180}, 1.6},
        {"worm", 24, std::vector<float>(8, 40), {0, 90, 180, 180, 270, 0, 0, 90}, 1.8},
    };
    for (const TestChain& chain : chains) {
        const ChainChange over = chain_change_of(chain, true), apart = chain_change_of(chain, false);
        MESSAGE(std::string(chain.name), ": local ", over.local, " % (all ", over.whole,
                " %), folds that end at joints ", apart.local, " % (", apart.whole, " %)");
        CHECK(over.local < chain.most);
        CHECK(over.local < apart.local);
        CHECK(std::abs(over.whole) < 2);
    }
}

TEST_CASE("folds over joints: they run on between folds of which one is at most three times as long") {
    std::mt19937 random(12);
    const test::Solid solid = test::cylinder({.columns = 12, .rows = 400}, random);
    for (const auto& [folds, runs_on] : {std::pair{17, true}, std::pair{19, false}}) {
        for (const bool longer_first : {false, true}) {
            fit::BindOptions options;
            options.regions = {{0.5, longer_first ? 6 : folds}, {0.5, longer_first ? folds : 6}};
            const fit::Binding binding = fit::bind(solid.geometry(), test::upright(), options);
            CHECK((binding.regions[0].blend > 0) == runs_on);
        }
    }
}

TEST_CASE("folds over joints: how far a body can be bent does not ask for its size") {
    std::mt19937 random(13);
    // Thick a little before the joint, where wrinkles of the region behind it reach, or a little behind it.
    for (const double thick : {4.5, 5.5}) {
        CAPTURE(thick);
        const test::Solid one =
            test::warped(test::cylinder({.columns = 24, .rows = 400}, random), [&](glm::dvec3 p) {
                const double away = p.z - thick, rho = 0.7 + 0.5 * std::exp(-16 * away * away);
                return glm::dvec3(rho * p.x, rho * p.y, p.z);
            });
        std::vector<double> angles, scales;
        for (const double size : {1.0, 0.1, 10.0}) {
            const test::Solid solid = test::placed(one, {.scale = size});
            fit::Cylinder cylinder = test::upright();
            cylinder.length *= size, cylinder.radius *= size;
            fit::BindOptions options;
            options.regions = {{0.5, {}}, {0.5, {}}};
            const fit::Binding binding = fit::bind(solid.geometry(), cylinder, options);
            REQUIRE(binding.regions[0].blend > 0);
            for (std::size_t r = 0; r < 2; ++r) {
                angles.push_back(static_cast<double>(binding.body.max_angle(r)));
                scales.push_back(binding.body.region_inputs()[r].max_scale);
            }
        }
        for (std::size_t i = 2; i < angles.size(); ++i) {
            CHECK(angles[i] == doctest::Approx(angles[i % 2]).epsilon(1e-4));
            CHECK(scales[i] == doctest::Approx(scales[i % 2]).epsilon(1e-4));
        }
    }
}

}  // namespace goffer
