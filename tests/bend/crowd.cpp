// SPDX-License-Identifier: MIT
#include "pieces.hpp"
#include "support/arena.hpp"
#include "support/bodies.hpp"
#include "support/output_buffer.hpp"

#include <goffer/bend/bounds.hpp>
#include <goffer/bend/crowd.hpp>

#include <doctest/doctest.h>

#include <array>
#include <vector>

/// The crowd's contract: the bits of single jobs, whatever the arena, the split, the stores and the
/// neighbors. Here of batches of one, each of another shape; batch.cpp has columns.

namespace goffer::test {
namespace {

/// Instances of bodies of very different sizes, in runs and alone, each with streams of its own kind.
class MixedCrowd {
public:
    MixedCrowd(Random& random, std::size_t instances) : boxes_(instances) {
        constexpr std::string_view pictures[] = {"x y z",
                                                 "x y z u v w",
                                                 "xyzuvw",
                                                 "123",
                                                 "xyz u v w a b c d",
                                                 "xyz.uvw.abcd.123.pqr",
                                                 "p q r xyzuvwabcd",
                                                 "wvuzyx"};
        for (const std::size_t count : {210u, 990u, 1u, 20000u})
            bodies_.push_back(count == 990 ? loose_shaped_body(random, count) : loose_body(random, count));
        for (std::size_t i = 0; i < instances; ++i) {
            const bend::Body& body = bodies_[i % 40 == 7 ? 3 : i % 11 == 9 ? 2 : i % 5 == 0 ? 1 : 0];
            outputs_.emplace_back(pictures[random() % std::size(pictures)], body.vertex_count(),
                                  random() % 16, random() % 3);
            bend::DeformJob job;
            job.body = &body;
            job.pose = random_pose(random);
            job.previous_pose = random_pose(random);
            job.transform = random_transform(random, 5);
            outputs_[i].attach(job);
            if (i % 3 == 0) job.bounds = &boxes_[i];
            jobs.push_back(job);
        }
        make_batches();
    }

    /// Makes batches of `jobs` as they are now.
    void make_batches() {
        batches.clear();
        for (const bend::DeformJob& job : jobs) batches.push_back(bend::batch_of(job));
    }

    void clear() {
        for (OutputBuffer& output : outputs_) output.clear();
        boxes_.assign(boxes_.size(), {});
    }

    /// Over every output of every instance.
    [[nodiscard]] std::uint64_t hash() const {
        std::uint64_t sum = 1;
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            sum = outputs_[i].hash(sum);
            for (const float value : {boxes_[i].low.x, boxes_[i].low.y, boxes_[i].low.z, boxes_[i].high.x,
                                      boxes_[i].high.y, boxes_[i].high.z}) {
                sum = (sum ^ std::bit_cast<std::uint32_t>(value)) * 1099511628211u;
            }
        }
        return sum;
    }

    /// What a run of the active ones, one by one, leaves and counts.
    struct Expected {
        std::uint64_t hash = 0;
        bend::CrowdResult result;
    };
    [[nodiscard]] Expected expected(Isa isa, std::span<const std::uint8_t> active = {}) {
        Expected expected;
        clear();
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            jobs[i].isa = isa;
            if (!active.empty() && active[i] == 0) continue;
            ++expected.result.deformed;
            const bend::DeformResult result = bend::run(jobs[i]);
            expected.result.clamped += result.clamped ? 1 : 0;
            expected.result.at_rest += result.at_rest ? 1 : 0;
        }
        expected.hash = hash();
        return expected;
    }

    std::vector<bend::DeformJob> jobs;
    std::vector<bend::Batch> batches;  // of one each

private:
    /// Every third beyond the body's limit.
    static bend::Pose random_pose(Random& random) {
        return {static_cast<float>(uniform(random, -4, random() % 3 == 0 ? 60 : 4)),
                static_cast<float>(uniform(random, -9, 9))};
    }

