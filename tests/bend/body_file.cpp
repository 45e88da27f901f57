// SPDX-License-Identifier: MIT
#include "support/bodies.hpp"
#include "support/body_bytes.hpp"
#include "support/rounds.hpp"

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/body_input.hpp>
#include <goffer/bend/bounds.hpp>
#include <goffer/bend/sockets.hpp>

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

/// The body file: what is loaded deforms to the bits of what was saved, and nothing else is ever loaded.

namespace goffer::test {
namespace {

using bend::BodyFile;
using bend::BodyFileFault;
using bend::FileReason;
using bend::FileSection;

/// A random body, straight or bent at rest, with one radius or a shape, of one region or three.
bend::Body random_body(Random& random) {
    LooseVertices loose(random, 60, 0.15);
    const bool shape = random() % 2 == 0, bent = random() % 2 == 0;
    if (shape) loose.add_shape(random);
    if (random() % 2 == 0) loose.tangents.clear(), loose.signs.clear();
    std::vector<bend::RegionInput> regions(random() % 2 == 0 ? 1 : 3);
    for (bend::RegionInput& region : regions) {
        region.length = 1;
        region.max_angle = 3;
        region.max_scale = shape ? LooseVertices::max_scale : 1;
        region.vertex_count = 60 / regions.size();
        region.table.max_angle = 3;
        region.table.rows.resize(2 + random() % 5);
        for (bend::WrinkleRow& row : region.table.rows) {
            for (float& coefficient : row) coefficient = static_cast<float>(uniform(random, 0, 5e-4));
        }
        if (random() % 2 == 0) {
            region.factors.max_angle = 3;
            region.factors.rows.resize(3);
            for (auto& row : region.factors.rows) {
                for (float& factor : row) factor = static_cast<float>(uniform(random, 0.5, 1.5));
            }
        }
        if (bent) region.rest_angle = 0.5, region.rest_direction = 1, region.onset = 1e-3;
    }
    return loose.body(regions);
}

/// A triangle, a part, a material, a socket and notes.
struct Drawn {
    std::vector<std::uint32_t> triangles{0, 1, 2, 57, 58, 59}, source;
    std::vector<glm::vec2> uvs;
    std::vector<bend::DrawPart> parts{{"upper", 0, 1, 1}, {"", 1, 1, -1}};
    std::vector<bend::DrawMaterial> materials{{"skin", {1, 0.5f, 0.25f, 1}}, {"cloth", glm::vec4(0.5f)}};
    std::vector<bend::NamedSocket> sockets{{"tip", {0, {1, 0.5, 0.05, 0, 0}}}, {"hat", {}}};
    std::vector<bend::LevelInput> levels;

    explicit Drawn(const bend::Body& body) {
        for (std::uint32_t i = 0; i < 60; ++i) {
            source.push_back(1000 - i);
            uvs.emplace_back(0.1f * static_cast<float>(i), 1.0f - static_cast<float>(i));
        }
        levels.push_back({&body, {triangles, uvs, source, parts}});
    }

