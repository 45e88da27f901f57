// SPDX-License-Identifier: MIT
#include "support/faults.hpp"

#include "not_finite.hpp"
#include "support/bodies.hpp"

#include <goffer/bend/rest_vertex.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// P7: validate() names what is wrong with a job, and describe() says it. (Crowds: batch_faults.cpp.)

namespace goffer::test {
namespace {

using bend::DeformJob;
using bend::Field;
using bend::Reason;

constexpr std::size_t count = 20;

/// What validate() tells of `job` after `change`.
template <class Change>
std::string told_after(DeformJob job, Change change) {
    change(job);
    return told(bend::validate(job));
}

float* pointer_one_byte_on(float* pointer) {
    return reinterpret_cast<float*>(reinterpret_cast<std::byte*>(pointer) + 1);
}

}  // namespace

TEST_CASE("P7: validate names the field of a job at fault") {
    Random random(10);
    bend::Body body = loose_body(random, count);
    Output out(count);
    const DeformJob good = make_job(body, {1.1f, 0.7f}, Isa::automatic, out);
    CHECK(told(bend::validate(good)) == "none");
    CHECK(told_after(good, [](DeformJob& j) { j.body = nullptr; }) == "body null");
    CHECK(told_after(good, [](DeformJob& j) { j.isa = static_cast<Isa>(99); }) == "isa not_supported");
    CHECK(told_after(good, [](DeformJob& j) { j.positions = {}, j.normals = {}, j.tangents = {}; }) ==
          "outputs empty");
    CHECK(told_after(good, [](DeformJob& j) { --j.positions.count; }) == "positions too_short");
    CHECK(told_after(good, [](DeformJob& j) { j.normals.count = 0; }) == "normals too_short");
    CHECK(told_after(good, [](DeformJob& j) { --j.tangents.count; }) == "tangents too_short");
    CHECK(told_after(good, [](DeformJob& j) { j.positions.stride = 0; }) == "positions stride");
    CHECK(told_after(good, [](DeformJob& j) { j.normals.stride = 6; }) == "normals stride");
    CHECK(told_after(good, [](DeformJob& j) { j.tangents.stride = 3; }) == "tangents stride");
    for (const std::size_t stride : {~std::size_t{0} - 3, ~std::size_t{0} / 2 - 3})
        CHECK(told_after(good, [&](DeformJob& j) { j.positions.stride = stride; }) ==
              "positions out_of_range");
    CHECK(told_after(good, [](DeformJob& j) {
              j.positions.component[0] = reinterpret_cast<float*>(~std::uintptr_t{0} - 3);
          }) == "positions out_of_range");
    CHECK(told_after(good, [&](DeformJob& j) {
              j.positions = interleaved<3>(out.columns[0].data(), count, 8);
          }) == "positions stride");
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK(told_after(good, [&](DeformJob& j) { j.positions.component[c] = nullptr; }) ==
              "positions null");
        CHECK(told_after(good, [&](DeformJob& j) { j.normals.component[c] = nullptr; }) == "normals null");
        CHECK(told_after(good, [&](DeformJob& j) {
                  j.normals.component[c] = pointer_one_byte_on(j.normals.component[c]);
              }) == "normals alignment");
    }
    for (std::size_t c = 0; c < 4; ++c)
        CHECK(told_after(good, [&](DeformJob& j) { j.tangents.component[c] = nullptr; }) == "tangents null");

    const bend::Body moved(std::move(body));
    CHECK(told(bend::validate(good)) == "body empty");
    const bend::Body never_made;
    CHECK(told_after(good, [&](DeformJob& j) { j.body = &never_made; }) == "body empty");
    CHECK(told_after(good, [&](DeformJob& j) { j.body = &moved; }) == "none");