    std::vector<bend::Body> bodies_;
    std::vector<OutputBuffer> outputs_;
    std::vector<bend::Bounds> boxes_;
};

/// Runs `run`, which returns a CrowdResult, on a cleared crowd.
template <class Run>
void check_crowd(MixedCrowd& crowd, const MixedCrowd::Expected& expected, Run run) {
    crowd.clear();
    const bend::CrowdResult result = run();
    CHECK(result.deformed == expected.result.deformed);
    CHECK(result.clamped == expected.result.clamped);
    CHECK(result.at_rest == expected.result.at_rest);
    CHECK(crowd.hash() == expected.hash);
}

constexpr std::array all_stores = {bend::Stores::automatic, bend::Stores::cached, bend::Stores::non_temporal};

}  // namespace

TEST_CASE("P5: a crowd gives the bits of its single jobs, in any arena, by any stores") {
    Random random(31);
    MixedCrowd crowd(random, 150);
    for (const Isa isa : isas_here()) {
        CAPTURE(name(isa));
        const MixedCrowd::Expected expected = crowd.expected(isa);
        CHECK(expected.result.deformed == 150);
        CHECK(expected.result.clamped > 10);
        for (const bend::Stores stores : all_stores) {
            const bend::CrowdJob job{.batches = crowd.batches, .stores = stores, .isa = isa};
            REQUIRE(bend::validate(job).none());
            check_crowd(crowd, expected, [&] { return bend::run(job); });
            for (const int threads : {1, 2, 4, 7}) {
                check_crowd(crowd, expected, [&] {
                    bend::CrowdResult result;
                    in_arena(threads, [&] { result = bend::run_parallel(job); });
                    return result;
                });
            }
        }
    }
}

TEST_CASE("P5: pieces on the caller's threads give the same bits, in any number") {
    Random random(32);
    MixedCrowd crowd(random, 120);
    for (const Isa isa : isas_here()) {
        CAPTURE(name(isa));
        const MixedCrowd::Expected expected = crowd.expected(isa);
        const bend::CrowdJob job{.batches = crowd.batches, .stores = bend::Stores::non_temporal, .isa = isa};
        for (const std::size_t pieces : {1u, 2u, 3u, 7u, 64u, 1000u}) {
            CAPTURE(pieces);
            check_crowd(crowd, expected, [&] { return run_pieces(job, 0, 1, pieces); });
        }
        for (const std::size_t threads : {1u, 2u, 4u, 7u}) {
            CAPTURE(threads);
            check_crowd(crowd, expected, [&] { return run_on_threads(job, threads, 3 * threads + 1); });
        }
    }
}

TEST_CASE("pieces may be more than there are vertices") {
    Random random(34);
    MixedCrowd crowd(random, 20);
    const bend::CrowdJob job{.batches = crowd.batches};
    for (const std::size_t pieces : {std::size_t{1} << 44, ~std::size_t{0}}) {
        std::size_t deformed = 0;
        for (const std::size_t piece : {std::size_t{0}, pieces / 3, pieces / 2, pieces - 1})
            deformed += bend::run_piece(job, piece, pieces).deformed;
        CHECK(deformed <= 1);
    }
}

TEST_CASE("pieces share the work out by vertices") {
    Random random(33);
    MixedCrowd crowd(random, 120);
    std::size_t all = 0;
    for (const bend::DeformJob& job : crowd.jobs) all += job.body->vertex_count();
    crowd.clear();
    const std::uint64_t before = crowd.hash();
    // Neither of two pieces is empty, though the first instances are most of the crowd's work.
    std::ranges::stable_sort(crowd.jobs, std::ranges::greater{},
                             [](const bend::DeformJob& job) { return job.body->vertex_count(); });
    crowd.make_batches();
    const bend::CrowdJob job{.batches = crowd.batches};
    const std::size_t first = bend::run_piece(job, 0, 2).deformed;
    CHECK(crowd.hash() != before);
    std::size_t vertices = 0, instances = 0;
    for (; vertices < all / 2; ++instances) vertices += crowd.jobs[instances].body->vertex_count();
    CHECK(first == instances);
}

