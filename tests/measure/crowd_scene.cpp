// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"

#include <goffer/measure/crowd_scene.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace goffer::test {
namespace {

using measure::StreamLayout;

/// Instances of a body of one region and of one of three, with vertices `between` them.
struct Case {
    Random random{17};
    bend::Body one = loose_body(random, 70);
    bend::Body three = loose_chain(random, std::vector<std::size_t>{20, 31, 40});
    std::vector<measure::CrowdGroup> groups;
    Columns memory;
    measure::CrowdScene scene;

    explicit Case(const StreamLayout& layout, std::size_t between = 3)
        : groups{{&one, 5, 70 + between}, {&three, 4, 91 + between}},
          memory(1, layout.memory_floats(measure::vertex_count(groups))),
          scene(groups, layout, memory[0]) {
        pose(0);
    }

    void pose(float frame) {
        scene.set_poses([&](std::size_t instance, std::span<bend::Pose> poses) {
            for (std::size_t r = 0; r < poses.size(); ++r)
                poses[r] = {0.1f * static_cast<float>(instance + 1) + frame, static_cast<float>(r)};
        });
    }

    [[nodiscard]] std::vector<float> values() const { return {memory[0].begin(), memory[0].end()}; }
    void clear() { std::ranges::fill(memory[0], -7.0f); }
};

/// Where the planes of `batch` begin.
std::vector<std::uintptr_t> planes_of(const bend::Batch& batch) {
    std::vector<std::uintptr_t> planes;
    const auto add = [&](const auto& stream) {
        for (const float* component : stream.component)
            if (component != nullptr) planes.push_back(reinterpret_cast<std::uintptr_t>(component));
    };
    add(batch.positions);
    add(batch.normals);
    add(batch.tangents);
    add(batch.previous_positions);
    return planes;
}

bool same(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

}  // namespace

TEST_CASE("a crowd in every layout validates, and its instances alone write the same places") {
    for (const StreamLayout& layout : measure::stream_layouts()) {
        CAPTURE(std::string(layout.name));
        Case test(layout);
        test.pose(0.5f);
        REQUIRE(bend::describe(bend::validate(test.scene.job())).c_str() == std::string("no fault"));
        test.clear();
        CHECK(bend::run(test.scene.job()).deformed == 9);
        const std::vector<float> together = test.values();
        test.clear();
        for (std::size_t i = 0; i < 9; ++i) {
            const bend::DeformJob job = test.scene.instance(i);
            REQUIRE(bend::validate(job).none());
            bend::run(job);
        }
        if (!layout.scratch) CHECK(same(together, test.values()));
        const auto written = std::ranges::count_if(together, [](float value) { return value != -7; });
        const std::size_t values = layout.floats * (5 * 70 + 4 * 91);
        if (layout.scratch) {
            CHECK(static_cast<std::size_t>(written) >= values);
        } else {
            CHECK(static_cast<std::size_t>(written) == values);
        }
    }
}

TEST_CASE("planes begin on cache lines, a page's multiple apart where the layout says so and nowhere else") {
    for (const StreamLayout& layout : measure::stream_layouts()) {
        if (layout.record != 0) continue;
        CAPTURE(std::string(layout.name));
        for (const std::size_t between : {0u, 1u, 100u, 933u}) {
            Case test(layout, between);
            const std::vector<std::uintptr_t> planes = planes_of(test.scene.batches()[0]);
            REQUIRE(planes.size() == layout.floats);
            for (std::size_t i = 0; i < planes.size(); ++i) {
                CHECK(planes[i] % column_alignment == 0);
                for (std::size_t j = 0; j < i; ++j)
                    CHECK(((planes[i] - planes[j]) % 4096 == 0) == layout.paged);
            }
        }
    }
}

TEST_CASE("previous poses are those of the frame before") {
    Case test(measure::stream_layout("previous"));
    test.pose(1);
    test.pose(2);
    for (const std::size_t i : {0u, 4u, 5u, 8u}) {
        const bend::DeformJob job = test.scene.instance(i);
        REQUIRE(job.previous_poses.size() == job.body->region_count());
        for (std::size_t r = 0; r < job.poses.size(); ++r)
            CHECK(job.poses[r].angle == doctest::Approx(job.previous_poses[r].angle + 1));
    }
}

TEST_CASE("an instance alone has the columns that its batch was given") {
    Case test(measure::stream_layout("positions"));
    const std::vector<float> weights{0.1f, 0.2f, 0.3f, 0.4f};
    Random random(3);
    std::vector<glm::mat4x3> transforms;
    for (int i = 0; i < 4; ++i) transforms.push_back(random_transform(random, 1));
    test.scene.batches()[1].wrinkle_weights = strided(std::span(weights));
    test.scene.batches()[1].transforms = strided(std::span(std::as_const(transforms)));
    CHECK(test.scene.instance(4).wrinkle_weight == 1);
    CHECK(test.scene.instance(4).transform == glm::mat4x3(1));
    CHECK(test.scene.instance(7).wrinkle_weight == weights[2]);
    CHECK(test.scene.instance(7).transform == transforms[2]);
}

TEST_CASE("a hash depends on every value that is written, and on nothing beside") {
    for (const char* name : {"positions+normals", "interleaved-positions", "packed"}) {
        CAPTURE(name);
        Case test(measure::stream_layout(name), 0);
        test.clear();
        bend::run(test.scene.job());
        CHECK(test.scene.bytes() == 4 * measure::stream_layout(name).floats * test.scene.vertices());
        const std::uint64_t hash = test.scene.hash();
        std::size_t seen = 0;
        for (float& value : test.memory[0]) {
            const float was = value;
            const bool output = was != -7;
            value = 0.625f;
            const bool changed = test.scene.hash() != hash;
            value = was;
            if (changed != output) FAIL_CHECK("a float is ", output ? "missing" : "too many");
            seen += changed ? 1 : 0;
        }
        CHECK(4 * seen == test.scene.bytes());
    }
}

}  // namespace goffer::test
