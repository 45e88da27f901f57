// SPDX-License-Identifier: MIT
#include "body/body_data.hpp"
#include "body/check.hpp"
#include "body_files.hpp"
#include "capsules.hpp"
#include "support/bound_case.hpp"
#include "support/chain_checks.hpp"
#include "support/rounds.hpp"

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/body_input.hpp>
#include <goffer/bend/bounds.hpp>
#include <goffer/bend/crowd.hpp>
#include <goffer/bend/sockets.hpp>
#include <goffer/fit/sockets.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

/// Folds that run on over joints: P1, P2, P4, P5, P9 and P10 of them, and what is asked of their input.

namespace goffer::test {
namespace {

/// What makes the wrinkles of a chain.
enum class Kind { plain, onset, arc, shape, arcs };
constexpr Kind kinds[] = {Kind::plain, Kind::onset, Kind::arc, Kind::shape, Kind::arcs};

/// A chain of different arcs at rest, over all of whose joints wrinkles run.
BoundCase joined_arcs(Random& random) {
    for (int tries = 0; tries < 1000; ++tries) {
        const std::size_t arcs = 2 + random() % 4;
        fit::BindOptions options;
        options.profile.roundness = uniform(random, 0, 0.5);
        options.folds = static_cast<int>(4 * arcs + random() % 8);
        BoundCase one = random_arcs(random, arcs, options);
        const auto ends = [](const fit::RegionBinding& region) { return region.blend == 0; };
        if (std::none_of(one.binding.regions.begin(), one.binding.regions.end() - 1, ends)) return one;
    }
    FAIL("no chain of arcs has joints over which folds run on");
    return random_arcs(random, 2, {});
}

/// A chain of regions that all wrinkle, over all of their joints.
BoundCase joined_case(Random& random, Kind kind) {
    if (kind == Kind::arcs) return joined_arcs(random);
    const std::size_t regions = std::size_t{2} + random() % 5;
    TestMesh test_mesh = random_mesh(random, uniform(random, 8, 30), std::pow(10, uniform(random, -3, 3)));
    fit::BindOptions options;
    options.profile.roundness = uniform(random, 0, 0.5);
    double sum = 0;
    for (std::size_t i = 0; i < regions; ++i) {
        const int folds = 1 + static_cast<int>(random() % 5);
        options.regions.push_back({folds * uniform(random, 0.6, 1.7), folds});
        sum += options.regions.back().share;
    }
    for (fit::RegionOptions& region : options.regions) region.share /= sum;
    options.shape = fit::ShapeMode::cylinder;
    if (kind == Kind::onset) options.onset = uniform(random, 0.001, 0.1);
    if (kind == Kind::arc)
        test_mesh = bent_at_rest(test_mesh, uniform(random, 0.1, 1), uniform(random, -3, 3));
    if (kind == Kind::shape) {
        options.shape = fit::ShapeMode::automatic;
        if (random() % 2 == 0) options.onset = 0.01;
        add_radii(test_mesh, random);
    }
    fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
    for (std::size_t r = 0; r + 1 < regions; ++r) REQUIRE(binding.regions[r].blend > 0);
    return {std::move(test_mesh), options, std::move(binding)};
}

/// Planes of a crowd's buffer in which a job begins at any place of a line.
struct Shifted {
    Columns columns{10, 5000};