    const std::vector<bend::RestVertex> vertices(count, {0.1, 0.5, 0.1, 0, 0});
    const std::vector<bend::RestVector> normals(count, {1, 0, 0});
    const bend::Body without = bare_body(vertices, normals);
    CHECK(told_after(good, [&](DeformJob& j) { j.body = &without; }) == "tangents not_supported");
    CHECK(told_after(good, [&](DeformJob& j) { j.body = &without, j.tangents = {}; }) == "none");
}

TEST_CASE("P7: validate names the number of a job at fault") {
    Random random(11);
    const bend::Body body = loose_body(random, count);
    Output out(count);
    const DeformJob good = make_job(body, {1.1f, 0.7f}, Isa::automatic, out);
    CHECK(told_after(good, [](DeformJob& j) { j.pose.angle = nan; }) == "poses not_finite, region 0");
    CHECK(told_after(good, [](DeformJob& j) { j.pose.angle = -infinity; }) == "poses not_finite, region 0");
    CHECK(told_after(good, [](DeformJob& j) { j.pose.direction = nan; }) == "poses not_finite, region 0");
    CHECK(told_after(good, [](DeformJob& j) { j.pose.direction = infinity; }) ==
          "poses not_finite, region 0");

    for (const float bad : {nan, infinity, -infinity})
        CHECK(told_after(good, [&](DeformJob& j) { j.wrinkle_weight = bad; }) == "wrinkle_weight not_finite");
    for (const float bad : {-1e-6f, 1.0001f, -3e38f, 3e38f})
        CHECK(told_after(good, [&](DeformJob& j) { j.wrinkle_weight = bad; }) ==
              "wrinkle_weight out_of_range");
    for (const float fine : {0.0f, -0.0f, 1e-45f, 0.5f, 1.0f})
        CHECK(told_after(good, [&](DeformJob& j) { j.wrinkle_weight = fine; }) == "none");

    for (int c = 0; c < 4; ++c) {
        for (int row = 0; row < 3; ++row) {
            const auto with = [&](float number) {
                return told_after(good, [&](DeformJob& j) { j.transform[c][row] = number; });
            };
            CHECK(with(nan) == "transform not_finite");
            CHECK(with(-infinity) == "transform not_finite");
            CHECK(with(-2e18f) == "transform too_large");
            CHECK(with(1e18f) == "none");
        }
    }
}

TEST_CASE("P7: validate names what is at fault with packed vertices and with previous positions") {
    Random random(12);
    const bend::Body body = loose_body(random, count);
    Output out(count);
    std::vector<bend::PackedVertex> vertices(count + 1);

    DeformJob packed{.body = &body};
    packed.packed = {vertices.data(), sizeof(bend::PackedVertex), count};
    CHECK(told(bend::validate(packed)) == "none");
    CHECK(told_after(packed, [](DeformJob& j) { --j.packed.count; }) == "packed too_short");
    for (const std::size_t stride : {0u, 8u, 14u})
        CHECK(told_after(packed, [&](DeformJob& j) { j.packed.stride = stride; }) == "packed stride");
    CHECK(told_after(packed, [](DeformJob& j) { j.packed.stride = 16; }) == "none");
    CHECK(told_after(packed, [&](DeformJob& j) {
              j.packed.first = reinterpret_cast<bend::PackedVertex*>(&vertices[0].position[1]);
          }) == "packed alignment");
    bend::Bounds box;
    CHECK(told_after(packed, [&](DeformJob& j) { j.packed = {}, j.bounds = &box; }) == "outputs empty");

    DeformJob previous{.body = &body};
    previous.previous_positions = planar(out.columns[0], out.columns[1], out.columns[2]);
    CHECK(told(bend::validate(previous)) == "none");
    CHECK(told_after(previous, [](DeformJob& j) { j.previous_pose.angle = nan; }) ==
          "previous_poses not_finite, region 0");
    CHECK(told_after(previous, [](DeformJob& j) { j.previous_pose.direction = -infinity; }) ==
          "previous_poses not_finite, region 0");
    CHECK(told_after(previous, [](DeformJob& j) { j.previous_transform[3][1] = nan; }) ==
          "previous_transform not_finite");
    CHECK(told_after(previous, [](DeformJob& j) { j.previous_transform[0][2] = 1.1e18f; }) ==
          "previous_transform too_large");
    CHECK(told_after(previous, [](DeformJob& j) { --j.previous_positions.count; }) ==
          "previous_positions too_short");
    CHECK(told_after(previous, [](DeformJob& j) { j.previous_positions.stride = 10; }) ==
          "previous_positions stride");
    CHECK(told_after(previous, [&](DeformJob& j) {
              j.previous_positions = interleaved<3>(out.columns[0].data(), count, 8);
          }) == "previous_positions stride");
    CHECK(told_after(previous, [](DeformJob& j) { j.previous_positions.component[1] = nullptr; }) ==
          "previous_positions null");
    // What is not asked for need not make sense.
    CHECK(told_after(packed, [](DeformJob& j) {
              j.previous_pose.angle = nan, j.previous_transform[0][0] = nan;
          }) == "none");
}