TEST_CASE("instances that are not seen, or not changed, are not touched") {
    Random random(34);
    MixedCrowd crowd(random, 90);
    std::vector<std::uint8_t> visible(90), changed(90), both(90);
    for (std::size_t i = 0; i < both.size(); ++i) {
        visible[i] = i % 3 == 1 ? 0 : static_cast<std::uint8_t>(1 + random() % 255);
        changed[i] = i < 11 || i % 7 == 4 ? 0 : 1;
        both[i] = visible[i] != 0 && changed[i] != 0 ? 1 : 0;
    }
    const std::vector<std::uint8_t> none(90, 0);
    const auto check_masks = [&](std::span<const std::uint8_t> active, std::span<const std::uint8_t> seen,
                                 std::span<const std::uint8_t> moved) {
        crowd.make_batches();
        for (std::size_t i = 0; i < crowd.batches.size(); ++i) {
            if (!seen.empty()) crowd.batches[i].visible = strided(seen.subspan(i, 1));
            if (!moved.empty()) crowd.batches[i].changed = strided(moved.subspan(i, 1));
        }
        const bend::CrowdJob job{.batches = crowd.batches};
        REQUIRE(bend::validate(job).none());
        const MixedCrowd::Expected expected = crowd.expected(Isa::automatic, active);
        check_crowd(crowd, expected, [&] { return bend::run(job); });
        check_crowd(crowd, expected, [&] { return bend::run_parallel(job); });
        check_crowd(crowd, expected, [&] { return run_pieces(job, 0, 1, 13); });
    };
    check_masks(visible, visible, {});
    check_masks(changed, {}, changed);
    check_masks(both, visible, changed);
    check_masks(none, none, {});
}

TEST_CASE("a batch of one reads from its job, which may change from frame to frame") {
    Random random(35);
    MixedCrowd crowd(random, 20);
    for (bend::DeformJob& job : crowd.jobs) {
        job.pose = {static_cast<float>(uniform(random, -4, 4)), 1.0f};
        job.previous_pose = {0.5f, static_cast<float>(uniform(random, -4, 4))};
        job.wrinkle_weight = 0.25f;
        job.transform[3] += glm::vec3(1, 2, 3);
        job.previous_transform[3] -= glm::vec3(1, 2, 3);
    }
    const MixedCrowd::Expected expected = crowd.expected(Isa::automatic);
    check_crowd(crowd, expected, [&] { return bend::run(bend::CrowdJob{.batches = crowd.batches}); });
    for (const bend::Batch& batch : crowd.batches) {
        CHECK(batch.count == 1);
        CHECK(batch.poses.count == 1);
        CHECK(batch.previous_poses.count == 1);
    }
}

TEST_CASE("a batch of no instances is no fault and no work, and needs no buffer") {
    Random random(3);
    const bend::Body body = loose_body(random, 50);
    const bend::Batch none{.body = &body, .count = 0};
    const bend::CrowdJob job{.batches = {&none, 1}};
    CHECK(bend::validate(job).none());
    CHECK(bend::run(job) == bend::CrowdResult{});
    CHECK(bend::run_parallel(job) == bend::CrowdResult{});
    CHECK(bend::run_piece(job, 1, 3) == bend::CrowdResult{});
}

TEST_CASE("an empty crowd is no fault and no work") {
    const bend::CrowdJob nobody;
    CHECK(bend::validate(nobody).none());
    CHECK(bend::run(nobody).deformed == 0);
    CHECK(bend::run_parallel(nobody).deformed == 0);
    CHECK(bend::run_piece(nobody, 2, 3).deformed == 0);
}

}  // namespace goffer::test