    [[nodiscard]] bend::DeformJob job(const BoundCase& one, std::span<const bend::Pose> poses, Isa isa,
                                      std::size_t shift, int streams) {
        const auto at = [&](std::size_t c) { return columns[c].subspan(shift); };
        bend::DeformJob job{.body = &one.binding.body, .poses = poses};
        job.isa = isa;
        job.positions = planar(at(0), at(1), at(2));
        if (streams > 0) job.normals = planar(at(3), at(4), at(5));
        if (streams > 1) job.tangents = planar(at(6), at(7), at(8), at(9));
        return job;
    }
};

}  // namespace

TEST_CASE("P1, P2, P4: folds over joints agree with the double chain") {
    Random random(161);
    for (const Kind kind : kinds) {
        Worst worst;
        for (int trial = 0; trial < rounds(12, 4); ++trial) {
            CAPTURE(trial);
            const BoundCase one = joined_case(random, kind);
            check_rest(one);
            const bool gentle = one.options.onset.value_or(0) != 0;
            worst.add(worst_of(random, one, 5e-6, gentle ? 0.05 : 0.01));
        }
        MESSAGE("kind ", static_cast<int>(kind), ": position ", worst.position, " L, normal ", worst.normal,
                " deg, tangent ", worst.tangent, " deg");
    }
}

TEST_CASE("P5: folds over joints have the same bits wherever lines and ranges begin") {
    Random random(162);
    for (const Kind kind : kinds) {
        const BoundCase one = joined_case(random, kind);
        const std::size_t count = one.test_mesh.positions.size();
        const std::vector<bend::Pose> poses = random_poses(random, one.binding.body);
        for (const Isa isa : isas_here()) {
            CAPTURE(name(isa));
            Output whole(count);
            bend::run(make_job(one.binding.body, poses, isa, whole));
            for (std::size_t shift = 0; shift < 17; ++shift) {
                const int streams = static_cast<int>(shift % 3);
                Shifted some;
                bend::DeformJob job = some.job(one, poses, isa, shift, streams);
                const auto check = [&] {
                    for (std::size_t c = 0; c < std::array{3u, 6u, 10u}[shift % 3]; ++c)
                        REQUIRE(std::ranges::equal(some.columns[c].subspan(shift, count), whole.columns[c]));
                };
                for (const bend::Stores stores : {bend::Stores::cached, bend::Stores::non_temporal}) {
                    bend::Batch batch = bend::batch_of(job);
                    bend::run(bend::CrowdJob{.batches = {&batch, 1}, .stores = stores, .isa = isa});
                    check();
                }
                for (std::size_t first = 0; first < count;) {
                    const std::size_t last = std::min(count, first + 1 + random() % 300);
                    bend::run_range(job, first, last);
                    first = last;
                }
                check();
            }
        }
    }
}

TEST_CASE("P5: joints with any number of vertices near them have the same bits past the cache") {
    Random random(165);
    std::vector<std::size_t> near;  // joints
    for (int columns = 10; columns <= 80; ++columns) {
        CAPTURE(columns);
        TestMesh test_mesh = random_mesh(random, 12, 1, columns, 55);
        const std::size_t count = test_mesh.positions.size();
        fit::BindOptions options;
        options.shape = fit::ShapeMode::cylinder;
        options.regions = {{0.3, 1}, {0.4, 2}, {0.3, 1}};
        fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
        const BoundCase one = {std::move(test_mesh), options, std::move(binding)};
        const bend::Body& body = one.binding.body;
        const bend::BodyData& data = *body.data();
        for (std::size_t r = 0; r + 1 < data.details.size(); ++r)
            near.push_back(data.details[r + 1].joints.below.last - data.details[r].joints.above.first);
        const std::vector<bend::Pose> poses = random_poses(random, body);
        Output whole(count);
        bend::run(make_job(body, poses, Isa::automatic, whole));
        for (std::size_t shift = 0; shift < 17; shift += 1 + random() % 5) {
            CAPTURE(shift);
            Shifted some;
            const bend::DeformJob job = some.job(one, poses, Isa::automatic, shift, 1);
            const bend::Batch batch = bend::batch_of(job);
            bend::run(bend::CrowdJob{.batches = {&batch, 1}, .stores = bend::Stores::non_temporal});
            for (std::size_t c = 0; c < 6; ++c)
                REQUIRE(std::ranges::equal(some.columns[c].subspan(shift, count), whole.columns[c]));
        }
    }
    // Up to 224 vertices go through the stage together.
    const auto between = [&](std::size_t low, std::size_t high) {
        return std::ranges::any_of(near, [&](std::size_t n) { return low < n && n <= high; });
    };
    MESSAGE("from ", std::ranges::min(near), " to ", std::ranges::max(near), " vertices near a joint");
    CHECK(between(0, 150));
    CHECK(between(208, 224));
    CHECK(between(224, 240));
    CHECK(between(300, 1000));
}

TEST_CASE("P9: with folds over joints, a chain of one curvature is one region, wrinkles and all") {
    Random random(163);
    const TestMesh test_mesh = random_mesh(random, 12, 1);
    fit::BindOptions one, parts;
    one.folds = 12;
    one.shape = parts.shape = fit::ShapeMode::cylinder;
    parts.regions = {{0.25, 3}, {0.5, 6}, {0.25, 3}};
    const fit::Binding whole = fit::bind(test_mesh.geometry(), test_mesh.cylinder, one);
    const fit::Binding chain = fit::bind(test_mesh.geometry(), test_mesh.cylinder, parts);
    check_is_one_region(whole, chain, 0.005);
}

TEST_CASE("P10: bounds and capsules hold folds over joints") {
    Random random(164);
    for (int trial = 0; trial < rounds(50, 10); ++trial) {
        const BoundCase one = joined_case(random, kinds[trial % 5]);
        const std::size_t count = one.test_mesh.positions.size();
        const std::vector<bend::Pose> poses = random_poses(random, one.binding.body);
        Output out(count);
        const bend::DeformJob job = make_job(one.binding.body, poses, Isa::automatic, out);
        bend::run(job);
        bend::Bounds box = bend::bounds(job), same[1];
        bend::bounds(bend::batch_of(job), same);
        CHECK(box.low == same[0].low);
        CHECK(box.high == same[0].high);
        std::vector<bend::Capsule> capsules(bend::capsule_count(one.binding.body, 3));
        bend::capsules(job, 3, capsules);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 p(out.position(i));
            REQUIRE(glm::all(glm::lessThanEqual(box.low, p)));
            REQUIRE(glm::all(glm::lessThanEqual(p, box.high)));
            REQUIRE(hold(capsules, out.position(i)));
        }
    }
}

