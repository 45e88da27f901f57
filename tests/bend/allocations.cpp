// SPDX-License-Identifier: MIT
#include "support/arena.hpp"
#include "support/bodies.hpp"
#include "support/locks.hpp"
#include "support/output_buffer.hpp"
#include "support/rounds.hpp"
#include "support/test_batch.hpp"

#include <goffer/bend/body_table.hpp>
#include <goffer/bend/bounds.hpp>
#include <goffer/bend/crowd.hpp>
#include <goffer/measure/allocations.hpp>

#include <doctest/doctest.h>

#include <cstdlib>
#include <mutex>
#include <new>
#include <optional>
#include <utility>
#include <vector>

/// Property P6: frames allocate nothing and take no lock. (That they open and write no file, symbols.cpp
/// shows: there is nothing in the library that could.)

namespace goffer::test {
namespace {

/// Instances with streams of every kind, and what a frame does with them.
class Frames {
public:
    Frames() {
        Random random(91);
        bodies_.reserve(3);
        jobs_.reserve(24);
        for (const std::size_t count : {150u, 5000u}) bodies_.push_back(loose_body(random, count));
        for (std::size_t i = 0; i < 24; ++i) {
            constexpr std::string_view pictures[] = {"x y z",      "xyzuvw",      "x y z u v w a b c d",
                                                     "xyzuvwabcd", "xyz.uvw.123", "p q r 123",
                                                     "zyx abcd"};
            const bend::Body& body = bodies_[i / 5 % 2];
            outputs_.emplace_back(pictures[i % std::size(pictures)], body.vertex_count());
            bend::DeformJob& job = jobs_.emplace_back();
            job.body = &body;
            job.transform = random_transform(random, 3);
            job.bounds = &boxes_[i];
            outputs_[i].attach(job);
        }
        visible_.assign(jobs_.size(), 1);
        visible_[3] = 0;
        for (std::size_t i = 0; i < jobs_.size(); ++i) {
            bend::Batch& batch = batches_.emplace_back(bend::batch_of(jobs_[i]));
            batch.visible = strided(std::span(visible_).subspan(i, 1));
        }
        const BatchStyle style{
            .storage = Storage::paged_members, .indices = true, .places = true, .masks = true};
        batches_.push_back(test_batch_.emplace(random, bodies_[0], 30, style).batch());
        const BatchStyle small{.bounds = false, .picture = "xyz.uvw."};
        constexpr std::size_t counts[] = {20, 0, 31, 5};
        bodies_.push_back(loose_chain(random, counts));
        batches_.insert(batches_.begin(), small_bodies_.emplace(random, bodies_[2], 40, small).batch());
    }

    /// On the calling thread.
    void single(int frame) {
        const bend::CrowdJob crowd = pose(frame);
        faults_ += bend::validate(crowd).none() ? 0 : 1;
        bend::bounds(jobs_, boxes_);
        bend::bounds(batches_.back(), boxes_);
        texts_ +=
            bend::describe(bend::Fault{bend::Field::poses, bend::Reason::not_finite, 1, 7, 2}).text[0] != 0
                ? 1
                : 0;
        bend::run(crowd);
        for (std::size_t piece = 0; piece < 5; ++piece) bend::run_piece(crowd, piece, 5);
        for (const bend::DeformJob& job : jobs_) {
            faults_ += bend::validate(job).none() ? 0 : 1;
            bend::run(job);
            bend::run_range(job, 7, 100);
        }
    }

    /// In the arena of the caller.
    void parallel(int frame) {
        const bend::CrowdJob crowd = pose(frame);
        bend::run_parallel(crowd);
        for (const bend::DeformJob& job : jobs_) bend::run_parallel(job, 500);
    }

    [[nodiscard]] int faults() const { return faults_; }
    [[nodiscard]] int texts() const { return texts_; }

private:
    bend::CrowdJob pose(int frame) {
        for (std::size_t i = 0; i < jobs_.size(); ++i) {
            jobs_[i].previous_pose = jobs_[i].pose;
            jobs_[i].pose = {0.05f * static_cast<float>(frame), 0.1f * static_cast<float>(i)};
        }
        constexpr bend::Stores stores[] = {bend::Stores::automatic, bend::Stores::cached,
                                           bend::Stores::non_temporal};
        return {.batches = batches_, .frame = static_cast<std::uint32_t>(frame), .stores = stores[frame % 3]};
    }

    std::vector<bend::Body> bodies_;
    std::vector<OutputBuffer> outputs_;
    std::vector<bend::Bounds> boxes_{30};
    std::vector<bend::DeformJob> jobs_;
    std::vector<std::uint8_t> visible_;
    std::optional<TestBatch> test_batch_, small_bodies_;
    std::vector<bend::Batch> batches_;  // of small bodies; of one job each; and of the test_batch
    int faults_ = 0, texts_ = 0;
};

/// A hundred in all rounds; where nothing is counted, enough to see that they run.
int frame_count() {
    return measure::allocations() ? rounds(100, 20) : 3;
}

}  // namespace

TEST_CASE("P6: the counters count") {
    if (measure::allocations()) {
        // Through pointers that the compiler cannot see through, so that no pair of calls is left out.
        void* (*volatile allocate)(std::size_t) = std::malloc;
        void* (*volatile make)(std::size_t) = ::operator new;
        const std::uint64_t before = *measure::allocations();
        std::free(allocate(24));
        ::operator delete(make(24));
        CHECK(*measure::allocations() == before + 2);
    }
    if (locks()) {
        const std::uint64_t before = *locks();
        std::mutex mutex;
        const std::lock_guard guard(mutex);
        CHECK(*locks() == before + 1);
    }
}

TEST_CASE("P6: frames allocate nothing and take no lock") {
    Frames frames;
    frames.single(0);
    const auto allocated = measure::allocations(), locked = locks();
    if (!allocated || !locked) MESSAGE("skipped: they are not counted here");
    for (int frame = 0; frame < frame_count(); ++frame) frames.single(frame);
    const auto allocated_now = measure::allocations(), locked_now = locks();
    CHECK(allocated == allocated_now);
    CHECK(locked == locked_now);
    CHECK(frames.faults() == 0);
    CHECK(frames.texts() == frame_count() + 1);
}

TEST_CASE("P6: to make a body table, and to move it, allocates nothing") {
    const auto before = measure::allocations();
    bend::BodyTable table;
    bend::BodyTable moved = std::move(table);
    table = std::move(moved);
    const auto after = measure::allocations();
    if (!before) MESSAGE("skipped: allocations are not counted here");
    CHECK(before == after);
    CHECK(table.size() == 0);
}

TEST_CASE("P6: frames on the scheduler allocate nothing once it is warm") {
    Frames frames;
    in_arena(1, [&] {
        for (int frame = 0; frame < 5; ++frame) frames.parallel(frame);
        const auto allocated = measure::allocations();
        for (int frame = 0; frame < frame_count(); ++frame) frames.parallel(frame);
        const auto allocated_now = measure::allocations();
        if (!allocated) MESSAGE("skipped: allocations are not counted here");
        CHECK(allocated == allocated_now);
    });
}

}  // namespace goffer::test
