// SPDX-License-Identifier: MIT
#include "not_finite.hpp"
#include "support/rounds.hpp"
#include "support/test_batch.hpp"

#include <goffer/bend/capsules.hpp>
#include <goffer/bend/sockets.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

/// P11 of poses: they may hold any bits, in whatever function takes them. A pose with a number that is not
/// finite has its instance taken as at rest; all others give finite results.

namespace goffer::test {
namespace {

/// Any of 2^32; often one of the kinds that arithmetic treats specially.
float any_float(Random& random) {
    const auto bits = static_cast<std::uint32_t>(random());
    constexpr float special[] = {0.0f,  -0.0f,    nan,      -nan,  infinity,    -infinity, 1e-45f,
                                 1e38f, -3.4e38f, 1.2e-38f, 1e30f, 16777217.0f, 3.1415927f};
    switch (random() % 8) {
        case 0:
            return special[random() % std::size(special)];
        case 1:
            return std::bit_cast<float>(bits | 0x7f800000u);  // infinities and NaNs
        case 2:
            return std::bit_cast<float>(bits & 0x807fffffu);  // denormal numbers
        case 3:
        case 4:
            return static_cast<float>(uniform(random, -6, 6));
        default:
            return std::bit_cast<float>(bits);
    }
}

bool finite_poses(std::span<const bend::Pose> poses) {
    return std::ranges::all_of(poses, [](const bend::Pose& pose) {
        return std::isfinite(pose.angle) && std::isfinite(pose.direction);
    });
}

/// A body of 1 to 32 regions, some of them without vertices, with at least one vertex in all.
bend::Body any_body(Random& random) {
    std::vector<std::size_t> counts(1 + random() % bend::max_regions);
    if (random() % 3 == 0) counts.resize(1);
    for (std::size_t& count : counts) count = random() % 6 == 0 ? 0 : 1 + random() % 20;
    counts[random() % counts.size()] = 1 + random() % 40;
    return loose_chain(random, counts);
}

/// Poses for `regions`: all of any bits, or one of them, or none.
std::vector<bend::Pose> any_poses(Random& random, std::size_t regions) {
    std::vector<bend::Pose> poses(regions);
    const std::size_t kind = random() % 3, one = random() % regions;
    for (std::size_t r = 0; r < regions; ++r) {
        poses[r] = {static_cast<float>(uniform(random, -5, 5)), static_cast<float>(uniform(random, -9, 9))};
        if (kind == 0 || (kind == 1 && r == one)) poses[r] = {any_float(random), any_float(random)};
    }
    return poses;
}

/// What every function makes of poses.
struct Results {
    OutputBuffer out;
    bend::DeformResult result;
    bend::Bounds box;
    std::vector<bend::Capsule> capsules;
    std::vector<bend::SocketFrame> frames;

    Results(bend::DeformJob job, const bend::Sockets& sockets)
        : out(OutputBuffer::all_planes, job.body->vertex_count()),
          capsules(bend::capsule_count(*job.body, 2)),
          frames(2 * sockets.count()) {
        out.attach(job);
        job.bounds = &box;
        result = bend::run(job);
        bend::capsules(job, 2, capsules);
        sockets.frames(job.poses, frames, job.transform);
        sockets.frames(job, std::span(frames).subspan(sockets.count()));
    }

    /// Empty if they are those of `other` bit by bit; or what is not.
    [[nodiscard]] std::string fault(const Results& other) const {
        if (std::string text = out.fault(other.out); !text.empty()) return text;
        if (std::memcmp(&box, &other.box, sizeof box) != 0) return "bounds";
        if (std::memcmp(capsules.data(), other.capsules.data(), capsules.size() * sizeof capsules[0]) != 0)
            return "capsules";
        if (std::memcmp(frames.data(), other.frames.data(), frames.size() * sizeof frames[0]) != 0)
            return "frames";
        return {};
    }