TEST_CASE("P10: capsules of a region hold what the folds of its neighbors lift there") {
    Random random(166);
    constexpr std::size_t pieces = 8;
    for (int trial = 0; trial < rounds(30, 10); ++trial) {
        const BoundCase one = joined_case(random, Kind::plain);
        const bend::Body& body = one.binding.body;
        std::vector<bend::Pose> poses;  // the one is straight, the next is bent as far as it can be
        for (std::size_t r = 0; r < body.region_count(); ++r)
            poses.push_back({r % 2 == 0 ? 0 : body.max_angle(r), 0.3f});
        Output out(one.test_mesh.positions.size());
        const bend::DeformJob job = make_job(body, poses, Isa::automatic, out);
        bend::run(job);
        std::vector<bend::Capsule> capsules(bend::capsule_count(body, pieces));
        bend::capsules(job, pieces, capsules);
        std::size_t lifted = 0;
        for (std::size_t r = 0; r < body.region_count(); r += 2) {
            const bend::Region& region = body.regions()[r];
            const auto own = std::span(capsules).subspan(r * pieces, pieces);
            for (std::size_t i = region.first; i < region.last; ++i) {
                REQUIRE(hold(own, out.position(i)));
                ++lifted;
            }
        }
        CHECK(lifted > 0);
    }
}

