// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"
#include "support/output_buffer.hpp"

#include <goffer/bend/crowd.hpp>

#include <doctest/doctest.h>

#include <cstring>
#include <limits>

/// Previous positions, for motion vectors.

namespace goffer::test {
namespace {

bend::Pose any_pose(Random& random) {
    return {static_cast<float>(uniform(random, -6, 6)), static_cast<float>(uniform(random, -9, 9))};
}

}  // namespace

TEST_CASE("previous positions have the bits that positions had at that pose and transform") {
    Random random(61);
    for (const std::size_t count : {1u, 33u, 700u}) {
        const bend::Body body = loose_body(random, count);
        for (const Isa isa : isas_here()) {
            for (int trial = 0; trial < 20; ++trial) {
                bend::DeformJob then{.body = &body, .pose = any_pose(random), .isa = isa};
                then.transform = random_transform(random, 3);
                OutputBuffer positions("x y z", count);
                positions.attach(then);
                bend::run(then);

                bend::DeformJob now{.body = &body, .pose = any_pose(random), .isa = isa};
                now.transform = random_transform(random, 3);
                now.previous_pose = then.pose;
                now.previous_transform = then.transform;
                OutputBuffer both(trial % 3 == 0   ? "xyzuvw p q r"
                                  : trial % 3 == 1 ? "p q r"
                                                   : "x y z pqr 123",
                                  count);
                both.attach(now);
                REQUIRE(bend::validate(now).none());
                const bool clamped = bend::run(now).clamped;
                CHECK(clamped == (std::fabs(now.pose.angle) > body.max_angle()));
                for (std::size_t i = 0; i < count; ++i) {
                    const float old[] = {both.value('p', i), both.value('q', i), both.value('r', i)};
                    const float expected[] = {positions.value('x', i), positions.value('y', i),
                                              positions.value('z', i)};
                    REQUIRE(std::memcmp(old, expected, sizeof old) == 0);
                }
            }
        }
    }
}

TEST_CASE("a crowd that asks for previous positions alone counts its instances, by their current poses") {
    Random random(62);
    const bend::Body body = loose_body(random, 40);
    const float far = 2 * body.max_angle(), nan = std::numeric_limits<float>::quiet_NaN();
    const bend::Pose poses[] = {{0.1f, 0}, {far, 0}, {nan, 0}, {0.1f, 0}, {-far, 1}};
    const bend::Pose previous[] = {{far, 0}, {0, 0}, {0, 0}, {nan, 0}, {0, 0}};
    bend::Batch batch{.body = &body, .count = 5};
    batch.poses = strided(std::span(poses));
    batch.previous_poses = strided(std::span(previous));
    batch.vertex_step = 40;
    for (const std::string_view picture : {"p q r", "x y z p q r"}) {
        OutputBuffer out(picture, 5 * 40);
        out.attach(batch);
        CHECK(bend::run(bend::CrowdJob{.batches = {&batch, 1}}) == bend::CrowdResult{5, 2, 1});
        batch.positions = batch.previous_positions = {};
    }
}

}  // namespace goffer::test