TEST_CASE("P7: validate names the region whose pose is at fault") {
    Random random(13);
    const std::size_t counts[] = {5, 7, 8};
    const bend::Body body = loose_chain(random, counts);
    Output out(count), before(count);
    const std::vector<bend::Pose> poses{{0.5f, 1}, {-1, 2}, {2, -3}};
    DeformJob good = make_job(body, bend::Pose{}, Isa::automatic, out);
    good.poses = poses;
    CHECK(told(bend::validate(good)) == "none");
    CHECK(told_after(good, [&](DeformJob& j) { j.poses = std::span(poses).first(2); }) == "poses count");
    CHECK(told_after(good, [&](DeformJob& j) { j.poses = {}; }) == "poses count");
    for (std::size_t region = 0; region < 3; ++region) {
        std::vector<bend::Pose> bad = poses;
        const std::string where = ", region " + std::to_string(region);
        bad[region].angle = nan;
        CHECK(told_after(good, [&](DeformJob& j) { j.poses = bad; }) == "poses not_finite" + where);
        bad[region] = {1, infinity};
        CHECK(told_after(good, [&](DeformJob& j) { j.poses = bad; }) == "poses not_finite" + where);
    }
    good.previous_positions = planar(before.columns[0], before.columns[1], before.columns[2]);
    CHECK(told(bend::validate(good)) == "previous_poses count");
    std::vector<bend::Pose> previous = poses;
    good.previous_poses = previous;
    CHECK(told(bend::validate(good)) == "none");
    previous[1].direction = nan;
    CHECK(told(bend::validate(good)) == "previous_poses not_finite, region 1");
}