    /// Empty if all numbers are finite and vectors as long as they should be; or what is not so.
    [[nodiscard]] std::string oddity() const {
        for (std::size_t i = 0; i < out.count(); ++i) {
            for (const char c : std::string_view("xyzuvwabcdpqr"))
                if (!std::isfinite(out.value(c, i)))
                    return std::string(1, c) + " of vertex " + std::to_string(i);
            const glm::vec3 normal(out.value('u', i), out.value('v', i), out.value('w', i));
            if (std::fabs(glm::length(normal) - 1) > 1e-5f) return "normal of vertex " + std::to_string(i);
        }
        if (!finite(box.low) || !finite(box.high)) return "bounds";
        for (int axis = 0; axis < 3; ++axis)
            if (box.low[axis] > box.high[axis]) return "order of bounds";
        for (const bend::Capsule& capsule : capsules)
            if (!finite(capsule.from) || !finite(capsule.to) || !(capsule.radius >= 0)) return "capsules";
        for (const bend::SocketFrame& frame : frames)
            if (!finite(frame[3]) || !(glm::determinant(glm::mat3(frame)) > 0.99f)) return "frames";
        return {};
    }
};

bend::Sockets some_sockets(Random& random, const bend::Body& body) {
    std::vector<bend::Socket> sockets(1 + random() % 9);
    for (bend::Socket& socket : sockets) {
        socket.region = random() % body.region_count();
        socket.vertex = {uniform(random, -3, 3), uniform(random, 0, 1), 0.1, 0, 0};
    }
    return std::move(bend::Sockets::make(body, sockets).value());
}

}  // namespace

TEST_CASE("P11: poses of any bits, through every function that takes them") {
    Random random(121);
    std::size_t bent = 0, at_rest = 0;
    for (int round = 0; round < rounds(600, 60); ++round) {
        const bend::Body body = any_body(random);
        const bend::Sockets sockets = some_sockets(random, body);
        for (int trial = 0; trial < 10; ++trial) {
            const Isa isa = isas_here()[random() % isas_here().size()];
            const std::vector<bend::Pose> poses = any_poses(random, body.region_count());
            const std::vector<bend::Pose> previous = any_poses(random, body.region_count());
            const std::vector<bend::Pose> rest = body.rest_poses();
            bend::DeformJob job{.body = &body, .poses = poses, .isa = isa};
            job.previous_poses = previous;
            job.transform = random_transform(random, 2);
            job.wrinkle_weight = any_float(random);
            const Results results(job, sockets);
            INFO("round ", round, ", trial ", trial, ", ", body.region_count(), " regions, ", name(isa));
            REQUIRE(results.oddity() == "");
            // The same, said plainly.
            const bool current_rests = !finite_poses(poses);
            if (current_rests) job.poses = rest;
            if (!finite_poses(previous)) job.previous_poses = rest;
            job.wrinkle_weight = job.wrinkle_weight > 0 ? std::min(job.wrinkle_weight, 1.0f) : 0;
            REQUIRE(results.fault(Results(job, sockets)) == "");
            if (current_rests) {
                CHECK(results.result.at_rest);
                CHECK_FALSE(results.result.clamped);
                ++at_rest;
            } else if (finite_poses(previous)) {
                CHECK_FALSE(results.result.at_rest);
                ++bent;
            }
        }
    }
    CHECK(bent > rounds(1000u, 100u));
    CHECK(at_rest > rounds(1000u, 100u));
}

TEST_CASE("P11: crowds of poses and weights of any bits give the bits of single jobs") {
    Random random(122);
    constexpr std::size_t chain[] = {9, 0, 20, 1};
    const bend::Body bodies[] = {loose_body(random, 70), loose_chain(random, chain)};
    std::size_t at_rest = 0;
    const std::size_t trials = rounds(60u, 8u);
    for (std::size_t trial = 0; trial < trials; ++trial) {
        const Isa isa = isas_here()[random() % isas_here().size()];
        TestBatches tested;
        for (const bend::Body& body : bodies) {
            BatchStyle style{.storage = all_storages[random() % 4], .hostile = true};
            style.indices = random() % 2 == 0;
            style.picture = random() % 2 == 0 ? OutputBuffer::all_planes : "xyzuvw.pqr";
            tested.add(random, body, 30, style);
        }
        const bend::CrowdResult expected = tested.expect(isa);
        at_rest += expected.at_rest;
        tested.clear();
        const bend::CrowdResult result = bend::run(bend::CrowdJob{.batches = tested.batches, .isa = isa});
        REQUIRE(tested.fault() == "");
        CHECK(result.clamped == expected.clamped);
        CHECK(result.at_rest == expected.at_rest);
    }
    CHECK(at_rest > 12 * trials);
}

TEST_CASE("P11: a crowd that validated is safe with other transforms, whatever they hold") {
    Random random(123);
    const bend::Body body = loose_body(random, 40);
    std::vector<bend::Pose> poses(6, {1, 2});
    std::vector<glm::mat4x3> transforms(6, glm::mat4x3(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0));
    for (const std::string_view picture :
         {OutputBuffer::all_planes, std::string_view("xyz.uvw.123."), std::string_view("xyzuvw")}) {
        OutputBuffer out(picture, 6 * 40);
        bend::Batch batch{.body = &body, .count = 6};
        batch.poses = batch.previous_poses = strided(std::span(poses));
        batch.transforms = batch.previous_transforms = strided(std::span(transforms));
        batch.vertex_step = 40;
        out.attach(batch);
        for (int round = 0; round < 200; ++round) {
            for (glm::mat4x3& matrix : transforms)
                for (int c = 0; c < 4; ++c)
                    for (int r = 0; r < 3; ++r) matrix[c][r] = any_float(random);
            const bend::Stores stores = round % 2 == 0 ? bend::Stores::cached : bend::Stores::non_temporal;
            CHECK(bend::run(bend::CrowdJob{.batches = {&batch, 1}, .stores = stores}).deformed == 6);
            // Whatever was written, it was written where it belongs.
            const OutputBuffer::Part all{&out, 0, 6 * 40, 0};
            REQUIRE(out.fault({&all, 1}) == "");
        }
    }
}

TEST_CASE("poses that are missing are those of rest, to bounds") {
    Random random(124);
    const std::size_t counts[] = {10, 20, 30, 5};
    const bend::Body body = loose_chain(random, counts);
    const glm::mat4x3 transform = random_transform(random, 2);
    const std::vector<bend::Pose> rest = body.rest_poses();
    const auto same = [](const bend::Bounds& a, const bend::Bounds& b) {
        return std::memcmp(&a, &b, sizeof a) == 0;
    };
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<bend::Pose> poses(4);
        for (bend::Pose& pose : poses)
            pose = {static_cast<float>(uniform(random, -5, 5)), static_cast<float>(uniform(random, -9, 9))};
        for (std::size_t given = 0; given <= 4; ++given) {
            std::vector<bend::Pose> full = rest;
            std::copy_n(poses.begin(), given, full.begin());
            const bend::Bounds expected = bend::bounds(body, full, transform);
            CHECK(same(bend::bounds(body, std::span(poses).first(given), transform), expected));
            if (given == 1) CHECK(same(bend::bounds(body, poses[0], transform), expected));
        }
    }
    const bend::Pose bad{nan, 1};
    CHECK(same(bend::bounds(body, bad), bend::bounds(body, rest)));
    CHECK(same(bend::bounds(body, std::span<const bend::Pose>()), bend::bounds(body, rest)));
}

TEST_CASE("P11: tables answer any angle and direction from what they hold") {
    Random random(125);
    bend::WrinkleTable wrinkles;
    wrinkles.max_angle = 2;
    wrinkles.rows.resize(5);
    bend::FactorTable factors;
    factors.max_angle = 2;
    factors.rows.resize(5);
    for (std::size_t i = 0; i < 5; ++i) {
        for (float& value : wrinkles.rows[i]) value = static_cast<float>(uniform(random, -1, 1));
        for (float& value : factors.rows[i]) value = static_cast<float>(uniform(random, 0.25, 4));
    }
    for (int round = 0; round < 20000; ++round) {
        const float angle = any_float(random), direction = any_float(random);
        CAPTURE(angle);
        CAPTURE(direction);
        for (const float value : wrinkles.at(angle)) REQUIRE(std::fabs(value) <= 1);
        const float factor = factors.at(angle, direction);
        REQUIRE((factor >= 0.4999f && factor <= 2.0001f));
        for (const float value : bend::WrinkleTable{}.at(angle)) REQUIRE(value == 0);
        REQUIRE(bend::FactorTable{}.at(angle, direction) == 1);
    }
}

}  // namespace goffer::test