TEST_CASE("sockets near joints move as vertices there") {
    Random random(165);
    for (const Kind kind :
         {Kind::plain, Kind::onset, Kind::shape}) {  // the reference takes vertices of a straight body
        const BoundCase one = joined_case(random, kind);
        const bend::Body& body = one.binding.body;
        std::vector<bend::Socket> sockets;
        double z = 0;
        for (const fit::RegionBinding& region : one.binding.regions) {
            for (const double share : {0.01, 0.5, 0.99})
                sockets.push_back(
                    fit::socket_at(one.binding, z + share * region.length, 0.3, one.binding.cylinder.radius));
            z += region.length;
        }
        std::ranges::reverse(sockets);
        const bend::Sockets tied = bend::Sockets::make(body, sockets).value();
        const std::vector<bend::Pose> poses = random_poses(random, body);
        std::vector<bend::SocketFrame> frames(sockets.size());
        tied.frames(poses, frames);
        const ChainReference expected(one.test_mesh, one.options, one.binding, poses);
        for (std::size_t i = 0; i < sockets.size(); ++i) {
            const bend::RestVertex& v = sockets[i].vertex;
            const glm::dvec3 place = expected.place(sockets[i].region, {v.beta, v.z, v.rho});
            CHECK(glm::length(glm::dvec3(frames[i][3]) - place) < 5e-6 * one.binding.cylinder.length);
        }
    }
}

TEST_CASE("folds over joints: rows of vertices that lie where blends end are on one side or the other") {
    // A quarter of a fold is two rows: whether these are near a joint is for rounding to say.
    Random random(168);
    for (int trial = 0; trial < 8; ++trial) {
        CAPTURE(trial);
        TestMesh test_mesh = random_mesh(random, 12, std::pow(10, uniform(random, -1, 1)), 12, 97, 0);
        fit::BindOptions options;
        const double share = trial % 2 == 0 ? 1.0 / 3 : 0.25;
        options.regions = {
            {share, 4}, {share, trial % 2 == 0 ? 4 : 3}, {1 - 2 * share, trial % 2 == 0 ? 4 : 6}};
        options.shape = fit::ShapeMode::cylinder;
        BoundCase one{test_mesh, options, fit::bind(test_mesh.geometry(), test_mesh.cylinder, options)};
        REQUIRE(one.binding.regions[0].blend > 0);
        worst_of(random, one, 5e-6, 0.01);
        const bend::LevelInput level{&one.binding.body, {}};
        CHECK(bend::load_copy(bend::save({{&level, 1}, {}, {}, {}})).has_value());
    }
}

TEST_CASE("folds over joints: both sides of a joint meet") {
    Random random(169);
    for (const Kind kind : kinds) {
        const BoundCase one = joined_case(random, kind);
        const double length = one.binding.cylinder.length;
        std::vector<bend::Socket> sockets;
        double z = 0;
        for (std::size_t r = 0; r + 1 < one.binding.regions.size(); ++r) {
            const fit::RegionBinding& own = one.binding.regions[r];
            z += own.length;
            for (double beta = -3; beta < 3; beta += 0.7) {
                const bend::Socket above = fit::socket_at(one.binding, z, beta, one.binding.cylinder.radius);
                bend::Socket below = above;  // the same place, as where the region before ends
                const double gain = one.binding.body.region_inputs()[r].blend_gain;
                below.region = r;
                below.vertex.z = own.length;
                below.vertex.wrinkle /= gain;
                if (own.shape) {
                    below.vertex.scale = own.shape->scale(own.length);
                    below.vertex.scale_slope = own.shape->scale_slope(own.length);
                }
                REQUIRE(above.region == r + 1);
                sockets.push_back(below);
                sockets.push_back(above);
            }
        }
        const bend::Sockets tied = bend::Sockets::make(one.binding.body, sockets).value();
        std::vector<bend::SocketFrame> frames(sockets.size());
        for (int trial = 0; trial < 8; ++trial) {
            tied.frames(random_poses(random, one.binding.body), frames);
            for (std::size_t i = 0; i < frames.size(); i += 2)
                CHECK(glm::distance(frames[i][3], frames[i + 1][3]) < 2e-6 * length);
        }
    }
}