TEST_CASE("P7: validate names two streams that share bytes, and no others") {
    Random random(14);
    const bend::Body body = loose_body(random, count);
    std::vector<float> memory(40 * count);
    const auto at = [&](std::size_t first, std::size_t stride) {
        return interleaved<3>(&memory[first], count, stride * sizeof(float));
    };
    const auto overlaps = [&](const Stream3& positions, const Stream3& normals) {
        DeformJob job{.body = &body};
        job.positions = positions;
        job.normals = normals;
        const bend::Fault fault = bend::validate(job);
        if (fault.none()) return false;
        CHECK(is_overlap(fault, Field::positions, Field::normals));
        return true;
    };
    CHECK(overlaps(at(0, 3), at(0, 3)));
    CHECK(overlaps(at(0, 6), at(2, 6)));
    CHECK(overlaps(at(0, 6), at(5, 6)));              // over the end of the record, into the next one
    CHECK(overlaps(at(0, 3), at(3 * count - 1, 3)));  // one float
    CHECK(overlaps(at(6, 6), at(0, 6)));
    CHECK_FALSE(overlaps(at(0, 6), at(3, 6)));
    CHECK_FALSE(overlaps(at(3, 6), at(0, 6)));
    CHECK_FALSE(overlaps(at(0, 10), at(7, 10)));
    CHECK_FALSE(overlaps(at(7, 10), at(10, 10)));  // the next record's gap
    CHECK_FALSE(overlaps(at(0, 3), at(3 * count, 3)));
    CHECK_FALSE(overlaps(at(3 * count, 3), at(0, 3)));
    const auto plane = [&](std::size_t first) { return std::span(memory).subspan(first, count); };
    CHECK(overlaps(planar(plane(0), plane(count), plane(2 * count)),
                   planar(plane(3 * count), plane(4 * count), plane(3 * count - 1))));
    CHECK_FALSE(overlaps(planar(plane(0), plane(2 * count), plane(4 * count)),
                         planar(plane(count), plane(3 * count), plane(5 * count))));
    CHECK(overlaps(planar(plane(0), plane(count), plane(2 * count)), at(3 * count - 2, 3)));

    // Bounds lie beside streams, at an address of their type.
    DeformJob boxed{.body = &body};
    boxed.positions = at(12, 3);
    const auto bounds_at = [&](std::size_t byte) {
        boxed.bounds = reinterpret_cast<bend::Bounds*>(reinterpret_cast<char*>(memory.data()) + byte);
        return told(bend::validate(boxed));
    };
    CHECK(bounds_at(0) == "none");
    CHECK(bounds_at(12 * sizeof(float) - sizeof(bend::Bounds)) == "none");
    CHECK(bounds_at((12 + 3 * count) * sizeof(float)) == "none");
    CHECK(bounds_at(1) == "bounds alignment");
    boxed.bounds = reinterpret_cast<bend::Bounds*>(&memory[11]);
    CHECK(is_overlap(bend::validate(boxed), Field::bounds, Field::positions));
    boxed.bounds = reinterpret_cast<bend::Bounds*>(&memory[11 + 3 * count]);
    CHECK(is_overlap(bend::validate(boxed), Field::bounds, Field::positions));

    // Every two kinds of streams.
    DeformJob all{.body = &body};
    all.positions = at(0, 20);
    all.normals = at(3, 20);
    all.tangents = interleaved<4>(&memory[6], count, 80);
    all.packed = {reinterpret_cast<bend::PackedVertex*>(&memory[10]), 80, count};
    all.previous_positions = at(13, 20);
    CHECK(told(bend::validate(all)) == "none");
    const std::pair<std::size_t, Field> begins[] = {{0, Field::positions},
                                                    {3, Field::normals},
                                                    {6, Field::tangents},
                                                    {10, Field::packed},
                                                    {13, Field::previous_positions}};
    for (const auto& [first, field] : begins) {
        for (const auto& [second, other] : begins) {
            if (field == other) continue;
            DeformJob job = all;
            if (other == Field::positions) job.positions = at(first, 20);
            if (other == Field::normals) job.normals = at(first, 20);
            if (other == Field::tangents) job.tangents = interleaved<4>(&memory[first], count, 80);
            if (other == Field::packed)
                job.packed.first = reinterpret_cast<bend::PackedVertex*>(&memory[first]);
            if (other == Field::previous_positions) job.previous_positions = at(first, 20);
            // Tangents are longer: they may touch the stream behind as well.
            const bend::Fault fault = bend::validate(job);
            CAPTURE(told(fault));
            CHECK(fault.reason == Reason::overlap);
            if (other != Field::tangents) CHECK(is_overlap(fault, field, other));
        }
    }
}

TEST_CASE("P7: a fault of a job's numbers says how many there are, and how many it takes") {
    Random random(12);
    const bend::Body body = loose_body(random, count);
    Output out(count);
    const DeformJob good = make_job(body, {1.1f, 0.7f}, Isa::automatic, out);
    const auto line = [&](auto change) {
        DeformJob job = good;
        change(job);
        return std::string(bend::describe(bend::validate(job)).c_str());
    };
    CHECK(line([](DeformJob& j) { --j.positions.count; }).ends_with(" (has 19, needs 20)"));
    CHECK(line([](DeformJob& j) { j.normals.count = 0; }).ends_with(" (has 0, needs 20)"));
    const std::vector<bend::Pose> poses(3);
    CHECK(line([&](DeformJob& j) { j.poses = poses; }).ends_with(" (has 3, needs 1)"));
    CHECK(line([&](DeformJob& j) {
              j.previous_positions = j.positions;
              j.positions = {};
              j.previous_poses = poses;
          }).starts_with("previous_poses: not one per region"));
    CHECK(line([](DeformJob& j) { j.positions.stride = 6; }).find("(has") == std::string::npos);
}

