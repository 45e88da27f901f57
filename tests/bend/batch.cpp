// SPDX-License-Identifier: MIT
#include "kernel/kernels.hpp"
#include "pieces.hpp"
#include "support/arena.hpp"
#include "support/faults.hpp"
#include "support/test_batch.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <vector>

/// P5 of columns: however a batch's instances are kept, and wherever they are deformed to, each has the bits
/// of run() for it alone, and nothing else is written.

namespace goffer::test {
namespace {

constexpr std::array both_stores = {bend::Stores::cached, bend::Stores::non_temporal};

constexpr std::string_view batch_pictures[] = {"x y z u v w a b c d p q r 123",
                                               "xyz",
                                               "xyzuvw",
                                               "xyzuvwabcd",
                                               "xyzuvwpqr",
                                               "xyzpqr",
                                               "123",
                                               "x y z 123",
                                               "xyz.uvw.",
                                               "..123...pqr.",
                                               "xyz uvw abcd pqr",
                                               "zyx wvu",
                                               "xyzuvw......",
                                               "x y z"};

using Matrix = bend::TransformColumn::MatrixLayout;

/// Runs `crowd` by `run` on cleared batches, which must then hold what `expected` counts.
template <class Run>
void check_batches(TestBatches& tested, const bend::CrowdJob& crowd, const bend::CrowdResult& expected,
                   Run run) {
    tested.clear();
    const bend::CrowdResult result = run(crowd);
    REQUIRE(tested.fault(crowd.frame) == "");
    CHECK(result.deformed == expected.deformed);
    CHECK(result.clamped == expected.clamped);
    CHECK(result.at_rest == expected.at_rest);
}

bend::CrowdResult run_one(const bend::CrowdJob& crowd) {
    return bend::run(crowd);
}

std::vector<bend::Body> bodies_of_all_sizes(Random& random) {
    constexpr std::size_t few[] = {37}, many[] = {4500, 4500}, chain[] = {40, 1, 0, 7, 130},
                          pair[] = {300, 290};
    std::vector<bend::Body> result;
    result.push_back(loose_chain(random, few));
    result.push_back(loose_chain(random, chain));
    result.push_back(loose_chain(random, many));
    result.push_back(loose_chain(random, pair));
    result.push_back(loose_body(random, 1));
    return result;
}

}  // namespace

TEST_CASE("P5: columns in every storage give the bits of single jobs") {
    Random random(101);
    const std::vector<bend::Body> all = bodies_of_all_sizes(random);
    std::size_t picture = 0;
    for (const Isa isa : isas_here()) {
        for (const Storage storage : all_storages) {
            for (const Matrix matrix : {Matrix::columns3, Matrix::columns4, Matrix::rows4}) {
                for (const unsigned ways : {0u, 1u, 2u, 3u}) {
                    BatchStyle style{.storage = storage, .transforms = matrix};
                    style.indices = (ways & 1) != 0;
                    style.places = (ways & 2) != 0;
                    style.picture = batch_pictures[picture++ % std::size(batch_pictures)];
                    INFO(name(isa), ", storage ", static_cast<int>(storage), ", matrices ",
                         static_cast<int>(matrix), ", ways ", ways, ", ", style.picture);
                    TestBatches tested;
                    tested.add(random, all[0], 9, style);
                    tested.add(random, all[1], 6, style);
                    const bend::CrowdResult expected = tested.expect(isa);
                    CHECK(expected.deformed == 15);
                    CHECK(expected.at_rest == 0);
                    for (const bend::Stores stores : both_stores) {
                        const bend::CrowdJob crowd{.batches = tested.batches, .stores = stores, .isa = isa};
                        REQUIRE(told(bend::validate(crowd)) == "none");
                        check_batches(tested, crowd, expected, run_one);
                    }
                }
            }
        }
    }
}

TEST_CASE("P5: batches in pieces, in arenas and on threads give the bits of single jobs") {
    Random random(102);
    const std::vector<bend::Body> all = bodies_of_all_sizes(random);
    for (const Isa isa : isas_here()) {
        for (int trial = 0; trial < 6; ++trial) {
            INFO(name(isa), ", trial ", trial);
            TestBatches tested;
            for (std::size_t i = 0; i < all.size(); ++i) {
                BatchStyle style;
                style.storage = all_storages[random() % 4];
                style.transforms = static_cast<Matrix>(random() % 3);
                style.indices = random() % 2 == 0;
                style.places = random() % 2 == 0;
                style.masks = trial % 2 == 1;
                style.defaults = random() % 4 == 0;
                style.hostile = trial == 5;
                style.scratch_gaps = random() % 2 == 0;
                style.picture = batch_pictures[random() % std::size(batch_pictures)];
                tested.add(random, all[i], random() % (all[i].vertex_count() > 1000 ? 40 : 12), style);
            }
            bend::CrowdJob crowd{.batches = tested.batches, .frame = static_cast<std::uint32_t>(trial)};
            crowd.stores = both_stores[static_cast<std::size_t>(trial) / 2 % 2];
            crowd.isa = isa;
            if (trial != 5) REQUIRE(told(bend::validate(crowd)) == "none");
            const bend::CrowdResult expected = tested.expect(isa, crowd.frame);
            check_batches(tested, crowd, expected, run_one);
            for (const int threads : {1, 3}) {
                check_batches(tested, crowd, expected, [&](const bend::CrowdJob& job) {
                    bend::CrowdResult result;
                    in_arena(threads, [&] { result = bend::run_parallel(job); });
                    return result;
                });
            }
            for (const std::size_t pieces : {1u, 2u, 7u, 100u}) {
                for (const std::size_t threads : {1u, 3u}) {
                    check_batches(tested, crowd, expected, [&](const bend::CrowdJob& job) {
                        return run_on_threads(job, threads, pieces);
                    });
                }
            }
        }
    }
}

TEST_CASE("between instances, lines are filled up where gaps are scratch, and nowhere else") {
    Random random(104);
    constexpr std::size_t instances = 20, line = 16;
    constexpr auto past = bend::Stores::non_temporal;
    struct Case {
        std::size_t more;  // from an instance's last line to the next instance
        bool scratch;
        bend::Stores stores;
        bool fills;
    };
    constexpr Case cases[] = {{0, true, past, true},
                              {16, true, past, true},
                              {0, false, past, false},
                              {0, true, bend::Stores::cached, false}};
    for (const std::size_t vertices : {203u, 47u, 479u}) {
        const bend::Body body = loose_body(random, vertices);
        const std::size_t whole = (vertices + line - 1) / line * line;
        std::vector<bend::Pose> poses(instances);
        for (bend::Pose& pose : poses)
            pose = {static_cast<float>(uniform(random, -2, 2)), static_cast<float>(uniform(random, -4, 4))};
        for (const Isa isa : isas_here()) {
            std::vector<OutputBuffer> alone;
            for (const bend::Pose& pose : poses) {
                bend::DeformJob job{.body = &body, .pose = pose, .previous_pose = pose, .isa = isa};
                alone.emplace_back(OutputBuffer::all_planes, vertices).attach(job);
                bend::run(job);
            }
            const bend::KernelSet& kernels = bend::kernels(isa);
            constexpr bend::StreamSet positions = bend::StreamSet::positions;
            const bool weaves = kernels.weaving_kernel(bend::Squeeze::plain, positions) != nullptr;
            const bool pairs = kernels.pair_kernel(bend::Squeeze::plain, positions) != nullptr;
            for (const std::string_view picture : {"x y z", "x y z u v w", "xyz", "xyzuvw", "xyzpqr",
                                                   "xyzpqruvw", "xyz.", "xyz.uvw.", "xyzuvw.."}) {
                for (const Case& one : cases) {
                    INFO(name(isa), ", ", picture, ", ", vertices, ", more ", one.more, ", scratch ",
                         one.scratch);
                    const std::size_t step = whole + one.more;
                    OutputBuffer out(picture, instances * step);
                    bend::Batch batch{.body = &body, .count = instances, .poses = strided(std::span(poses))};
                    batch.previous_poses = batch.poses;
                    batch.vertex_step = step;
                    batch.scratch_gaps = one.scratch;
                    out.attach(batch);
                    bend::run(bend::CrowdJob{.batches = {&batch, 1}, .stores = one.stores, .isa = isa});
                    std::vector<OutputBuffer::Part> parts;
                    for (std::size_t i = 0; i < instances; ++i) {
                        const std::size_t padding = one.fills && i + 1 < instances ? step - vertices : 0;
                        parts.push_back({&alone[i], 0, vertices, i * step, true, padding});
                    }
                    using Gaps = OutputBuffer::Gaps;
                    REQUIRE(out.fault(parts, one.scratch ? Gaps::scratch : Gaps::kept) == "");
                    const bool dense = picture.find('.') == picture.npos;
                    const bool direct =
                        picture.starts_with("x ") || (picture.find('p') == picture.npos ? weaves : pairs);
                    if (!dense || !direct) continue;
                    for (std::size_t i = 0; i < instances; ++i) {
                        const bool filled = one.fills && i + 1 < instances;
                        REQUIRE((out.value('x', i * step + vertices) != OutputBuffer::guard) == filled);
                    }
                }
            }
        }
    }
}

TEST_CASE("masks and intervals are read from columns, and what has no turn is not touched") {
    Random random(103);
    const std::vector<bend::Body> all = bodies_of_all_sizes(random);
    for (const Storage storage : all_storages) {
        for (const bool indices : {false, true}) {
            TestBatches tested;
            BatchStyle style{.storage = storage, .indices = indices, .masks = true};
            tested.add(random, all[0], 60, style);
            style.picture = "xyzuvw";
            tested.add(random, all[1], 40, style);
            std::size_t turns = 0;
            // The last ones: a frame's number may wrap around, an instance's turn is told from the sum.
            for (const std::uint32_t frame : {0u, 1u, 2u, 3u, 4u, 5u, 0xfffffffeu, 0xffffffffu}) {
                CAPTURE(frame);
                const bend::CrowdJob crowd{.batches = tested.batches, .frame = frame};
                const bend::CrowdResult expected = tested.expect(Isa::automatic, frame);
                turns += expected.deformed;
                check_batches(tested, crowd, expected, run_one);
                check_batches(tested, crowd, expected,
                              [](const bend::CrowdJob& job) { return bend::run_parallel(job); });
                check_batches(tested, crowd, expected,
                              [](const bend::CrowdJob& job) { return run_on_threads(job, 2, 9); });
            }
            CHECK((turns > 100 && turns < 500));
        }
    }
}

TEST_CASE("pieces share what is not skipped equally") {
    constexpr std::size_t count = 120, pieces = 5;
    Random random(104);
    const bend::Body body = loose_body(random, 50);
    const std::vector<bend::Pose> poses(count);
    std::vector<std::uint8_t> visible(count);
    for (std::size_t i = 0; i < count; ++i) visible[i] = i % 3 == 0 ? 1 : 0;
    OutputBuffer out("x y z", count * body.vertex_count());
    bend::Batch batch{.body = &body, .count = count};
    batch.poses = strided(std::span(poses));
    batch.visible = strided(std::span(std::as_const(visible)));
    batch.vertex_step = body.vertex_count();
    out.attach(batch);
    const bend::CrowdJob crowd{.batches = {&batch, 1}};
    for (std::size_t piece = 0; piece < pieces; ++piece)
        CHECK(bend::run_piece(crowd, piece, pieces).deformed == count / 3 / pieces);
}

TEST_CASE("pieces of large bodies are the same vertices of many instances") {
    constexpr std::size_t count = 40, half = 4096, vertices = 2 * half;
    constexpr std::size_t row = 16, pieces = 5;  // of half a row each
    Random random(105);
    const bend::Body body = loose_body(random, vertices);
    const std::vector<bend::Pose> poses(count, {1, 2});
    std::vector<std::uint8_t> visible(count);
    for (std::size_t i = 0; i < count; ++i) visible[i] = i % 4 == 0 ? 1 : 0;
    OutputBuffer out("x y z", count * vertices);
    bend::Batch batch{.body = &body, .count = count};
    batch.poses = strided(std::span(poses));
    batch.visible = strided(std::span(std::as_const(visible)));
    batch.vertex_step = vertices;
    out.attach(batch);
    const bend::CrowdJob crowd{.batches = {&batch, 1}};
    for (std::size_t piece = 0; piece < pieces; ++piece) {
        CAPTURE(piece);
        out.clear();
        bend::run_piece(crowd, piece, pieces);
        const bool last = piece + 1 == pieces;  // its row is half as long
        const std::size_t begin = piece % 2 * half, end = last ? vertices : begin + half;
        for (std::size_t i = 0; i < count; i += 4) {
            const bool mine = i / row == piece / 2;
            for (const std::size_t v : {std::size_t{0}, half - 1, half, vertices - 1})
                CHECK((out.value('x', i * vertices + v) != OutputBuffer::guard) ==
                      (mine && v >= begin && v < end));
        }
    }
}

TEST_CASE("every n-th frame: each instance has its turn, and the turns are spread") {
    Random random(86);
    const bend::Body body = loose_body(random, 20);
    const std::vector<std::uint8_t> intervals = {0, 1, 2, 3, 4, 4, 4, 4, 3, 3, 2, 255};
    const std::vector<bend::Pose> poses(intervals.size(), {1, 0});
    Columns out(3, intervals.size() * 20);
    bend::Batch batch{.body = &body, .count = intervals.size()};
    batch.poses = strided(std::span(poses));
    batch.update_intervals = strided(std::span(intervals));
    batch.positions = planar(out[0], out[1], out[2]);
    batch.vertex_step = 20;
    std::vector<int> turns(intervals.size());
    for (std::uint32_t frame = 0; frame < 12; ++frame) {
        std::ranges::fill(out[0], 99.0f);
        const std::size_t deformed =
            bend::run(bend::CrowdJob{.batches = {&batch, 1}, .frame = frame}).deformed;
        std::size_t seen = 0;
        for (std::size_t i = 0; i < turns.size(); ++i) {
            const bool own = out[0][20 * i] != 99.0f;
            turns[i] += own ? 1 : 0;
            seen += own ? 1 : 0;
        }
        CHECK(seen == deformed);
        CHECK(seen <= 7);  // of the four with n = 4, for one, there is one in each frame
    }
    for (std::size_t i = 0; i + 1 < turns.size(); ++i) CHECK(turns[i] == 12 / std::max<int>(intervals[i], 1));
}

TEST_CASE("columns that are not given stand for the identity, full wrinkles and every turn") {
    Random random(104);
    const std::vector<bend::Body> all = bodies_of_all_sizes(random);
    TestBatches tested;
    for (const std::string_view picture : batch_pictures) {
        BatchStyle style{.places = true, .defaults = true, .picture = picture};
        style.transforms = static_cast<Matrix>(tested.batches.size() % 3);
        tested.add(random, all[1], 7, style);
    }
    const bend::CrowdJob crowd{.batches = tested.batches, .frame = 3};
    REQUIRE(told(bend::validate(crowd)) == "none");
    check_batches(tested, crowd, tested.expect(Isa::automatic), run_one);
}

TEST_CASE("instances may share the elements of columns") {
    Random random(105);
    const bend::Body body = loose_body(random, 50);
    const std::vector<bend::Pose> poses{{1, 2}, {-2, 0.5f}, {3, 3}};
    const std::vector<std::uint32_t> indices{2, 2, 0, 2, 0, 0, 2};
    OutputBuffer out("xyzuvw", 50 * indices.size());
    bend::Batch batch{.body = &body, .count = indices.size(), .indices = indices};
    batch.poses = strided(std::span(poses));
    batch.vertex_step = 50;  // by instance, not by element
    out.attach(batch);
    std::vector<OutputBuffer> planes;
    for (const bend::Pose& pose : poses) {
        bend::DeformJob job{.body = &body, .pose = pose};
        planes.emplace_back("x y z u v w", 50).attach(job);
        bend::run(job);
    }
    std::vector<OutputBuffer::Part> parts;
    for (std::size_t i = 0; i < indices.size(); ++i) parts.push_back({&planes[indices[i]], 0, 50, 50 * i});
    const bend::CrowdJob crowd{.batches = {&batch, 1}};
    REQUIRE(told(bend::validate(crowd)) == "none");
    CHECK(bend::run(crowd).deformed == indices.size());
    CHECK(out.fault(parts) == "");
}

TEST_CASE("bounds of a batch are those of its instances' jobs, whatever its masks say") {
    Random random(106);
    const std::vector<bend::Body> all = bodies_of_all_sizes(random);
    for (const Isa isa : isas_here()) {
        for (const Storage storage : all_storages) {
            for (const bool hostile : {false, true}) {
                BatchStyle style{.storage = storage, .indices = true, .masks = true, .hostile = hostile};
                style.defaults = storage == Storage::arrays;
                TestBatch test_batch(random, all[1], 23, style);
                std::vector<bend::Bounds> boxes(24, {glm::vec3(7), glm::vec3(-7)});
                bend::bounds(test_batch.batch(), std::span(boxes).first(23), isa);
                for (std::size_t i = 0; i < 23; ++i) {
                    bend::DeformJob job = test_batch.job(i);
                    job.isa = isa;
                    const bend::Bounds box = bend::bounds(job);
                    CHECK(std::memcmp(&box, &boxes[i], sizeof box) == 0);
                    for (int axis = 0; axis < 3; ++axis) CHECK(box.low[axis] <= box.high[axis]);
                }
                CHECK(boxes[23].low == glm::vec3(7));
            }
        }
    }
}

TEST_CASE("a batch of nobody is no fault and no work") {
    Random random(107);
    const std::vector<bend::Body> all = bodies_of_all_sizes(random);
    TestBatches tested;
    tested.add(random, all[0], 0, {});
    tested.add(random, all[1], 4, {});
    tested.add(random, all[0], 0, {.storage = Storage::arrays, .places = true});
    const bend::CrowdJob crowd{.batches = tested.batches};
    CHECK(bend::validate(crowd).none());
    const bend::CrowdResult expected = tested.expect(Isa::automatic);
    check_batches(tested, crowd, expected, run_one);
    check_batches(tested, crowd, expected,
                  [](const bend::CrowdJob& job) { return run_on_threads(job, 2, 5); });
    check_batches(tested, crowd, expected, [](const bend::CrowdJob& job) { return bend::run_parallel(job); });
    const bend::CrowdJob nobody{.batches = std::span(tested.batches).first(1)};
    CHECK(bend::run(nobody).deformed == 0);
    CHECK(bend::run_parallel(nobody).deformed == 0);
}

}  // namespace goffer::test
