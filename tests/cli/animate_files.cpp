// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

/// What `goffer animate` writes for other programs, as these need it.

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

namespace {

/// The 32-bit number of an MDD or another file in network order.
std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
    return value;
}

json document_of(const std::string& glb) {
    std::uint32_t length = 0;
    std::memcpy(&length, &glb[12], sizeof length);
    return json::parse(glb.substr(20, length));
}

/// The last time of an animated GLB.
double end_of(const Folder& folder, const std::string& name) {
    const json document = document_of(bytes_of(folder / name));
    const json& sampler = document["animations"][0]["samplers"][0];
    return document["accessors"][sampler["input"].get<std::size_t>()]["max"][0].get<double>();
}

}  // namespace

TEST_CASE("animate: a point cache of a refined model, or of a GLB, comes with its mesh") {
    const Folder folder;
    std::filesystem::copy_file(GOFFER_SOURCE_DIR "/tests/data/fuze.ply", folder / "fuze.ply");
    std::filesystem::copy_file(GOFFER_SOURCE_DIR "/tests/data/log_01.glb", folder / "log.glb");
    const auto swing = [&](const std::string& model, const std::string& cache, const Words& more = {}) {
        return report(folder, Words{"animate", model, "--swing", "40", "--frames", "4", "-o", cache} + more);
    };
    for (const std::string model : {"fuze.ply", "log.glb"}) {
        for (const std::string ending : {".mdd", ".pc2"}) {
            const json all = swing(model, "clip" + ending);
            CHECK(all["mesh"] == "clip.mesh.ply");
            const mesh::Mesh mesh = mesh::load(folder / "clip.mesh.ply");
            const std::string cache = bytes_of(folder / ("clip" + ending));
            std::uint32_t vertices = big_endian(cache, 4);
            if (ending == ".pc2") std::memcpy(&vertices, &cache[16], sizeof vertices);
            CHECK(mesh.positions.size() == vertices);
            if (model != "fuze.ply" || ending != ".mdd") continue;
            // At the angle 0 a straight body is at rest: frame 0 of the cache is the mesh.
            double farthest = 0;
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                for (int c = 0; c < 3; ++c) {
                    const std::uint32_t bits = big_endian(cache, 8 + 4 * 4 + 12 * i + 4 * c);
                    farthest = std::max<double>(farthest,
                                                std::abs(std::bit_cast<float>(bits) - mesh.positions[i][c]));
                }
            }
            CHECK(farthest < 1e-4);
        }
        refused(folder, 2, {"animate", model, "--swing", "9", "-o", "c.mdd", "--json", "c.mesh.ply"},
                {"replace"});
    }
    CHECK(!swing("fuze.ply", "own.mdd", {"--refine", "off"}).contains("mesh"));
    CHECK(!std::filesystem::exists(folder / "own.mesh.ply"));
}

TEST_CASE("animate: glTF that repeats ends with its first frame, and its length is said") {
    const Folder folder;
    base(folder);
    const auto swing = [&](const std::string& name) {
        return report(folder,
                      {"animate", "base.ply", "--swing", "40", "--frames", "12", "--fps", "24", "-o", name});
    };
    const json gltf = swing("swing.glb"), cache = swing("swing.mdd");
    CHECK(gltf["frames"] == 13);
    CHECK(cache["frames"] == 12);
    CHECK(gltf["seconds"] == 0.5);
    CHECK(cache["seconds"] == 0.5);
    CHECK(end_of(folder, "swing.glb") == doctest::Approx(0.5));
    // Keys that end elsewhere need no frame more.
    folder.write("keys.csv", "time,angle\n0,0\n1,50\n");
    const json keys = report(folder, {"animate", "base.ply", "--keys", "keys.csv", "-o", "keys.glb"});
    CHECK(keys["frames"] == 25);
    CHECK(keys["seconds"] == 1);
    CHECK(end_of(folder, "keys.glb") == doctest::Approx(1));
}
