// SPDX-License-Identifier: MIT
#pragma once

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

/// What tests of body files share.

namespace goffer::test {

using bend::BodyFile;
using bend::BodyFileFault;
using bend::FileReason;
using bend::FileSection;

/// A random body, straight or bent at rest, with one radius or a shape, of one region or three,
/// some of which wrinkle over their joints. `count` is a multiple of 3.
inline bend::Body random_body(Random& random, std::size_t count = 60) {
    LooseVertices loose(random, count, 0.15);
    const bool shape = random() % 2 == 0, bent = random() % 2 == 0;
    if (shape) loose.add_shape(random);
    if (random() % 2 == 0) loose.tangents.clear(), loose.signs.clear();
    std::vector<bend::RegionInput> regions(random() % 2 == 0 ? 1 : 3);
    for (bend::RegionInput& region : regions) {
        region.length = 1;
        region.max_angle = 3;
        region.max_scale = shape ? LooseVertices::max_scale : 1;
        region.vertex_count = count / regions.size();
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
    blend_some(random, regions, loose.vertices);
    return loose.body(regions);
}

/// A triangle, a part, a material, a socket and notes.
struct Drawn {
    std::vector<std::uint32_t> triangles{0, 1, 2}, source;
    std::vector<glm::vec2> uvs;
    std::vector<bend::DrawPart> parts{{"upper", 0, 1, 1}, {"", 1, 1, -1}};
    std::vector<bend::DrawMaterial> materials{{"skin", {1, 0.5f, 0.25f, 1}}, {"cloth", glm::vec4(0.5f)}};
    std::vector<bend::NamedSocket> sockets{{"tip", {0, {1, 0.5, 0.05, 0, 0}}}, {"hat", {}}};
    std::vector<bend::LevelInput> levels;

    explicit Drawn(const bend::Body& body) {
        const auto count = static_cast<std::uint32_t>(body.vertex_count());
        triangles.insert(triangles.end(), {count - 3, count - 2, count - 1});
        for (std::uint32_t i = 0; i < count; ++i) {
            source.push_back(1000 - i);
            uvs.emplace_back(0.1f * static_cast<float>(i), 1.0f - static_cast<float>(i));
        }
        levels.push_back({&body, {triangles, uvs, source, parts}});
    }

    [[nodiscard]] bend::BodyFileInput input() const {
        return {levels, materials, sockets, "made of nothing"};
    }
};

inline std::vector<std::byte> saved(const bend::Body& body) {
    const Drawn drawn(body);
    BodyFileFault fault;
    std::vector<std::byte> bytes = bend::save(drawn.input(), &fault);
    INFO(std::string(bend::describe(fault).c_str()));
    REQUIRE(!bytes.empty());
    return bytes;
}

/// All that runs write of a body: streams and bounds.
inline std::vector<float> run_of(const bend::Body& body, std::uint32_t seed) {
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

inline bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
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
inline std::size_t begin_of(std::span<const std::byte> bytes, FileSection section) {
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

}  // namespace goffer::test
