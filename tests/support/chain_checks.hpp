// SPDX-License-Identifier: MIT
#pragma once

#include "support/accuracy.hpp"
#include "support/bound_case.hpp"

#include <doctest/doctest.h>

/// Checks of bound bodies against the double reference, by every instruction set.

namespace goffer::test {

/// How far results are from the reference in random poses.
inline Worst worst_of(Random& random, const BoundCase& one, double position, double direction) {
    Worst worst;
    const std::size_t count = one.test_mesh.positions.size();
    Output out(count);
    for (int k = 0; k < 4; ++k) {
        const std::vector<bend::Pose> poses = random_poses(random, one.binding.body);
        const Expected expected(ChainReference(one.test_mesh, one.options, one.binding, poses), count);
        for (const Isa isa : isas_here()) {
            CAPTURE(name(isa));
            const bend::DeformJob job = make_job(one.binding.body, poses, isa, out);
            REQUIRE(bend::validate(job).none());
            CHECK_FALSE(bend::run(job).clamped);
            const Worst here(expected, out, one.test_mesh.cylinder.length);
            CHECK(here.position <= position);
            CHECK(here.normal <= direction);
            CHECK(here.tangent <= direction);
            CHECK(here.unit <= 1e-6);
            worst.add(here);
        }
    }
    return worst;
}

inline void check_rest(const BoundCase& one) {
    const std::size_t count = one.test_mesh.positions.size();
    Output out(count);
    const std::vector<bend::Pose> poses = one.binding.body.rest_poses();
    for (const Isa isa : isas_here()) {
        CAPTURE(name(isa));
        bend::run(make_job(one.binding.body, poses, isa, out));
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t vertex = one.binding.order.empty() ? i : one.binding.order[i];
            const glm::dvec3 rest(one.test_mesh.positions[vertex]);
            REQUIRE(glm::length(out.position(i) - rest) <= 1e-6 * one.test_mesh.cylinder.length);
            REQUIRE(angle_between(out.normal(i), glm::dvec3(one.test_mesh.normals[vertex])) < 4e-4);
            REQUIRE(angle_between(out.tangent(i), glm::dvec3(one.test_mesh.tangents[vertex])) < 4e-4);
        }
    }
}

/// Bends a body of one region, and a chain of the same mesh along the same arc: they must be the same.
/// `direction`: what normals may be off by, degrees.
inline void check_is_one_region(const fit::Binding& whole, const fit::Binding& chain, double direction) {
    const std::size_t count = whole.body.vertex_count();
    Output a(count), b(count);
    for (const Isa isa : isas_here()) {
        for (const float angle : {0.01f, 1.0f, 3.0f}) {
            std::vector<bend::Pose> poses;
            for (const fit::RegionBinding& region : chain.regions)
                poses.push_back({static_cast<float>(region.length / chain.cylinder.length) * angle, 0.7f});
            bend::run(make_job(whole.body, bend::Pose{angle, 0.7f}, isa, a));
            bend::run(make_job(chain.body, poses, isa, b));
            for (std::size_t i = 0; i < count; ++i) {
                const std::size_t vertex = chain.order[i];
                REQUIRE(glm::length(b.position(i) - a.position(vertex)) <= 2e-6);
                REQUIRE(angle_between(b.normal(i), a.normal(vertex)) <= direction);
            }
        }
    }
}

}  // namespace goffer::test
