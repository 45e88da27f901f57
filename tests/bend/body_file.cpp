// SPDX-License-Identifier: MIT
#include "body_files.hpp"

#include <doctest/doctest.h>

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
    CHECK(
        bend::Sockets::make(loaded, std::array{file.sockets[0].socket, file.sockets[1].socket}).has_value());
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

TEST_CASE("body file: one of version 1 is read, and bends as it did when it was written") {
    BodyFileFault fault;
    const auto file = bend::load_file(GOFFER_SOURCE_DIR "/tests/data/cylinder_v1.goffer", &fault);
    INFO(std::string(bend::describe(fault).c_str()));
    REQUIRE(file.has_value());
    REQUIRE(file->levels.size() == 2);
    CHECK(file->sockets.at(0).name == "tip");
    const std::vector<bend::Pose> poses{{0.6f, 0.3f}, {-0.4f, 1.0f}};
    const bend::Body& body = file->levels[0].body;
    std::vector<glm::vec3> positions(body.vertex_count());
    bend::DeformJob job{.body = &body, .poses = poses};
    job.positions = interleaved<3>(&positions[0].x, positions.size());
    bend::run(job);
    const std::pair<std::size_t, glm::vec3> places[] = {{0, {1, 0, 0}},
                                                        {23, {0.355762f, -0.255346f, 1.06836f}},
                                                        {46, {0.508074f, -0.924657f, 2.8031f}},
                                                        {69, {0.383074f, 0.427835f, 4.68014f}},
                                                        {92, {1.43919f, 1.35038f, 5.92699f}},
                                                        {115, {2.90247f, 1.36069f, 7.21275f}}};
    for (const auto& [vertex, place] : places) CHECK(glm::distance(positions[vertex], place) < 5e-5f);
}

TEST_CASE("body file: what is looked at is what was asked for") {
    Random random(61);
    const bend::Body body = random_body(random);
    const AlignedBytes file(saved(body));
    const std::span<std::byte> bytes = file.bytes();
    const auto refused = [&](bend::Verify verify) {
        BodyFileFault fault;
        return bend::load(bytes, &fault, verify) ? FileReason::none : fault.reason;
    };
    using enum bend::Verify;
    for (const bend::Verify verify : {everything, checksum, layout})
        CHECK(refused(verify) == FileReason::none);
    put(bytes, begin_of(bytes, FileSection::triangles), 60u);  // no such vertex
    CHECK(refused(everything) == FileReason::checksum);
    CHECK(refused(checksum) == FileReason::checksum);
    CHECK(refused(layout) == FileReason::none);
    sign(bytes);
    CHECK(refused(everything) == FileReason::index);
    CHECK(refused(checksum) == FileReason::none);
    put(bytes, 64, std::uint64_t{0});  // where a section begins
    for (const bend::Verify verify : {checksum, layout}) CHECK(refused(verify) != FileReason::none);
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