TEST_CASE("body file: folds over joints come back to the bit") {
    Random random(166);
    for (const Kind kind : kinds) {
        const BoundCase one = joined_case(random, kind);
        const std::size_t count = one.test_mesh.positions.size();
        const bend::LevelInput level{&one.binding.body, {}};
        bend::BodyFileFault fault;
        const auto file = bend::load_copy(bend::save({{&level, 1}, {}, {}, {}}, &fault));
        const std::string what = bend::describe(fault).c_str();
        CAPTURE(what);
        REQUIRE(file.has_value());
        const std::vector<bend::Pose> poses = random_poses(random, one.binding.body);
        Output a(count), b(count);
        bend::run(make_job(one.binding.body, poses, Isa::automatic, a));
        bend::run(make_job(file->levels[0].body, poses, Isa::automatic, b));
        for (std::size_t c = 0; c < 10; ++c) REQUIRE(std::ranges::equal(a.columns[c], b.columns[c]));
    }
}

TEST_CASE("what is wrong with a joint is named") {
    Random random(167);
    std::vector<bend::RegionInput> regions{loose_region(20), loose_region(20), loose_region(20)};
    LooseVertices loose(random, 60, 0.11);
    for (std::size_t i = 0; i < 60; ++i) loose.vertices[i].z = 0.05 * static_cast<double>(i % 20) + 0.001;
    regions[0].blend = 0.2;
    bend::BodyInput input = input_of(regions, loose.vertices, loose.normals);
    REQUIRE(bend::Body::check(input).none());
    using bend::BodyFault, bend::BodyField, bend::Reason;
    const auto fault_with = [&](const auto& change) {
        std::vector<bend::RegionInput> changed = regions;
        change(changed);
        bend::BodyInput other = input;
        other.regions = changed;
        return bend::Body::check(other);
    };
    const BodyFault blend{BodyField::blend, Reason::out_of_range, 0};
    CHECK(fault_with([](auto& r) { r[0].blend = -0.1; }) == blend);
    CHECK(fault_with([](auto& r) { r[0].blend = 1e-7; }) == blend);
    CHECK(fault_with([](auto& r) { r[0].blend = 1.1; }) == blend);
    CHECK(fault_with([](auto& r) { r[0].blend = std::nan(""); }) ==
          BodyFault{BodyField::blend, Reason::not_finite, 0});
    CHECK(fault_with([](auto& r) { r[0].blend = r[1].blend = 0.6; }) == blend);
    CHECK(fault_with([](auto& r) { r[2].blend = 0.1; }) ==
          BodyFault{BodyField::blend, Reason::out_of_range, 2});
    CHECK(fault_with([](auto& r) { r[1].table = {}; }) == blend);
    CHECK(fault_with([](auto& r) { r[1].onset = 0.1; }) == blend);
    const BodyFault gain{BodyField::blend_gain, Reason::out_of_range, 0};
    CHECK(fault_with([](auto& r) { r[0].blend_gain = 0; }) == gain);
    CHECK(fault_with([](auto& r) { r[0].blend_gain = 1e4; }) == gain);
    CHECK(fault_with([](auto& r) { r[0].blend_gain = std::nan(""); }) ==
          BodyFault{BodyField::blend_gain, Reason::not_finite, 0});
    std::swap(loose.vertices[10], loose.vertices[18]);  // their order is free
    CHECK(bend::Body::check(input).none());
    regions[1].blend = 0.2;
    CHECK(bend::Body::check(input).none());
    std::swap(loose.vertices[20], loose.vertices[39]);
    CHECK(bend::Body::check(input) == BodyFault{BodyField::vertices, Reason::out_of_range, 21});
    std::swap(loose.vertices[20], loose.vertices[39]);
    regions[0].radius = 1e-5;
    CHECK(bend::Body::check(input) == blend);
    regions[0].radius = 0;
    regions[0].rest_angle = regions[1].rest_angle = 0.5;
    CHECK(bend::Body::check(input).index == 1);  // the third region is straight
    regions[1].blend = 0;
    CHECK(bend::Body::check(input).none());
    regions[0].radius = input.radius;  // said, or the body's
    regions[1].rest_direction = 2 * std::numbers::pi;
    CHECK(bend::Body::check(input).none());
    regions[1].radius = 1.01 * input.radius;
    CHECK(bend::Body::check(input).none());
    regions[1].rest_direction = 1;
    CHECK(bend::Body::check(input).none());
    for (const std::size_t sharp : {0u, 1u}) {  // with a squeeze of 0.98 or more
        const auto squeeze_to = [&](double squeeze) {
            const double radius = sharp == 1 ? regions[1].radius : input.radius;
            return fault_with(
                [&](auto& r) { r[sharp].rest_angle = r[sharp].max_angle = squeeze / (2 * radius); });
        };
        CHECK(squeeze_to(0.9799).none());
        CHECK(squeeze_to(0.9801) == blend);
    }
    CHECK(fault_with([](auto& r) { r[0].rest_angle = 0; }) == blend);
    CHECK(fault_with([](auto& r) { r[0].rest_angle = 0, r[0].onset = 0.01; }).none());
    CHECK(std::string(bend::describe(blend).c_str())
              .starts_with("regions[0].blend: out of range; wanted: 0, or"));
    bend::BodyFileFault in_file{bend::FileReason::number, bend::FileSection::rig};
    in_file.body = {BodyField::blend, Reason::out_of_range, 31};
    CHECK(std::string(bend::describe(in_file).c_str()).ends_with("leaves 2 % of inner lines"));  // whole
}

