// SPDX-License-Identifier: MIT
#pragma once

#include "support/bodies.hpp"
#include "support/chains.hpp"

#include <goffer/bend/kernel_input.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

/// Random meshes bound to random regions, with or without a rest arc and a shape.

namespace goffer::test {

inline fit::BindOptions random_regions(Random& random, std::size_t count) {
    fit::BindOptions options;
    options.profile = random_profile(random);
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        options.regions.push_back({uniform(random, 0.5, 2), static_cast<int>(random() % 5)});
        sum += options.regions.back().share;
    }
    for (fit::RegionOptions& region : options.regions) region.share /= sum;
    return options;
}

/// Coefficients of NaN: what set-up leaves shows.
inline bend::Coefficients unset() {
    bend::Coefficients k;
    std::memset(&k, 0xff, sizeof k);
    return k;
}

/// Within the regions' limits, and within what a chain of arcs can be bent by before float's error has grown
/// along it.
inline std::vector<bend::Pose> random_poses(Random& random, const bend::Body& body) {
    std::vector<bend::Pose> poses;
    for (const bend::Region& region : body.regions()) {
        const double limit = std::min(static_cast<double>(region.max_angle) * (1 - 1e-6), 3.0);
        const double angle = random() % 6 == 0 ? 0 : uniform(random, 0, limit);
        poses.push_back({static_cast<float>(random() % 4 == 0 ? -angle : angle),
                         static_cast<float>(uniform(random, -6, 6))});
    }
    return poses;
}

inline bend::DeformJob make_job(const bend::Body& body, std::span<const bend::Pose> poses, Isa isa,
                                Output& out) {
    bend::DeformJob job = test::make_job(body, bend::Pose{}, isa, out);
    job.poses = poses;
    return job;
}

/// A body with several regions or one, bent at rest or not.
struct BoundCase {
    TestMesh test_mesh;
    fit::BindOptions options;
    fit::Binding binding;
};

inline BoundCase random_case(Random& random, std::size_t regions, bool bent) {
    const double slenderness = uniform(random, 8, 30);
    TestMesh test_mesh = random_mesh(random, slenderness, std::pow(10, uniform(random, -3, 3)));
    const fit::BindOptions options = random_regions(random, regions);
    if (random() % 2 == 0 && !(bent && regions > 1)) add_radii(test_mesh, random);
    // Halfway to where the least wrinkled body would fold through itself.
    if (bent)
        test_mesh = bent_at_rest(test_mesh, uniform(random, 0.1, 0.2 * slenderness), uniform(random, -3, 3));
    fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
    return {std::move(test_mesh), options, std::move(binding)};
}

/// A body that is bent at rest along a chain of arcs.
inline BoundCase random_arcs(Random& random, std::size_t arcs, const fit::BindOptions& options) {
    const double slenderness = uniform(random, 8, 30);
    TestMesh test_mesh = random_mesh(random, slenderness, std::pow(10, uniform(random, -3, 3)));
    std::vector<fit::RestArc> rest;
    double sum = 0;
    for (std::size_t i = 0; i < arcs; ++i) {
        const double share = uniform(random, 0.5, 2);
        rest.push_back({share, random() % 4 == 0 ? 0 : share, uniform(random, -3, 3)});
        sum += share;
    }
    const bool shaped = random() % 2 == 0;
    const double all = uniform(random, 0.1, 0.2 * slenderness);
    for (fit::RestArc& arc : rest) {
        arc.length *= test_mesh.cylinder.length / sum;
        arc.angle *= all / sum;
    }
    if (shaped) add_radii(test_mesh, random);
    test_mesh = bent_along(std::move(test_mesh), rest);
    fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
    return {std::move(test_mesh), options, std::move(binding)};
}

}  // namespace goffer::test
