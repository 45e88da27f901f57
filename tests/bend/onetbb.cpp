// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"

#include <goffer/bend/crowd.hpp>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_scheduler_observer.h>

#include <cfenv>
#include <limits>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

/// A process that uses oneTBB itself finds everything of it as it was.

/// What oneTBB keeps of an observer it frees when the last thread has left the arena, which may be after the
/// process looks for leaks.
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier): its name
    return "leak:tbb::detail::r1::observe\n";
}

namespace goffer::test {
namespace {

/// Counts the threads that enter an arena.
class Visitors : public tbb::task_scheduler_observer {
public:
    explicit Visitors(tbb::task_arena& arena) : task_scheduler_observer(arena) { observe(true); }
    ~Visitors() override { observe(false); }

    void on_scheduler_entry(bool) override {
        const std::lock_guard lock(mutex_);
        threads_.insert(std::this_thread::get_id());
    }
    [[nodiscard]] std::size_t count() {
        const std::lock_guard lock(mutex_);
        return threads_.size();
    }

private:
    std::mutex mutex_;
    std::set<std::thread::id> threads_;
};

/// 200 instances of a body of 2000 vertices.
class LargeCrowd {
public:
    LargeCrowd() : random_(7), body_(loose_body(random_, 2000)), poses_(200), vertices_(3 * 200 * 2000) {
        for (bend::Pose& pose : poses_) pose = {static_cast<float>(uniform(random_, -1, 1)), 0};
        batch_ = {.body = &body_, .count = poses_.size()};
        batch_.poses = strided(std::span(poses_));
        batch_.positions = interleaved<3>(vertices_.data(), vertices_.size() / 3);
        batch_.vertex_step = 2000;
    }
    void run() const { REQUIRE(bend::run_parallel({.batches = {&batch_, 1}}).deformed == poses_.size()); }

private:
    Random random_;
    bend::Body body_;
    std::vector<bend::Pose> poses_;
    std::vector<float> vertices_;
    bend::Batch batch_;
};

/// Whether the calling thread takes subnormal results for 0, and subnormal operands: bits of its control
/// register.
std::size_t flushed() {
    using Limits = std::numeric_limits<float>;
    const volatile float least = Limits::min(), subnormal = Limits::denorm_min();
    const volatile float result = least * 0.5f, operand = subnormal * 0x1p30f;
    return (result == 0 ? 1u : 0u) + (operand == 0 ? 2u : 0u);
}

/// What the whole process shares, and what is the calling thread's own.
std::vector<std::size_t> globals() {
    using tbb::global_control;
    return {global_control::active_value(global_control::max_allowed_parallelism),
            global_control::active_value(global_control::thread_stack_size),
            global_control::active_value(global_control::terminate_on_exception),
            static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()),
            static_cast<std::size_t>(std::fegetround()),
            flushed()};
}

}  // namespace

TEST_CASE("oneTBB: a crowd changes nothing that the process shares") {
    const LargeCrowd crowd;
    const std::vector<std::size_t> before = globals();
    crowd.run();
    CHECK(globals() == before);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, before[0] + 3);
    const std::vector<std::size_t> with_limit = globals();
    CHECK(with_limit[0] == before[0] + 3);
    crowd.run();
    CHECK(globals() == with_limit);
}

TEST_CASE("oneTBB: a crowd uses the threads of the arena that it is run from, and no more") {
    const LargeCrowd crowd;
    for (const int threads : {1, 2}) {
        tbb::task_arena mine(threads), other(2);
        Visitors in_mine(mine), in_other(other);
        const auto all = static_cast<std::size_t>(threads);
        int frames = 0;  // the second thread may take a while to wake up
        do mine.execute([&] { crowd.run(); });
        while (++frames < 20 || (in_mine.count() < all && frames < 20'000));
        CHECK(mine.max_concurrency() == threads);
        CHECK(in_mine.count() == all);
        CHECK(in_other.count() == 0);
    }
}

}  // namespace goffer::test