TEST_CASE("near a joint, vertices that are not near it stay numbers, however thick they are") {
    const bend::WrinkleTable thin{1, {bend::WrinkleRow{0.05f}, bend::WrinkleRow{0.05f}}};
    bend::WrinkleTable steep = thin;
    for (bend::WrinkleRow& row : steep.rows) row[row.size() - 1] = 1e-3f;  // times the highest power
    constexpr double length = 1e7;
    const std::vector<bend::RegionInput> regions{
        {.length = length,
         .max_angle = 1,
         .table = thin,
         .vertex_count = 71,
         .radius = 1e3,
         .max_scale = 1e3,
         .blend = 100.1},
        {.length = 200, .max_angle = 1, .table = steep, .vertex_count = 40, .radius = 1}};
    std::vector<bend::RestVertex> vertices;
    for (int i = 0; i < 70; ++i)
        vertices.push_back(
            {.beta = 0.3 * i, .z = length * i / 70, .rho = 1e6, .wrinkle = 1e-7, .scale = 1e3});
    vertices.push_back({.z = length, .rho = 1, .wrinkle = 0.1, .scale = 1e-3});
    for (int i = 0; i < 40; ++i)
        vertices.push_back({.beta = 0.3 * i, .z = 200.0 * i / 39, .rho = 1, .wrinkle = 0.1});
    const std::vector<bend::RestVector> normals(vertices.size(), {.rho = 1});
    bend::BodyInput input = input_of(regions, vertices, normals, 1);
    INFO(std::string(bend::describe(bend::Body::check(input)).c_str()));
    REQUIRE(bend::Body::check(input).none());
    const bend::Body body = bend::Body::make(input).value();
    const std::vector<bend::Pose> poses{{0.5f * body.max_angle(0), 0}, {0.5f, 0}};
    for (const Isa isa : isas_here()) {
        CAPTURE(name(isa));
        Output out(body.vertex_count());
        bend::run(make_job(body, poses, isa, out));
        for (std::size_t c = 0; c < 6; ++c)
            CHECK(std::ranges::all_of(out.columns[c], [](float value) { return std::isfinite(value); }));
    }
    std::vector<bend::RegionInput> without = regions;
    without[0].blend = 0;
    without[0].blend_gain = std::nan("");
    input.regions = without;
    CHECK(bend::Body::check(input) ==
          bend::BodyFault{bend::BodyField::blend_gain, bend::Reason::not_finite, 0});
}

