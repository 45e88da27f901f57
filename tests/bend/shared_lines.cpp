// SPDX-License-Identifier: MIT
#include "every_way.hpp"
#include "job/batch_runner.hpp"
#include "kernel/kernels.hpp"
#include "support/rounds.hpp"

#include <doctest/doctest.h>

#include <iterator>
#include <string_view>
#include <vector>

/// P5 of bodies with few vertices and one region, of which one instance ends in the cache line that the next
/// one begins in.

namespace goffer::test {
namespace {

bend::Body small_body(Random& random) {
    const std::size_t count = 1 + random() % (random() % 4 == 0 ? 40 : 530);
    return random() % 3 == 0 ? loose_shaped_body(random, count) : loose_chain(random, {&count, 1});
}

BatchStyle random_style(Random& random) {
    constexpr std::string_view pictures[] = {"x y z", "x y z u v w", "x y z p q r", "x y z u v w p q r",
                                             "p q r", "u v w xyz",   "x y z 123",   "x y z u v w a b c d"};
    BatchStyle style;
    style.dense = random() % 4 != 0;
    style.masks = random() % 4 == 0;
    style.places = random() % 6 == 0;
    style.defaults = random() % 4 == 0;
    style.scratch_gaps = random() % 3 == 0;
    style.bounds = random() % 4 == 0;
    style.picture = pictures[random() % std::size(pictures)];
    return style;
}

/// The kernels here, of which those for shared lines also count their calls.
class CountingKernels {
public:
    explicit CountingKernels(Isa isa) : set(bend::kernels(isa)) {
        calls = 0;
        real_ = set.shared_line_kernel(bend::Squeeze::plain, bend::StreamSet::positions);
        if (real_ == nullptr) return;
        set.shared_lines[static_cast<std::size_t>(bend::Squeeze::plain)][0] =
            [](const bend::RestColumns& rest, const bend::Coefficients& ending,
               const bend::Coefficients& beginning, const bend::PlaneOutput& out, std::size_t out_first,
               std::size_t first, std::size_t count) {
                ++calls;
                real_(rest, ending, beginning, out, out_first, first, count);
            };
    }

    bend::KernelSet set;
    static inline int calls = 0;

private:
    static inline bend::SharedLineKernel real_ = nullptr;
};

}  // namespace

TEST_CASE("P5: small bodies that share cache lines have the bits of single jobs") {
    Random random(181);
    for (const Isa isa : isas_here()) {
        CAPTURE(name(isa));
        for (int trial = 0, trials = rounds(200, 60); trial < trials; ++trial) {
            CAPTURE(trial);
            const bend::Body body = small_body(random);
            TestBatches tested;
            BatchStyle style = random_style(random);
            style.hostile = random() % 6 == 0;
            CAPTURE(style.picture);
            tested.add(random, body, 1 + random() % 40, style);
            bend::CrowdJob crowd{.batches = tested.batches, .frame = static_cast<std::uint32_t>(trial)};
            crowd.stores = bend::Stores::non_temporal;
            crowd.isa = isa;
            check_every_way(tested, crowd, 1 + random() % 9);
        }
    }
}

TEST_CASE("previous positions may begin their cache lines elsewhere than positions do") {
    constexpr std::size_t vertices = 200, instances = 20;
    Random random(182);
    const bend::Body body = loose_body(random, vertices);
    const std::vector<bend::Pose> poses(instances, {1, 2}), previous(instances, {0.5f, 1});
    OutputBuffer one("x y z u v w p q r", vertices), now("x y z", vertices * instances, 3),
        before("p q r", vertices * instances, 5);
    for (const Isa isa : isas_here()) {
        CAPTURE(name(isa));
        bend::Batch batch{.body = &body, .count = instances};
        batch.poses = strided(std::span(poses));
        batch.previous_poses = strided(std::span(previous));
        before.attach(batch);
        const Stream3 previous_positions = batch.previous_positions;
        now.attach(batch);
        batch.previous_positions = previous_positions;
        batch.vertex_step = vertices;
        now.clear();
        before.clear();
        bend::run(bend::CrowdJob{.batches = {&batch, 1}, .stores = bend::Stores::non_temporal, .isa = isa});
        bend::DeformJob job{.body = &body, .pose = poses[0], .previous_pose = previous[0]};
        job.isa = isa;
        one.attach(job);
        bend::run(job);
        std::vector<OutputBuffer::Part> parts;
        for (std::size_t i = 0; i < instances; ++i) parts.push_back({&one, 0, vertices, i * vertices, true});
        CHECK(now.fault(parts) == "");
        CHECK(before.fault(parts) == "");
    }
}

TEST_CASE("a cache line that two instances share is written by one call, if both wrinkle or neither does") {
    constexpr std::size_t vertices = 200, instances = 16;
    Random random(183);
    const bend::Body body = loose_body(random, vertices);
    const std::vector<bend::Pose> poses(instances, {1, 2});
    std::vector<float> weights(instances, 1.0f);
    OutputBuffer out("x y z", vertices * instances);
    for (const Isa isa : isas_here()) {
        CAPTURE(name(isa));
        CountingKernels kernels(isa);
        bend::Batch batch{.body = &body, .count = instances};
        batch.poses = strided(std::span(poses));
        batch.wrinkle_weights = strided(std::span(weights));
        batch.vertex_step = vertices;
        out.attach(batch);
        const auto calls = [&](bool past_the_cache) {
            bend::BatchRunner runner(batch, kernels.set, past_the_cache);
            CountingKernels::calls = 0;
            for (std::size_t i = 0; i < instances; ++i) runner.add(i);
            runner.finish();
            return CountingKernels::calls;
        };
        // Every second instance begins where a line does.
        const bool has_kernels = bend::kernels(isa).shared_lines[0][0] != nullptr;
        CHECK(calls(true) == (has_kernels ? 8 : 0));
        CHECK(calls(false) == 0);
        weights[2] = 0;
        CHECK(calls(true) == (has_kernels ? 7 : 0));
        weights[2] = 1;
    }
}

}  // namespace goffer::test
