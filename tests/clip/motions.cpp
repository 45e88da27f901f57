// SPDX-License-Identifier: MIT
#include "bars.hpp"
#include "follow.hpp"
#include "mesh/files.hpp"
#include "mesh/gltf_valid.hpp"

#include <limits>

using namespace goffer;
using namespace goffer::test;

namespace {

glm::vec3 still(std::size_t, const glm::vec3&, bool, const glm::vec3& value) {
    return value;
}

/// Two shapes of which every frame is a blend, with normals that stay.
glm::vec3 two_shapes(std::size_t frame, const glm::vec3& position, bool is_normal, const glm::vec3& value) {
    const auto t = static_cast<float>(frame);
    if (is_normal) return value;
    return value + std::sin(0.2f * t) * glm::vec3(0, 0.1f * position.z, 0) +
           std::cos(0.5f * t) * glm::vec3(0.01f * position.z * position.z, 0, 0.5f * position.x);
}

/// What is written of `frames`, which must be valid and follow them.
Player written(const mesh::Mesh& mesh, clip::Frames& frames, clip::GltfReport& report,
               const clip::GltfOptions& options = {}) {
    const Folder folder;
    report = saved_clip(mesh, frames, folder / "clip.glb", options);
    check_follows(folder / "clip.glb", mesh, frames, report);
    check_valid({folder / "clip.glb"}, true);
    return Player(bytes_of(folder / "clip.glb"));
}

std::string refusal(const mesh::Mesh& mesh, clip::Frames& frames, const clip::GltfOptions& options = {},
                    const char* name = "clip.glb") {
    const Folder folder;
    const std::string message = error_of([&] { (void)saved_clip(mesh, frames, folder / name, options); });
    CHECK(folder.files() == 0);
    return message;
}

bool says(const std::string& message, const char* what) {
    return message.find(what) != message.npos && message.find('\n') == message.npos;
}

}  // namespace

TEST_CASE("clip: without motion there is neither a target nor an animation") {
    const mesh::Mesh mesh = bar();
    MadeFrames frames(mesh, 30, still);
    clip::GltfReport report;
    const Player player = written(mesh, frames, report);
    CHECK(report.targets == 0);
    CHECK(report.max_error == 0);
    CHECK(report.bytes < std::filesystem::file_size(GOFFER_SOURCE_DIR "/tests/data/log_01.glb"));
    CHECK_FALSE(player.json.contains("animations"));
    CHECK(player.json["nodes"].size() == 1);
}

TEST_CASE("clip: a shape that stays is one target, whose two keys keep the clip's length") {
    const mesh::Mesh mesh = bar();
    const auto bent = [](std::size_t, auto&&... rest) { return bending(5, rest...); };
    MadeFrames frames(mesh, 31, bent, [](std::size_t) { return circling(3); });
    clip::GltfReport report;
    const Player player = written(mesh, frames, report);
    CHECK(report.targets == 1);
    CHECK(player.keys() == 2);
    CHECK(player.json["animations"][0]["channels"].size() == 1);
    const auto times = player.floats(player.json["animations"][0]["samplers"][0]["input"]);
    CHECK(times[0] == 0);
    CHECK(times[1] == doctest::Approx(1));
}

TEST_CASE("clip: one frame") {
    const mesh::Mesh mesh = bar();
    MadeFrames frames(mesh, 1, [](std::size_t, auto&&... rest) { return bending(5, rest...); });
    clip::GltfReport report;
    const Player player = written(mesh, frames, report);
    CHECK(report.targets == 1);
    CHECK(report.exact);
    CHECK_FALSE(player.json.contains("animations"));
}

TEST_CASE("clip: one frame at rest is the mesh") {
    const mesh::Mesh mesh = bar();
    MadeFrames frames(mesh, 1, still, circling);
    clip::GltfReport report;
    (void)written(mesh, frames, report);
    CHECK(report.targets == 0);
    CHECK(report.within());
}

TEST_CASE("clip: as near as floats can be") {
    const mesh::Mesh mesh = bar();
    MadeFrames frames(mesh, 100, bending);
    clip::GltfReport report;
    (void)written(mesh, frames, report, {.max_error = 0});
    CHECK(report.within());
    CHECK(report.max_error < 1e-5);
}

TEST_CASE("clip: two frames, which are the targets") {
    const mesh::Mesh mesh = bar();
    MadeFrames frames(
        mesh, 2, [](std::size_t f, auto&&... rest) { return bending(3 + 2 * f, rest...); }, circling);
    clip::GltfReport report;
    const Player player = written(mesh, frames, report);
    CHECK(report.targets == 2);
    CHECK(report.exact);
    CHECK(report.max_error < 1e-6);
    CHECK(player.keys() == 2);
}

TEST_CASE("clip: frames that few shapes make are made of these") {
    const mesh::Mesh mesh = bar(31);
    MadeFrames frames(mesh, 200, two_shapes);
    clip::GltfOptions options;
    options.max_error = 1e-6;
    clip::GltfReport report;
    (void)written(mesh, frames, report, options);
    CHECK(report.targets == 3);  // two, and what these begin with
    CHECK(report.max_error <= 1e-6 * report.size);
    CHECK_FALSE(report.exact);
    options.targets = 100;
    (void)written(mesh, frames, report, options);
    CHECK(report.targets == 3);
}

