// SPDX-License-Identifier: MIT
#include "body_files.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>

/// The body file: what is loaded deforms to the bits of what was saved, and nothing else is ever loaded.

namespace goffer::test {

TEST_CASE("body file: a body that was saved and loaded deforms to the same bits") {
    Random random(51);
    for (int round = 0; round < rounds(60, 20); ++round) {
        CAPTURE(round);
        const bend::Body body = random_body(random);
        const std::vector<std::byte> bytes = saved(body);
        const AlignedBytes mapped(bytes);
        BodyFileFault fault;
        const std::optional<BodyFile> file = bend::load(mapped.bytes(), &fault);
        INFO(std::string(bend::describe(fault).c_str()));
        REQUIRE(file.has_value());
        const bend::Body& loaded = file->levels.at(0).body;
        CHECK(loaded.vertex_count() == body.vertex_count());
        CHECK(loaded.bytes() < body.bytes());
        for (std::uint32_t seed = 0; seed < 8; ++seed)
            CHECK(same_bits(run_of(loaded, seed), run_of(body, seed)));
        CHECK(bytes == saved(body));    // nothing by chance
        CHECK(bytes == saved(loaded));  // and nothing lost
    }
}

TEST_CASE("body file: what is drawn, sockets and notes come back") {
    Random random(52);
    const bend::Body body = random_body(random);
    const Drawn drawn(body);
    const AlignedBytes mapped(saved(body));
    const BodyFile file = bend::load(mapped.bytes()).value();
    const auto& [loaded, mesh, box] = file.levels.at(0);
    CHECK(std::ranges::equal(mesh.triangles, drawn.triangles));
    CHECK(std::ranges::equal(mesh.uvs, drawn.uvs));
    CHECK(std::ranges::equal(mesh.source, drawn.source));
    REQUIRE(mesh.parts.size() == 2);
    CHECK(mesh.parts[0].name == "upper");
    CHECK(mesh.parts[0].material == 1);
    CHECK(mesh.parts[1].first_triangle == 1);
    CHECK(mesh.parts[1].material == -1);
    REQUIRE(file.materials.size() == 2);
    CHECK(file.materials[0].name == "skin");
    CHECK(file.materials[0].base_color == glm::vec4(1, 0.5f, 0.25f, 1));
    REQUIRE(file.sockets.size() == 2);
    CHECK(file.sockets[0].name == "tip");
    CHECK(file.sockets[0].socket.vertex.z == 0.5);
    const std::optional<bend::Sockets> sockets = bend::Sockets::make(loaded, file.sockets);
    REQUIRE(sockets.has_value());
    CHECK(sockets->count() == 2);
    std::array<bend::SocketFrame, 2> named, plain;
    sockets->frames(loaded.rest_poses(), named);
    bend::Sockets::make(loaded, std::array{file.sockets[0].socket, file.sockets[1].socket})
        ->frames(loaded.rest_poses(), plain);
    CHECK(named == plain);
    CHECK(file.notes == "made of nothing");
    const bend::Bounds around = bend::bounds(body, body.rest_poses());
    for (int c = 0; c < 3; ++c) {
        CHECK(box.low[c] >= around.low[c]);
        CHECK(box.high[c] <= around.high[c]);
        CHECK(box.high[c] - box.low[c] > 0.5f * (around.high[c] - around.low[c]));
    }
}

TEST_CASE("body file: a body outlives the file that it was copied from, and the bytes") {
    Random random(53);
    const bend::Body body = random_body(random);
    bend::Body kept;
    {
        std::vector<std::byte> bytes = saved(body);
        BodyFile file = bend::load_copy(bytes).value();
        std::ranges::fill(bytes, std::byte{0xff});
        kept = std::move(file.levels[0].body);
    }
    CHECK(same_bits(run_of(kept, 1), run_of(body, 1)));
}

TEST_CASE("body file: levels share one rig") {
    Random random(54);
    LooseVertices fine(random, 60, 0.1), coarse(random, 20, 0.1), other(random, 20, 0.1);
    bend::RegionInput region;
    region.length = 1;
    region.max_angle = 3;
    region.vertex_count = 60;
    const bend::Body first = fine.body(std::span(&region, 1));
    region.vertex_count = 20;
    const bend::Body second = coarse.body(std::span(&region, 1));
    region.length = 1.25;
    const bend::Body third = other.body(std::span(&region, 1));

    std::vector<bend::LevelInput> levels{{&first, {}}, {&second, {}}};
    const BodyFile file = bend::load_copy(bend::save({levels, {}, {}, {}})).value();
    REQUIRE(file.levels.size() == 2);
    CHECK(same_bits(run_of(file.levels[1].body, 3), run_of(second, 3)));

    BodyFileFault fault;
    levels.push_back({&third, {}});
    CHECK(bend::save({levels, {}, {}, {}}, &fault).empty());
    CHECK(std::string(bend::describe(fault).c_str()) ==
          "levels[2].level: does not have the regions, tables and frame of the first level; bind it with "
          "bind_level");
    levels[2].body = nullptr;
    CHECK(bend::save({levels, {}, {}, {}}, &fault).empty());
    CHECK(fault.reason == FileReason::empty);
    levels.assign(bend::max_levels + 1, {&first, {}});
    CHECK(bend::save({levels, {}, {}, {}}, &fault).empty());
    CHECK(fault.reason == FileReason::count);
    levels.clear();
    CHECK(bend::save({levels, {}, {}, {}}, &fault).empty());
    CHECK(fault.reason == FileReason::count);
}

TEST_CASE("body file: a region of one thickness beside others is saved") {
    LooseVertices loose = [] {
        Random random(59);
        return LooseVertices(random, 60, 0.11);
    }();
    std::vector<bend::RegionInput> regions{loose_region(20), loose_region(20), loose_region(20)};
    for (std::size_t i = 0; i < 20; ++i) loose.vertices[i].scale = 1 + 0.01 * static_cast<double>(i % 3);
    for (std::size_t i = 40; i < 60; ++i) loose.vertices[i].scale = 1.3;
    regions[0].max_scale = 1.5;
    regions[2].max_scale = 1.3;
    for (bend::RegionInput& region : regions) region.max_angle = 2;
    const bend::Body body = loose.body(regions);
    const bend::LevelInput level{&body};
    BodyFileFault fault;
    CHECK(!bend::save({{&level, 1}, {}, {}, {}}, &fault).empty());
    INFO(std::string(bend::describe(fault).c_str()));
    CHECK(fault.none());
}

TEST_CASE("body file: the angle of a table without rows may be anything") {
    const bend::RestVertex vertex{.z = 5, .rho = 1};
    const bend::RestVector normal{.rho = 1};
    bend::RegionInput region{.length = 10, .max_angle = 1, .vertex_count = 1};
    region.table.max_angle = region.factors.max_angle = std::numeric_limits<float>::quiet_NaN();
    bend::BodyInput input;
    input.radius = 1;
    input.regions = {&region, 1};
    input.vertices = {&vertex, 1};
    input.normals = {&normal, 1};
    const bend::Body body = bend::Body::make(input).value();
    const std::array<bend::LevelInput, 2> levels{bend::LevelInput{&body, {}}, bend::LevelInput{&body, {}}};
    BodyFileFault fault;
    const std::vector<std::byte> bytes = bend::save({levels, {}, {}, {}}, &fault);
    INFO(std::string(bend::describe(fault).c_str()));
    REQUIRE(!bytes.empty());
    CHECK(bend::load_copy(bytes).has_value());
}

namespace {

/// Where a vertex was when the file was written.
struct Place {
    std::size_t vertex;
    glm::vec3 position;
};

void check_kept(const char* name, const std::vector<bend::Pose>& poses, const std::vector<Place>& places) {
    BodyFileFault fault;
    const std::string path = GOFFER_SOURCE_DIR + std::string("/tests/data/") + name;
    const auto file = bend::load_file(path.c_str(), &fault);
    INFO(std::string(bend::describe(fault).c_str()));
    REQUIRE(file.has_value());
    CHECK(file->sockets.at(0).name == "tip");
    const bend::Body& body = file->levels[0].body;
    std::vector<glm::vec3> positions(body.vertex_count());
    bend::DeformJob job{.body = &body, .poses = poses};
    job.positions = interleaved<3>(&positions[0].x, positions.size());
    bend::run(job);
    for (const Place& place : places) {
        const glm::vec3 position = positions[place.vertex];
        CAPTURE(place.vertex);
        CAPTURE(position.x);
        CAPTURE(position.y);
        CAPTURE(position.z);
        CHECK(glm::distance(position, place.position) < 5e-5f);
    }
}

}  // namespace

TEST_CASE("body file: one of each version is kept, by its number") {
    std::set<std::uint32_t> kept;
    for (const auto& entry : std::filesystem::directory_iterator(GOFFER_SOURCE_DIR "/tests/data")) {
        if (entry.path().extension() != ".goffer") continue;
        std::array<char, 16> start;
        std::ifstream(entry.path(), std::ios::binary).read(start.data(), start.size());
        const auto version = get<std::uint32_t>(std::as_bytes(std::span(start)), 12);
        CHECK(entry.path().stem().string().ends_with("_v" + std::to_string(version)));
        kept.insert(version);
    }
    for (std::uint32_t version = 1; version <= bend::body_file_version; ++version) {
        CAPTURE(version);
        CHECK(kept.contains(version));
    }
}

TEST_CASE("body file: those of all versions are read, and bend as they did when they were written") {
    check_kept("cylinder_v1.goffer", {{0.6f, 0.3f}, {-0.4f, 1.0f}},
               {{0, {1, 0, 0}},
                {23, {0.355762f, -0.255346f, 1.06836f}},
                {46, {0.508074f, -0.924657f, 2.8031f}},
                {69, {0.383074f, 0.427835f, 4.68014f}},
                {92, {1.43919f, 1.35038f, 5.92699f}},
                {115, {2.90247f, 1.36069f, 7.21275f}}});
    // Version 2 has folds that run on over joints.
    check_kept("chain_v2.goffer", {{0.6f, 0.3f}, {-0.4f, 1.0f}, {0.5f, 2.0f}},
               {{0, {1, 0, 0}},
                {100, {-0.755735f, 0.0649738f, 1.45474f}},
                {187, {-0.0656879f, 0.970735f, 2.44694f}},
                {214, {0.801464f, -0.798131f, 2.56314f}},
                {300, {0.451999f, 0.289991f, 3.74457f}},
                {333, {0.621419f, -0.521229f, 3.94945f}},
                {400, {2.67718f, 0.0932155f, 4.39818f}},
                {450, {1.86189f, 1.31341f, 5.09591f}}});
}

TEST_CASE("body file: the checksum is XXH64") {
    const auto hash = [](std::string_view text) {
        bend::Checksum checksum;
        checksum.add(std::as_bytes(std::span(text)));
        return checksum.value();
    };
    CHECK(hash("") == 0xef46db3751d8e999u);
    CHECK(hash("abc") == 0x44bc2cf5ad770999u);
    CHECK(hash("Nobody inspects the spammish repetition") == 0xfbcea83c8a378bf1u);
}

}  // namespace goffer::test
