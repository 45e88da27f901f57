// SPDX-License-Identifier: MIT
#include "kernel/kernels.hpp"
#include "output/output_plan.hpp"
#include "output/staging_buffer.hpp"
#include "support/layout_case.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

/// What no output shows: a plane of a staging buffer that ran over would write to what lies behind it.

namespace goffer::test {

TEST_CASE("a staging buffer has room for whole units behind every plane") {
    Random random(46);
    LayoutCase test_mesh(random, loose_body(random, 40));
    for (const std::string_view picture : {"xyz", "xyzuvw", "xyzuvwabcd", "123", "xyz123", "xyzpqr",
                                           "xyzuvwabcdpqr", "xyzuvwabcdpqr123", "pqr123"}) {
        CAPTURE(picture);
        OutputBuffer out(picture, test_mesh.count());
        const bool past_the_cache = true;  // where lines that regions share are staged
        const bend::OutputPlan plan(bend::batch_of(test_mesh.job(out)), bend::kernels(Isa::automatic),
                                    past_the_cache);
        REQUIRE(plan.stages());
        const bend::StagingBuffer stage(plan);
        REQUIRE(stage.capacity() > 0);
        CHECK(stage.capacity() % bend::line_floats == 0);
        std::vector<const float*> planes;
        for (const bend::PassPlan& pass : plan.passes()) {
            const bend::PlaneOutput output = stage.output(pass.pass);
            for (const float* const plane : output.position) planes.push_back(plane);
            for (const float* const plane : output.normal) planes.push_back(plane);
            for (const float* const plane : output.tangent) planes.push_back(plane);
        }
        std::erase(planes, nullptr);
        CHECK(planes.size() == plan.value_count());
        std::ranges::sort(planes);
        planes.push_back(reinterpret_cast<const float*>(&stage + 1));
        for (std::size_t i = 0; i + 1 < planes.size(); ++i)
            CHECK(planes[i] + stage.capacity() + bend::max_unit <= planes[i + 1]);
        CHECK(planes[0] >= reinterpret_cast<const float*>(&stage));
    }
}

TEST_CASE("each layout is written on its way") {
    using Mode = bend::WriteMode;
    struct Case {
        std::string_view picture;
        Mode mode;
        bool scratch_gaps = false;
    };
    const bend::KernelSet& kernels = bend::kernels(Isa::automatic);
    // Some sets have no kernels that write records.
    const bool weaves = kernels.weaving_kernel(bend::Squeeze::none, bend::StreamSet::positions) != nullptr;
    const Mode records = weaves ? Mode::records : Mode::staged;
    const bool pairs_up = kernels.pair_kernel(bend::Squeeze::none, bend::StreamSet::positions) != nullptr;
    const Mode pairs = pairs_up ? Mode::pairs : Mode::staged;
    Random random(47);
    LayoutCase test_mesh(random, loose_body(random, 40));
    for (const Case& one : {Case{"x y z", Mode::planes},
                            {"x y z u v w a b c d", Mode::planes},
                            {"xyz", records},
                            {"xyzuvw", records},
                            {"123", records},
                            {"xyz uvw", Mode::staged},
                            {"xyz.", records},
                            {"xyz.uvw.", records},
                            {"xyzuvw..", records},
                            {"xyz..", Mode::staged},
                            {"xyz.pqr.", Mode::staged},
                            {"xyz.", records, true},
                            {"123.", Mode::staged, true},
                            {"xyz.uvw.", records, true},
                            {"xyzuvw..", records, true},
                            {".xyz", Mode::staged, true},
                            {"xyz..", Mode::staged, true},
                            {"xyz.pqr.", Mode::staged, true},
                            {"xyz.uvw.abcd", Mode::staged, true},
                            {"xyzpqr", pairs},
                            {"xyzuvwpqr", pairs},
                            {"pqruvwxyz", pairs},
                            {"uvwpqr", Mode::staged},
                            {"xyzuvwabcdpqr", Mode::staged},
                            {"xyzpqr 123", Mode::staged},
                            {"xyz pqr", records},
                            {"123pqr", Mode::staged},
                            {"pqrxyz", pairs},
                            {"uvwxyzpqr", pairs},
                            {"xzypqr", Mode::staged},
                            {"xyzpqr.", Mode::staged},
                            {"uvwxyz", Mode::staged},
                            {"xyzuvwabcd", Mode::staged}}) {
        INFO(one.picture, ", scratch ", one.scratch_gaps);
        OutputBuffer out(one.picture, test_mesh.count());
        bend::Batch batch = bend::batch_of(test_mesh.job(out));
        batch.scratch_gaps = one.scratch_gaps;
        // Gaps are scratch past the cache alone.
        const bend::OutputPlan plan(batch, kernels, one.scratch_gaps);
        for (const bend::PassPlan& pass : plan.passes()) CHECK(pass.mode == one.mode);
    }
}

TEST_CASE("planes that compete for the same places of the cache are not written side by side") {
    Random random(48);
    LayoutCase test_mesh(random, loose_body(random, 40));
    OutputBuffer out("x y z", test_mesh.count());
    bend::Batch batch = bend::batch_of(test_mesh.job(out));
    alignas(64) static float memory[8192];
    // Bytes from one plane to the next. Those of the cache's places repeat every 1024.
    struct Case {
        std::size_t apart;
        bend::WriteMode past_cache;
    };
    for (const Case& one : {Case{896, bend::WriteMode::planes},
                            {960, bend::WriteMode::staged},
                            {1024, bend::WriteMode::staged},
                            {1088, bend::WriteMode::staged},
                            {1152, bend::WriteMode::planes},
                            {1156, bend::WriteMode::staged},
                            {4096 + 960, bend::WriteMode::staged},
                            {4096 + 256, bend::WriteMode::planes}}) {
        CAPTURE(one.apart);
        for (std::size_t c = 0; c < 3; ++c)
            batch.positions.component[c] = memory + c * one.apart / sizeof(float);
        const bend::KernelSet& kernels = bend::kernels(Isa::automatic);
        CHECK(bend::OutputPlan(batch, kernels, true, true).passes()[0].mode == one.past_cache);
        CHECK(bend::OutputPlan(batch, kernels, false, true).passes()[0].mode == bend::WriteMode::planes);
        // The last but one begin their lines at different vertices.
        const bend::WriteMode any_distance =
            one.apart % 64 == 0 ? bend::WriteMode::planes : bend::WriteMode::staged;
        CHECK(bend::OutputPlan(batch, kernels, true, false).passes()[0].mode == any_distance);
    }
}

TEST_CASE("what lies side by side in a record is written as rows, as long as there is a kernel for") {
    static std::vector<std::size_t> rows;
    bend::KernelSet kernels = bend::kernels(Isa::automatic);
    const auto counting = []<std::size_t n>() -> bend::WriteRows {
        return [](const float* const*, std::size_t, float*, std::size_t) { rows.push_back(n); };
    };
    kernels.write_rows[3] = counting.operator()<3>();
    kernels.write_rows[4] = counting.operator()<4>();
    kernels.write_rows[6] = counting.operator()<6>();
    Random random(49);
    LayoutCase test_mesh(random, loose_body(random, 40));
    struct Case {
        std::string_view picture;
        std::vector<std::size_t> rows;
    };
    for (const Case& one : {Case{"xyz..", {3}},
                            {"xyzuvw...", {6}},
                            {"xyzuvwabcd.", {6, 4}},
                            {"xyz.abcd..", {3, 4}},
                            {"pqr.uvw..", {3, 3}}}) {
        CAPTURE(one.picture);
        OutputBuffer out(one.picture, test_mesh.count());
        const bend::OutputPlan plan(bend::batch_of(test_mesh.job(out)), kernels, false);
        rows.clear();
        bend::StagingBuffer(plan).planes().write(plan, kernels, bend::WriteMode::staged, 0, 40, true);
        CHECK(rows == one.rows);
    }
}

}  // namespace goffer::test