TEST_CASE("clip: more targets are nearer to the frames, and as many as frames are these") {
    const mesh::Mesh mesh = bar(31);
    MadeFrames frames(mesh, 25, [](std::size_t f, const glm::vec3& p, bool n, const glm::vec3& v) {
        return n ? v : v + glm::vec3(0, std::sin(p.z + 1.7f * static_cast<float>(f * f)), 0) * p.z;
    });
    double before = std::numeric_limits<double>::max();
    for (const std::size_t targets : {1u, 2u, 3u}) {
        clip::GltfOptions options;
        options.targets = targets;
        clip::GltfReport report;
        (void)written(mesh, frames, report, options);
        CHECK(report.targets == targets);
        CHECK(report.max_error < before);
        CHECK(report.within() == (report.max_error <= options.max_error * report.size));
        before = report.max_error;
    }
}

TEST_CASE("clip: vertices that stay take no bytes") {
    const mesh::Mesh mesh = reloaded(bar(101), "bar.glb");
    const auto tip = [](std::size_t f, const glm::vec3& p, bool n, const glm::vec3& v) {
        return p.z < 9 || n ? v : bending(f, p - glm::vec3(0, 0, 9), n, v);
    };
    MadeFrames some(mesh, 50, tip), all(mesh, 50, bending);
    clip::GltfReport few, many;
    const Player player = written(mesh, some, few);
    (void)written(mesh, all, many);
    const auto& target = player.json["meshes"][0]["primitives"][0]["targets"][0];
    CHECK(player.json["accessors"][target["POSITION"].get<std::size_t>()].contains("sparse"));
    CHECK_FALSE(player.json["accessors"][target["NORMAL"].get<std::size_t>()].contains("bufferView"));
    CHECK(few.bytes / few.targets < many.bytes / many.targets);
}

TEST_CASE("clip: weights are from 0 to 1, to which players clamp them, and without them is the rest") {
    const mesh::Mesh mesh = reloaded(bar(), "bar.glb");
    MadeFrames frames(mesh, 60, bending, circling);
    clip::GltfReport report;
    Player player = written(mesh, frames, report);
    for (const auto& channel : player.json["animations"][0]["channels"]) {
        if (channel["target"]["path"] != "weights") continue;
        const auto& sampler = player.json["animations"][0]["samplers"][channel["sampler"].get<std::size_t>()];
        for (const double weight : player.floats(sampler["output"])) {
            CHECK(weight >= 0);
            CHECK(weight <= 1);
        }
    }
    player.json.erase("animations");
    for (auto& of : player.json["meshes"]) of["weights"] = std::vector<double>(report.targets, 0.0);
    for (auto& node : player.json["nodes"])
        for (const char* key : {"translation", "rotation"}) node.erase(key);
    MadeFrames rest(mesh, 1, still);
    CHECK(off_at(player, mesh, rest, 0).distance == 0);
}

TEST_CASE("clip: rotations go the shorter way from key to key") {
    const mesh::Mesh mesh = bar();
    MadeFrames frames(mesh, 60, bending, circling);
    clip::GltfReport report;
    const Player player = written(mesh, frames, report);
    for (const auto& channel : player.json["animations"][0]["channels"]) {
        if (channel["target"]["path"] != "rotation") continue;
        const auto& sampler = player.json["animations"][0]["samplers"][channel["sampler"].get<std::size_t>()];
        const std::vector<double> q = player.floats(sampler["output"]);
        REQUIRE(q.size() == 4 * 60);
        for (std::size_t i = 4; i < q.size(); i += 4) {
            double dot = 0;
            for (std::size_t c = 0; c < 4; ++c) dot += q[i + c] * q[i + c - 4];
            CHECK(dot > 0.9);
        }
    }
}

TEST_CASE("clip: sizes from 1e-30 to 1e30") {
    for (const float size : {1e-30f, 1e-6f, 1e6f, 1e30f}) {
        CAPTURE(size);
        mesh::Mesh mesh = bar();
        for (glm::vec3& p : mesh.positions) p *= size;
        MadeFrames frames(mesh, 20, [&](std::size_t f, const glm::vec3& p, bool n, const glm::vec3& v) {
            return n ? bending(f, p / size, n, v) : size * bending(f, p / size, n, v / size);
        });
        const Folder folder;
        const clip::GltfReport report = saved_clip(mesh, frames, folder / "clip.glb");
        CHECK(report.within());
        CHECK(report.targets < 10);
        check_follows(folder / "clip.glb", mesh, frames, report);
    }
}

TEST_CASE("clip: what cannot be written is refused, and nothing is left of the file") {
    const mesh::Mesh mesh = bar();
    MadeFrames frames(mesh, 10, bending);
    MadeFrames torn(mesh, 10, [](std::size_t f, auto&&... rest) {
        return f == 7 ? glm::vec3(std::nanf("")) : bending(f, rest...);
    });
    CHECK(says(refusal(mesh, torn), "frame 7: vertex 0"));
    MadeFrames other(bar(5), 10, bending);
    CHECK(says(refusal(mesh, other), "entries"));
    CHECK(says(refusal(mesh, frames, {.targets = 0}), "targets"));
    CHECK(says(refusal(mesh, frames, {.max_error = -1}), "max_error"));
    CHECK(says(refusal(mesh, frames, {.max_error = std::numeric_limits<double>::quiet_NaN()}), "max_error"));
    CHECK(says(refusal(mesh, frames, {.memory = 1000}), "allow "));
    CHECK(says(refusal(mesh, frames, {}, "clip.obj"), ".glb"));
}
