// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"
#include "support/layout_case.hpp"
#include "support/output_buffer.hpp"

#include <goffer/bend/crowd.hpp>

#include <doctest/doctest.h>

#include <string>
#include <vector>

/// Output streams of every layout and alignment, by any stores: the bits of planes, and nothing else written.

namespace goffer::test {
namespace {

constexpr std::string_view layout_pictures[] = {
    // tight records
    "xyz",
    "xyzuvw",
    "xyzuvwabcd",
    "uvwabcd xyz",
    "xyzabcd",
    "abcd",
    "uvw",
    "123",
    "pqr",
    "xyz uvw abcd",
    // members in another order
    "uvwxyz",
    "abcduvwxyz",
    "uvwabcdxyz pqr",
    // with gaps: 32, 48, 64, 20, 100 bytes, and 1000
    "xyzuvw..",
    "xyz.uvw.",
    ".xyzuvwabcd.",
    "xyzuvwabcd......",
    "..xyz",
    "xyzuvwabcd...............",
    "xyz.123.pqr",
    "123.",
    "..123...",
    "abcd.xyz uvw.",
    // components in the caller's order
    "zyx",
    "zyxuvw",
    "xyzwvu.dcba",
    "xy.z rqp",
    // planes, and planes beside records
    "x y z",
    "u v w",
    "a b c d",
    "x y z u v w a b c d",
    "x y z uvw",
    "xyz u v w",
    "x y z uvwabcd",
    "a b c d xyzuvw 123",
    "xu yv zw",
    "p q r x y z u v w abcd",
    // the same memory for two passes
    "xyzuvwabcdpqr123",
    "123pqr",
};

/// All layouts, at the given places behind a cache line, cached and non-temporal.
void check_layouts(LayoutCase& test_mesh, std::span<const std::size_t> shifts,
                   std::span<const std::size_t> skews) {
    for (const Isa isa : isas_here()) {
        test_mesh.make_planes(isa);
        for (const std::string_view picture : layout_pictures) {
            for (const std::size_t shift : shifts) {
                for (const std::size_t skew : skews) {
                    INFO(picture, ", ", test_mesh.count(), " vertices, shift ", shift, ", skew ", skew, ", ",
                         name(isa));
                    OutputBuffer out(picture, test_mesh.count(), shift, skew);
                    for (const bend::Stores stores : {bend::Stores::cached, bend::Stores::non_temporal}) {
                        const bend::Batch batch = bend::batch_of(test_mesh.job(out));
                        const bend::CrowdJob crowd{.batches = {&batch, 1}, .stores = stores, .isa = isa};
                        REQUIRE(bend::validate(crowd).none());
                        bend::run(crowd);
                        REQUIRE(out.fault(test_mesh.planes()) == "");
                    }
                }
            }
        }
    }
}

constexpr std::size_t every_shift[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

}  // namespace

TEST_CASE("every layout holds the bits of planes: every alignment") {
    Random random(41);
    for (const std::size_t count : {1u, 16u, 37u, 260u, 523u}) {
        LayoutCase test_mesh(random,
                             count % 3 == 1 ? loose_shaped_body(random, count) : loose_body(random, count));
        const std::size_t skews[] = {0, 1 + random() % 15};
        check_layouts(test_mesh, every_shift, skews);
    }
}

TEST_CASE("every layout holds the bits of planes: every vertex count") {
    Random random(42);
    std::vector<std::size_t> counts{255, 256, 257, 258, 259, 511, 512, 513, 514, 515, 767, 1000, 1024, 1039};
    for (std::size_t count = 1; count <= 70; ++count) counts.push_back(count);
    for (const std::size_t count : counts) {
        LayoutCase test_mesh(random, loose_body(random, count));
        const std::size_t shifts[] = {0, random() % 16};
        const std::size_t skews[] = {random() % 2 == 0 ? 0 : random() % 16};
        check_layouts(test_mesh, shifts, skews);
    }
}

TEST_CASE("a range writes its own vertices alone, in every layout") {
    Random random(43);
    LayoutCase small(random, loose_body(random, 35)), large(random, loose_body(random, 800));
    for (const Isa isa : isas_here()) {
        small.make_planes(isa);
        large.make_planes(isa);
        for (const std::string_view picture : layout_pictures) {
            const auto check = [&](LayoutCase& test_mesh, std::size_t first, std::size_t last) {
                INFO(picture, ", [", first, ", ", last, "), ", name(isa));
                OutputBuffer out(picture, test_mesh.count(), random() % 16, random() % 16);
                bend::run_range(test_mesh.job(out), first, last);
                REQUIRE(out.fault(test_mesh.planes(), first, last) == "");
            };
            for (std::size_t first = 0; first <= small.count(); ++first) {
                for (std::size_t last = first; last <= small.count(); last += 1 + random() % 3)
                    check(small, first, last);
            }
            for (int trial = 0; trial < 20; ++trial) {
                const std::size_t first = random() % large.count();
                check(large, first, first + random() % (large.count() - first + 1));
            }
        }
    }
}

TEST_CASE("non-temporal pieces write their own vertices alone, in every layout") {
    Random random(44);
    LayoutCase test_mesh(random, loose_body(random, 700));
    for (const Isa isa : isas_here()) {
        test_mesh.make_planes(isa);
        for (const std::string_view picture : layout_pictures) {
            for (const std::size_t pieces : {2u, 5u, 60u}) {
                INFO(picture, ", ", pieces, " pieces, ", name(isa));
                OutputBuffer out(picture, test_mesh.count(), random() % 16,
                                 random() % 2 == 0 ? 0 : random() % 16);
                const bend::Batch batch = bend::batch_of(test_mesh.job(out));
                const bend::CrowdJob crowd{
                    .batches = {&batch, 1}, .stores = bend::Stores::non_temporal, .isa = isa};
                for (std::size_t piece = pieces; piece-- > 0;) bend::run_piece(crowd, piece, pieces);
                REQUIRE(out.fault(test_mesh.planes()) == "");
            }
        }
    }
}

TEST_CASE("planes that compete for the cache may be followed by one that begins its lines elsewhere") {
    Random random(45);
    constexpr std::size_t count = 300, kilobytes = 512, elsewhere = 3;  // floats
    LayoutCase test_mesh(random, loose_body(random, count));
    for (const Isa isa : isas_here()) {
        INFO(name(isa));
        test_mesh.make_planes(isa);
        OutputBuffer other("xyz", count);
        bend::DeformJob job = test_mesh.job(other);
        Columns memory(1, 3 * kilobytes);
        float* const first = memory[0].data();
        job.positions = {{first, first + kilobytes, first + 2 * kilobytes + elsewhere}, sizeof(float), count};
        const bend::Batch batch = bend::batch_of(job);
        bend::run(bend::CrowdJob{.batches = {&batch, 1}, .stores = bend::Stores::non_temporal, .isa = isa});
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t c = 0; c < 3; ++c)
                REQUIRE(job.positions.component[c][i] == test_mesh.planes().value("xyz"[c], i));
        }
    }
}

}  // namespace goffer::test