    [[nodiscard]] bend::BodyFileInput input() const {
        return {levels, materials, sockets, "made of nothing"};
    }
};

std::vector<std::byte> saved(const bend::Body& body) {
    const Drawn drawn(body);
    BodyFileFault fault;
    std::vector<std::byte> bytes = bend::save(drawn.input(), &fault);
    INFO(bend::describe(fault).c_str());
    REQUIRE(!bytes.empty());
    return bytes;
}

/// All that runs write of a body: streams and bounds.
std::vector<float> run_of(const bend::Body& body, std::uint32_t seed) {
    Random random(seed);
    std::vector<bend::Pose> poses(body.region_count());
    for (bend::Pose& pose : poses)
        pose = {static_cast<float>(uniform(random, -3, 3)), static_cast<float>(uniform(random, -4, 4))};
    const std::size_t count = body.vertex_count();
    std::vector<float> out(10 * count);
    bend::DeformJob job{.body = &body, .poses = poses};
    job.positions = interleaved<3>(out.data(), count);
    job.normals = interleaved<3>(&out[3 * count], count);
    if (body.has_tangents()) job.tangents = interleaved<4>(&out[6 * count], count);
    REQUIRE(bend::validate(job).none());
    bend::run(job);
    const bend::Bounds box = bend::bounds(job);
    for (int c = 0; c < 3; ++c) out.insert(out.end(), {box.low[c], box.high[c]});
    return out;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

template <class T>
void put(std::span<std::byte> bytes, std::size_t offset, T value) {
    std::memcpy(&bytes[offset], &value, sizeof value);
}

template <class T>
T get(std::span<const std::byte> bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, &bytes[offset], sizeof value);
    return value;
}

/// Where a section of a file of one level begins.
std::size_t begin_of(std::span<const std::byte> bytes, FileSection section) {
    const auto place = static_cast<std::size_t>(section) - static_cast<std::size_t>(FileSection::rig);
    return get<std::uint64_t>(bytes, 64 + 16 * place);
}

/// What load finds in a body's file after `change(bytes)`, signed again.
template <class Change>
BodyFileFault fault_after(const bend::Body& body, const Change& change) {
    const AlignedBytes file(saved(body));
    change(file.bytes());
    sign(file.bytes());
    BodyFileFault fault;
    const bool loaded = bend::load(file.bytes(), &fault).has_value();
    CHECK(loaded == fault.none());
    return fault;
}

}  // namespace

TEST_CASE("body file: a body that was saved and loaded deforms to the same bits") {
    Random random(51);
    for (int round = 0; round < rounds(60, 20); ++round) {
        CAPTURE(round);
        const bend::Body body = random_body(random);
        const std::vector<std::byte> bytes = saved(body);
        const AlignedBytes mapped(bytes);
        BodyFileFault fault;
        const std::optional<BodyFile> file = bend::load(mapped.bytes(), &fault);
        INFO(bend::describe(fault).c_str());
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

TEST_CASE("body file: what does not fit together is not saved") {
    Random random(55);
    const bend::Body body = random_body(random);
    const auto fault_of = [&](const auto& change) {
        Drawn drawn(body);
        change(drawn);
        BodyFileFault fault;
        const bool refused = bend::save(drawn.input(), &fault).empty();
        CHECK(refused == !fault.none());
        return fault;
    };
    CHECK(fault_of([](Drawn&) {}).none());
    const auto faulty = [&](FileReason reason, FileSection section, const auto& change) {
        const BodyFileFault fault = fault_of(change);
        INFO(bend::describe(fault).c_str());
        CHECK(fault.reason == reason);
        CHECK(fault.section == section);
    };
    faulty(FileReason::index, FileSection::triangles, [](Drawn& d) { d.triangles[4] = 60; });
    faulty(FileReason::count, FileSection::triangles,
           [](Drawn& d) { d.levels[0].mesh.triangles = std::span(d.triangles).first(5); });
    faulty(FileReason::count, FileSection::uvs,
           [](Drawn& d) { d.levels[0].mesh.uvs = std::span(d.uvs).first(59); });
    faulty(FileReason::count, FileSection::source,
           [](Drawn& d) { d.levels[0].mesh.source = std::span(d.source).first(1); });
    faulty(FileReason::number, FileSection::uvs,
           [](Drawn& d) { d.uvs[3].y = std::numeric_limits<float>::quiet_NaN(); });
    faulty(FileReason::index, FileSection::parts, [](Drawn& d) { d.parts[0].material = 2; });
    faulty(FileReason::index, FileSection::parts, [](Drawn& d) { d.parts[0].material = -2; });
    faulty(FileReason::count, FileSection::parts, [](Drawn& d) { d.parts[1].triangle_count = 2; });
    faulty(FileReason::layout, FileSection::parts, [](Drawn& d) { d.parts[1].first_triangle = 0; });
    faulty(FileReason::number, FileSection::materials,
           [](Drawn& d) { d.materials[1].base_color.b = std::numeric_limits<float>::infinity(); });
    faulty(FileReason::index, FileSection::sockets, [](Drawn& d) { d.sockets[0].socket.region = 7; });
    faulty(FileReason::number, FileSection::sockets, [](Drawn& d) { d.sockets[0].socket.vertex.z = 9; });
    faulty(FileReason::number, FileSection::sockets, [](Drawn& d) { d.sockets[1].socket.normal.rho = 2; });
}

TEST_CASE("body file: no byte can be changed, added or taken away unnoticed") {
    Random random(56);
    const bend::Body body = random_body(random);
    const AlignedBytes file(saved(body));
    const std::span<std::byte> bytes = file.bytes();
    const std::size_t step = sanitized ? 7 : 1;
    for (std::size_t i = 0; i < bytes.size(); i += step) {
        const std::byte kept = bytes[i];
        for (const std::byte flip : {std::byte{1}, std::byte{0x80}, std::byte{0xff}}) {
            bytes[i] = kept ^ flip;
            if (bend::load(bytes)) FAIL("byte " << i);
        }
        bytes[i] = kept;
    }
    CHECK(bend::load(bytes).has_value());
    for (std::size_t size = 0; size < bytes.size(); size += step) {
        if (bend::load(bytes.first(size))) FAIL("first " << size << " bytes");
    }
    std::vector<std::byte> longer(bytes.begin(), bytes.end());
    longer.push_back(std::byte{0});
    BodyFileFault fault;
    CHECK(!bend::load_copy(longer, &fault));
    CHECK(fault.reason == FileReason::too_long);
}

TEST_CASE("body file: the reason says what to do") {
    Random random(57);
    const bend::Body body = random_body(random);
    const AlignedBytes file(saved(body));
    const auto text_after = [&](const auto& change) {
        std::vector<std::byte> bytes(file.bytes().begin(), file.bytes().end());
        change(bytes);
        BodyFileFault fault;
        CHECK(!bend::load_copy(bytes, &fault));
        return std::string(bend::describe(fault).c_str());
    };
    CHECK(text_after([](auto& bytes) { bytes.clear(); }) ==
          "body file: not a body file; goffer bake makes one");
    CHECK(text_after([](auto& bytes) { bytes[3] = std::byte{'x'}; }) ==
          "body file: not a body file; goffer bake makes one");
    CHECK(text_after([](auto& bytes) { put(std::span(bytes), 8, 0x04030201u); }) ==
          "body file: made on a machine of the other byte order; bake it again for this one");
    CHECK(text_after([](auto& bytes) { put(std::span(bytes), 12, 2u); }) ==
          "body file: of a version that this library does not know; bake it again, or use a newer library");
    CHECK(text_after([](auto& bytes) { bytes.resize(bytes.size() - 64); }) ==
          "body file: has fewer bytes than it says; copy or bake it again");
    CHECK(text_after([](auto& bytes) { bytes.back() = std::byte{1}; }) ==
          "body file: was changed since it was written; copy or bake it again");
    BodyFileFault fault;
    std::vector<std::byte> shifted(file.bytes().size() + 64);
    const auto past = reinterpret_cast<std::uintptr_t>(shifted.data()) % 64;
    const std::span<std::byte> odd = std::span(shifted).subspan(past == 4 ? 8 : 4, file.bytes().size());
    std::ranges::copy(file.bytes(), odd.begin());
    if (reinterpret_cast<std::uintptr_t>(odd.data()) % 64 != 0) {
        CHECK(!bend::load(odd, &fault));
        CHECK(std::string(bend::describe(fault).c_str()) ==
              "body file: does not begin at a multiple of 64 bytes in memory; use load_copy");
    }
    CHECK(bend::load_copy(odd).has_value());
}

TEST_CASE("body file: a forged one is refused for what is in it") {
    Random random(58);
    const bend::Body body = random_body(random);
    const auto at = [&](FileSection section, std::size_t offset, auto value) {
        return fault_after(
            body, [&](std::span<std::byte> bytes) { put(bytes, begin_of(bytes, section) + offset, value); });
    };
    CHECK(fault_after(body, [](std::span<std::byte>) {}).none());
    CHECK(at(FileSection::rig, 96, -1.0).body.field == bend::BodyField::radius);
    CHECK(at(FileSection::regions, 0, 0.0).body.field == bend::BodyField::length);
    CHECK(at(FileSection::regions, 64, 1000000u).section == FileSection::wrinkle_rows);
    CHECK(at(FileSection::wrinkle_rows, 0, 1e30f).body.field == bend::BodyField::table);
    CHECK(at(FileSection::level, 0, std::uint64_t{0}).section == FileSection::level);
    CHECK(at(FileSection::level, 0, std::uint64_t{61}).section == FileSection::bands);
    CHECK(at(FileSection::level, 0, ~std::uint64_t{0}).reason == FileReason::layout);
    CHECK(at(FileSection::level, 8, std::uint64_t{64}).reason != FileReason::none);
    CHECK(at(FileSection::level, 28, std::numeric_limits<float>::quiet_NaN()).section == FileSection::level);
    CHECK(at(FileSection::bands, 8, 0.25f).section == FileSection::bands);
    CHECK(at(FileSection::bands, 36, 0.25f).section == FileSection::bands);
    CHECK(at(FileSection::materials, 0, 0xffffffffu).reason == FileReason::index);
    CHECK(at(FileSection::parts, 4, 1000u).reason == FileReason::index);
    CHECK(at(FileSection::parts, 24, 5u).reason == FileReason::index);  // characters of another name
    for (std::size_t place = 0; place < 15; ++place) {
        for (const std::size_t field : {0, 8}) {
            const BodyFileFault fault = fault_after(body, [&](std::span<std::byte> bytes) {
                const std::size_t offset = 64 + 16 * place + field;
                put(bytes, offset, get<std::uint64_t>(bytes, offset) + (1u << 20));
            });
            CHECK(fault.section == FileSection::directory);
        }
    }
}

TEST_CASE("body file: whatever a signed file holds, what is loaded stays within float and its bounds") {
    Random random(59);
    std::size_t loaded = 0, refused = 0;
    for (int round = 0; round < rounds(4000, 400); ++round) {
        const AlignedBytes file(saved(random_body(random)));
        const std::span<std::byte> bytes = file.bytes();
        const std::size_t begin = begin_of(bytes, FileSection::level);
        for (std::size_t n = 1 + random() % 3; n-- > 0;) {
            const std::size_t place = (begin + random() % (bytes.size() - begin - 4)) / 4 * 4;
            const float old = get<float>(bytes, place);
            const float values[] = {-old,
                                    old * 2,
                                    old + 1e-6f,
                                    0,
                                    1e-40f,
                                    1e30f,
                                    std::bit_cast<float>(static_cast<std::uint32_t>(random()))};
            put(bytes, place, values[random() % std::size(values)]);
        }
        sign(bytes);
        BodyFileFault fault;
        const std::optional<BodyFile> made = bend::load(bytes, &fault);
        made ? ++loaded : ++refused;
        if (!made) continue;
        const std::vector<float> out = run_of(made->levels[0].body, 1);
        const std::size_t count = made->levels[0].body.vertex_count();
        const float* box = out.data() + 10 * count;
        bool sound = std::ranges::all_of(out, [](float x) { return std::isfinite(x); });
        for (std::size_t i = 0; i < 3 * count; ++i)
            sound = sound && out[i] >= box[2 * (i % 3)] - 1e-4f && out[i] <= box[2 * (i % 3) + 1] + 1e-4f;
        CAPTURE(round);
        CHECK(sound);
    }
    CHECK(loaded > 0);
    CHECK(refused > 0);
}

TEST_CASE("body file: without verification a changed file still runs within its memory") {
    Random random(60);
    int loaded = 0;
    for (int round = 0; round < rounds(4000, 400); ++round) {
        const AlignedBytes file(saved(random_body(random)));
        const std::span<std::byte> bytes = file.bytes();
        for (std::size_t n = 1 + random() % 8; n-- > 0;)
            put(bytes, random() % (bytes.size() / 4) * 4, static_cast<std::uint32_t>(random()));
        const auto made = bend::load(bytes, nullptr, bend::Verify::layout);
        if (made) ++loaded, run_of(made->levels[0].body, 1);
    }
    CHECK(loaded > 100);
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
    INFO(bend::describe(fault).c_str());
    REQUIRE(!bytes.empty());
    CHECK(bend::load_copy(bytes).has_value());
}

TEST_CASE("body file: what cannot be read as a file is said to be") {
    const auto refused = [](const char* name) {
        BodyFileFault fault;
        CHECK(!bend::load_file(name, &fault));
        CHECK(!bend::load_file(name));
        return std::string(bend::describe(fault).c_str());
    };
    CHECK(refused(GOFFER_SOURCE_DIR "/tests/data/none.goffer") == "body file: there is none of that name");
    CHECK(refused(GOFFER_SOURCE_DIR "/tests/data") == "body file: cannot be opened or read");
    CHECK(refused(GOFFER_SOURCE_DIR "/README.md") == "body file: not a body file; goffer bake makes one");
}

TEST_CASE("body file: one of version 1 is read, and bends as it did when it was written") {
    BodyFileFault fault;
    const auto file = bend::load_file(GOFFER_SOURCE_DIR "/tests/data/cylinder_v1.goffer", &fault);
    INFO(bend::describe(fault).c_str());
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