TEST_CASE("every fault has a line of its own, which begins with the field") {
    std::vector<std::string> lines;
    for (std::size_t field = 1; field < std::size(field_names); ++field) {
        for (std::size_t reason = 1; reason < std::size(reason_names); ++reason) {
            const bend::FaultText text =
                bend::describe(bend::Fault{static_cast<Field>(field), static_cast<Reason>(reason)});
            const std::string line = text.c_str();
            CAPTURE(line);
            const std::string begin = std::string(field_names[field]) + ": ";
            CHECK(line.starts_with(begin));
            CHECK(line.size() > begin.size());
            CHECK(line.back() != '.');
            lines.push_back(line);
        }
    }
    const std::size_t all = lines.size();
    std::ranges::sort(lines);
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    CHECK(lines.size() == all);
    CHECK(std::string_view(bend::describe(bend::Fault{})) == "no fault");
    const bend::Fault unheard{static_cast<Field>(200), static_cast<Reason>(200), 1, 2, 3};
    CHECK(std::string_view(bend::describe(unheard)).size() > 0);
}

TEST_CASE("a fault's line says where it is, however large the numbers are") {
    const auto line = [](const bend::Fault& fault) { return std::string(bend::describe(fault).c_str()); };
    CHECK(line({Field::poses, Reason::not_finite, 1, 7, 2}).starts_with("batches[1].poses[7][2]: "));
    CHECK(line({Field::vertex_offsets, Reason::out_of_range, 0, 12})
              .starts_with("batches[0].vertex_offsets[12]: "));
    CHECK(line({Field::wrinkle_weight, Reason::out_of_range, 1, 5})
              .starts_with("batches[1].wrinkle_weights[5]: "));
    CHECK(line({Field::transform, Reason::not_finite, 1, 5}).starts_with("batches[1].transforms[5]: "));
    CHECK(line({Field::previous_transform, Reason::null, 1}).starts_with("batches[1].previous_transforms: "));
    CHECK(line({Field::poses, Reason::count}) ==
          "poses: not one per region of the body (a single pose is for a body of one region)");
    CHECK(line({Field::poses, Reason::count, 2}) ==
          "batches[2].poses: fewer elements than instances, or than the indices ask for");
    CHECK(line({Field::body, Reason::null}) == "body: not given");
    CHECK(line({Field::positions, Reason::null}) ==
          "positions: a component is null beside others that are not");
    CHECK(line({Field::visible, Reason::too_short, 3}).starts_with("batches[3].visible: "));
    CHECK(line({Field::positions, Reason::null}).starts_with("positions: "));
    CHECK(line({Field::normals, Reason::out_of_range}).find("all addresses") != std::string::npos);
    CHECK(line({Field::transform, Reason::out_of_range}).find("no such layout") != std::string::npos);
    bend::Fault overlap{Field::normals, Reason::overlap};
    overlap.other = Field::previous_positions;
    CHECK(line(overlap).find("previous_positions") != std::string::npos);
    constexpr std::size_t most = bend::Fault::nowhere - 1;
    bend::Fault farthest{Field::previous_positions, Reason::stride, most, most, most};
    farthest.has = farthest.needs = most;
    const std::string longest = line(farthest);
    CHECK(longest.starts_with("batches[" + std::to_string(most) + "].previous_positions[" +
                              std::to_string(most)));
    CHECK(longest.ends_with(std::to_string(most) + ")"));
}

}  // namespace goffer::test
