// SPDX-License-Identifier: MIT
#include "support/angles.hpp"
#include "synthetic.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/fit/refine.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

/// BindOptions::wrinkle_range: a stretch of the body wrinkles, the rest stays as the bare bend has it.

using namespace goffer;
using namespace goffer::test;

namespace {

std::vector<glm::vec3> bent_positions(const fit::Binding& binding, double angle, float wrinkle_weight) {
    const bend::Body& body = binding.body;
    std::vector<bend::Pose> poses;
    for (std::size_t i = 0; i < body.region_count(); ++i)
        poses.push_back({static_cast<float>(angle / static_cast<double>(body.region_count())), 0.4f});
    std::vector<glm::vec3> positions(body.vertex_count()), sorted(body.vertex_count());
    bend::DeformJob job{.body = &body, .poses = poses, .wrinkle_weight = wrinkle_weight};
    job.positions = interleaved<3>(&positions[0].x, positions.size());
    bend::run(job);
    for (std::size_t i = 0; i < positions.size(); ++i)
        sorted[binding.order.empty() ? i : binding.order[i]] = positions[i];
    return sorted;
}

/// The farthest that a wrinkle takes a vertex within, or beyond, the range.
struct Reach {
    double inside = 0, outside = 0;

    Reach(const fit::Binding& binding, const Solid& solid, const fit::WrinkleRange& range) {
        const std::vector<glm::vec3> bare = bent_positions(binding, right_angle, 0),
                                     full = bent_positions(binding, right_angle, 1);
        for (std::size_t i = 0; i < bare.size(); ++i) {
            const double share = static_cast<double>(solid.positions[i].z) / 10;
            double& own = share > range.first && share < range.last ? inside : outside;
            own = std::max(own, static_cast<double>(glm::distance(bare[i], full[i])));
        }
    }
};

Solid fine_tube(int columns = 32, int rows = 241) {
    std::mt19937 random(1);
    return cylinder({.columns = columns, .rows = rows, .closed = false}, random);
}

std::string range_error(const fit::BindOptions& options) {
    try {
        (void)fit::bind(tube().geometry(), upright(), options);
    } catch (const fit::Error& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE(
    "wrinkle range: beyond it nothing wrinkles, with any profile, amplitude and radii, in regions too") {
    const Solid solid = fine_tube(24, 121);
    for (const fit::WrinkleRange range :
         {fit::WrinkleRange{0, 0.7}, fit::WrinkleRange{0.25, 1}, fit::WrinkleRange{0.2, 0.75}}) {
        for (const fit::Profile profile : {fit::Profile::even, fit::Profile::damped, fit::Profile::smooth}) {
            for (const fit::Amplitude amplitude : {fit::Amplitude::paper, fit::Amplitude::mesh}) {
                for (const std::size_t regions : {1u, 3u}) {
                    for (const bool shaped : {false, true}) {
                        CAPTURE(range.first);
                        CAPTURE(static_cast<int>(profile.kind));
                        CAPTURE(regions);
                        CAPTURE(shaped);
                        fit::BindOptions options;
                        options.wrinkle_range = range;
                        options.profile = profile;
                        options.amplitude = amplitude;
                        options.regions.assign(regions, {1.0 / static_cast<double>(regions), {}});
                        fit::Cylinder base = upright();
                        if (shaped) base.radii = {1.1, 1.1, 1, 0.9, 0.9};
                        const Reach reach(fit::bind(solid.geometry(), base, options), solid, range);
                        CHECK(reach.outside < 1e-5);
                        CHECK(reach.inside > 0.05);
                    }
                }
            }
        }
    }
}

TEST_CASE("wrinkle range: well within it, the body wrinkles as it does without one") {
    const Solid solid = fine_tube();
    for (const bool shaped : {false, true}) {
        fit::Cylinder base = upright();
        if (shaped) base.radii = {1.1, 1.1, 1, 0.9, 0.9};
        fit::BindOptions options;
        options.amplitude = fit::Amplitude::paper;
        const fit::WrinkleRange middle{0.4, 0.6};
        const Reach whole(fit::bind(solid.geometry(), base, options), solid, middle);
        options.wrinkle_range = {0.1, 0.9};
        const Reach within(fit::bind(solid.geometry(), base, options), solid, middle);
        CHECK(within.inside == doctest::Approx(whole.inside).epsilon(1e-4));
    }
}

TEST_CASE("wrinkle range: amplitude mesh keeps the area of what lies inside, and no more") {
    const Solid solid = fine_tube();
    fit::BindOptions options;
    options.wrinkle_range = {0.15, 0.8};
    options.amplitude = fit::Amplitude::mesh;
    const fit::Binding binding = fit::bind(solid.geometry(), upright(), options);
    const std::vector<std::uint32_t> inside =
        fit::triangles_within(solid.geometry(), upright(), options.wrinkle_range);
    const double area = fit::surface_area(solid.positions, inside);
    CHECK(area / fit::surface_area(solid.positions, solid.triangles) == doctest::Approx(0.65).epsilon(0.02));
    for (const double angle : {0.5, 1.0, right_angle, 2.5}) {
        const std::vector<glm::vec3> positions = bent_positions(binding, angle, 1);
        CHECK(std::abs(fit::surface_area(positions, inside) / area - 1) < 1e-3);
        // The bare bend's area factor is 1 - alpha r / L.
        const double beyond =
            fit::surface_area(positions, solid.triangles) - fit::surface_area(positions, inside);
        const double was = fit::surface_area(solid.positions, solid.triangles) - area;
        CHECK(beyond / was == doctest::Approx(1 - angle / 10).epsilon(0.01));
    }
}

TEST_CASE("wrinkle range: all of the body is as if nothing was said") {
    const Solid solid = fine_tube();
    fit::BindOptions options;
    options.wrinkle_range = {0, 1};
    CHECK((bent_positions(fit::bind(solid.geometry(), upright(), options), 1, 1) ==
           bent_positions(fit::bind(solid.geometry(), upright()), 1, 1)));
}

TEST_CASE("wrinkle range: no rows are added beyond it, and a coarse mesh there takes no folds away") {
    const Solid coarse = tube();
    fit::BindOptions options;
    options.wrinkle_range = {0, 0.5};
    const fit::Refinement half =
        fit::refine(coarse.geometry(), upright(), fit::stretches_of(upright(), options));
    const std::vector<glm::vec3> positions = fit::refined_positions(coarse.positions, half);
    std::size_t above = 0, below = 0, above_before = 0;
    for (const glm::vec3& p : positions) ++(p.z > 5.5f ? above : below);
    for (const glm::vec3& p : coarse.positions) above_before += p.z > 5.5f ? 1 : 0;
    CHECK(above == above_before);
    CHECK(below > 4 * above);
    const fit::Binding binding = fit::bind({positions, half.triangles}, upright(), options);
    CHECK(binding.folds() >= 8);  // where it is coarse and smooth they are longer
    CHECK(binding.folds_capacity() >= binding.folds());
}

TEST_CASE("wrinkle range: a level of detail stays smooth where its rig does") {
    const Solid fine = fine_tube(), level = tube();
    fit::BindOptions options;
    options.wrinkle_range = {0, 0.6};
    const fit::Binding rig = fit::bind(fine.geometry(), upright(), options);
    const Reach reach(fit::bind_level(level.geometry(), rig), level, options.wrinkle_range);
    CHECK(reach.outside < 1e-5);
    CHECK(reach.inside > 0.05);
}

TEST_CASE("wrinkle range: what is no stretch of the body is refused") {
    for (const fit::WrinkleRange range :
         {fit::WrinkleRange{0.8, 0.2}, fit::WrinkleRange{-0.1, 1}, fit::WrinkleRange{0, 1.1},
          fit::WrinkleRange{0.5, 0.5}, fit::WrinkleRange{std::nan(""), 1},
          fit::WrinkleRange{0, std::nan("")}}) {
        fit::BindOptions options;
        options.wrinkle_range = range;
        CHECK(range_error(options).find("wrinkle range: ") == 0);
    }
    fit::BindOptions options;
    options.wrinkle_range = {0, 0.5};
    options.amplitude = fit::Amplitude::area;
    CHECK(range_error(options).find("with a wrinkle range; use mesh") != std::string::npos);
}