TEST_CASE("wrinkles that pass into each other too steeply are refused, in sockets and files too") {
    for (const bool compares : {false, true}) {
        CAPTURE(compares);
        bend::RegionInput region{.length = 1, .max_angle = 4, .vertex_count = 4};
        region.onset = compares ? 0.1 : 0;
        region.table = {4, {bend::WrinkleRow{1}, bend::WrinkleRow{1}}};
        std::vector<bend::RegionInput> regions{region, region};
        regions[0].blend = 1e-3;
        const double depth = bend::deepest_wrinkle(regions, 0, 0.1);
        std::vector<bend::RestVertex> vertices;
        for (const double z : {0.0, 0.5, 0.9, 0.9995, 0.0, 0.1, 0.5, 1.0})
            vertices.push_back({.z = z, .rho = 0.1, .wrinkle = 9e3 / depth});  // 0.9e6 within the blend
        const std::vector<bend::RestVector> normals(vertices.size(), {.rho = 1});
        bend::BodyInput input = input_of(regions, vertices, normals);
        const bend::Body body = bend::Body::make(input).value();
        vertices[2].wrinkle *= 2;  // not near the joint
        CHECK(bend::Body::check(input).none());
        vertices[3].wrinkle *= -2;
        CHECK(bend::Body::check(input) ==
              bend::BodyFault{bend::BodyField::wrinkle, bend::Reason::out_of_range, 3});
        for (const double z : {0.9, 0.9995}) {
            const bend::NamedSocket socket{"", {0, {0, z, 0.1, 1.8e4 / depth, 0}}};
            const bend::LevelInput level{&body};
            bend::BodyFileInput file;
            file.levels = {&level, 1};
            file.sockets = {&socket, 1};
            CHECK(bend::save(file).empty() == (z > 0.99));
        }
        const auto fault_with = [&](float coefficient) {
            return fault_after(body, [&](std::span<std::byte> bytes) {
                for (const std::size_t row : {0, 1, 2, 3})
                    put(bytes, begin_of(bytes, FileSection::wrinkle_rows) + row * sizeof(bend::WrinkleRow),
                        coefficient);
            });
        };
        CHECK(fault_with(1.1f).none());
        CHECK(fault_with(1.2f).body.field == bend::BodyField::wrinkle);
    }
}

TEST_CASE("a socket that is too thick for the region beyond a joint is refused with its file") {
    Random random(168);
    std::vector<bend::RegionInput> regions{loose_region(20), loose_region(20)};
    LooseVertices loose(random, 40, 0.11);
    for (std::size_t i = 0; i < 40; ++i) loose.vertices[i].z = 0.05 * static_cast<double>(i % 20) + 0.001;
    regions[0].blend = 0.2;
    regions[0].max_scale = 2;
    regions[0].max_angle = 2;
    const bend::Body body = loose.body(regions);
    for (const double z : {0.5, 0.99}) {
        const bend::NamedSocket socket{"", {0, {0, z, 0.05, 0, 0, 2}}};
        CAPTURE(z);
        const bend::LevelInput level{&body};
        bend::BodyFileInput input;
        input.levels = {&level, 1};
        input.sockets = {&socket, 1};
        bend::BodyFileFault fault;
        CHECK(bend::save(input, &fault).empty() == (z > 0.8));
        CHECK(bend::Sockets::make(body, {&socket.socket, 1}).has_value() == (z < 0.8));
        if (z > 0.8) CHECK(fault.section == bend::FileSection::sockets);
    }
}

}  // namespace goffer::test
