// SPDX-License-Identifier: MIT
#include "body/check.hpp"
#include "body_files.hpp"

#include <doctest/doctest.h>

#include <cstdio>
#include <fstream>

/// Body files that are wrong, or forged.

namespace goffer::test {

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
        INFO(std::string(bend::describe(fault).c_str()));
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

TEST_CASE("body file: no byte can be changed, or added, unnoticed") {
    Random random(56);
    const AlignedBytes file(saved(random_body(random, 3)));
    const std::span<std::byte> bytes = file.bytes();
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const std::byte kept = bytes[i];
        for (int flip = 1; flip < 256; ++flip) {
            bytes[i] = kept ^ static_cast<std::byte>(flip);
            if (bend::load(bytes)) FAIL("byte " << i << " with " << flip);
        }
        bytes[i] = kept;
    }
    CHECK(bend::load(bytes).has_value());
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
    CHECK(text_after([](auto& bytes) { put(std::span(bytes), 12, bend::body_file_version + 1); }) ==
          "body file: of version 3, and this library reads 1 to 2; bake it again, or use a newer library");
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
    // Vertices near joints: where none can be, behind the last one, and with scales that none has.
    CHECK(at(FileSection::bands, 288, std::uint64_t{1}).section == FileSection::bands);
    CHECK(at(FileSection::bands, 296, ~std::uint64_t{0}).section == FileSection::bands);
    for (const float scale : {-1.0f, 1001.0f, std::numeric_limits<float>::quiet_NaN()}) {
        CHECK(at(FileSection::bands, 304, scale).section == FileSection::bands);
        CHECK(at(FileSection::bands, 308, scale).section == FileSection::bands);
    }
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

TEST_CASE("body file: wrinkles that get too steep where a body tapers are refused") {
    for (const bool compares : {false, true}) {
        CAPTURE(compares);
        bend::RegionInput region{.length = 1, .max_angle = 2, .vertex_count = 4, .max_scale = 2};
        region.onset = compares ? 0.1 : 0;
        region.table = {2, {bend::WrinkleRow{1}, bend::WrinkleRow{1}}};
        const double depth = bend::deepest_wrinkle({&region, 1}, 0, 0.1);
        std::vector<bend::RestVertex> vertices;
        for (const double scale : {0.5, 1.0, 1.5, 2.0})
            vertices.push_back(
                {.rho = 0.1, .wrinkle = 9e3 / depth, .scale = scale, .scale_slope = 1e3 * scale});
        vertices[3].scale_slope *= -0.99;
        const std::vector<bend::RestVector> normals(vertices.size(), {.rho = 1});
        bend::BodyInput input = input_of({&region, 1}, vertices, normals);
        const bend::Body body = bend::Body::make(input).value();
        const auto fault_with = [&](float coefficient) {
            return fault_after(body, [&](std::span<std::byte> bytes) {
                for (const std::size_t row : {0, 1})
                    put(bytes, begin_of(bytes, FileSection::wrinkle_rows) + row * sizeof(bend::WrinkleRow),
                        coefficient);
            });
        };
        CHECK(fault_with(1.1f).none());
        CHECK(fault_with(1.2f).body.field == bend::BodyField::scale_slope);
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
    const int trials = rounds(4000, 400);
    for (int trial = 0; trial < trials; ++trial) {
        const AlignedBytes file(saved(random_body(random)));
        const std::span<std::byte> bytes = file.bytes();
        for (std::size_t n = 1 + random() % 8; n-- > 0;)
            put(bytes, random() % (bytes.size() / 4) * 4, static_cast<std::uint32_t>(random()));
        const auto made = bend::load(bytes, nullptr, bend::Verify::layout);
        if (made) ++loaded, run_of(made->levels[0].body, 1);
    }
    CHECK(loaded > trials / 4);
}

TEST_CASE("body file: what cannot be read as a file is said to be") {
    const auto refused = [](const char* name) {
        BodyFileFault fault;
        CHECK(!bend::load_file(name, &fault));
        CHECK(!bend::load_file(name));
        return std::string(bend::describe(fault).c_str());
    };
    CHECK(refused(GOFFER_SOURCE_DIR "/tests/data/none.goffer") ==
          "body file: there is no such file; check its name, and the working folder");
    CHECK(refused(GOFFER_SOURCE_DIR "/tests/data") ==
          "body file: cannot be opened or read; check its permissions");
    CHECK(refused(GOFFER_SOURCE_DIR "/README.md") == "body file: not a body file; goffer bake makes one");
    Random random(58);
    const std::vector<std::byte> bytes = saved(random_body(random));
    // The same whether from a file or from memory.
    const auto refused_alike = [&](std::span<const std::byte> wrong) {
        const std::string name = "wrong_" + std::to_string(wrong.size()) + ".goffer";
        std::ofstream(name, std::ios::binary)
            .write(reinterpret_cast<const char*>(wrong.data()), static_cast<std::streamsize>(wrong.size()));
        BodyFileFault fault;
        CHECK(!bend::load_copy(wrong, &fault));
        const std::string said(bend::describe(fault).c_str());
        CHECK(refused(name.c_str()) == said);
        std::remove(name.c_str());
        return said;
    };
    for (const std::size_t size : {8u, 40u, 63u, 64u, 100u})
        (void)refused_alike(std::span(bytes).first(size));
    AlignedBytes newer(bytes);
    put(newer.bytes(), 12, 9u);
    CHECK(refused_alike(newer.bytes()).find("of version 9,") != std::string::npos);
}

}  // namespace goffer::test
