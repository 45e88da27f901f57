// SPDX-License-Identifier: MIT
#include "bars.hpp"
#include "follow.hpp"
#include "mesh/gltf_files.hpp"
#include "mesh/gltf_valid.hpp"

#include <limits>

using namespace goffer;
using namespace goffer::test;

namespace {

constexpr std::size_t frame_count = 40;

/// Two frames, the second of which is larger.
MadeFrames growing(const mesh::Mesh& mesh) {
    return {mesh, 2, [](std::size_t frame, const glm::vec3&, bool, const glm::vec3& v) {
                return v * (1.0f + static_cast<float>(frame));
            }};
}

MadeFrames walking(const mesh::Mesh& mesh) {
    return {mesh, frame_count, bending, circling};
}

/// Writes the clip, and checks it: every frame, and with Khronos' validator, which must not warn either.
clip::GltfReport check_clip(const mesh::Mesh& mesh, clip::Frames& frames) {
    const Folder folder;
    clip::GltfReport report = saved_clip(mesh, frames, folder / "clip.glb");
    CHECK(report.within());
    CHECK(report.max_error <= clip::GltfOptions{}.max_error * report.size);
    check_follows(folder / "clip.glb", mesh, frames, report);
    (void)saved_clip(mesh, frames, folder / "clip.gltf");
    check_valid({folder / "clip.glb", folder / "clip.gltf"}, true);
    return report;
}

mesh::Mesh read_again(const char* name) {
    return reloaded(bar(), name);
}

void check_source(const char* name) {
    const mesh::Mesh mesh = read_again(name);
    MadeFrames frames = walking(mesh);
    const clip::GltfReport report = check_clip(mesh, frames);
    CHECK(report.warnings.empty());
    CHECK(report.targets < 12);
    CHECK_FALSE(report.exact);
}

/// The tetrahedron twice, placed, scaled, sheared and mirrored, in one mesh entry, with an animation of its
/// own.
Document placed_twice() {
    Document document = tetra_with_nodes(R"([
        {"name": "root", "children": [1, 2], "scale": [2, 1, 0.5], "translation": [1, 2, 3]},
        {"name": "a", "mesh": 0, "rotation": [0.1, 0.2, 0.3, 0.9273618495495704], "translation": [5, 0, 0]},
        {"name": "b", "mesh": 0, "scale": [-1, 1, 1], "rotation": [0, 0.6, 0, 0.8]}])");
    const std::size_t times = document.floats({0, 1}, "SCALAR"),
                      turns = document.floats({0, 0, 0, 1, 0, 1, 0, 0}, "VEC4");
    Json animation =
        Json::parse(R"({"channels": [{"sampler": 0, "target": {"node": 1, "path": "rotation"}}]})");
    animation["samplers"].push_back({{"input", times}, {"output", turns}});
    document.json["animations"].push_back(animation);
    return document;
}

/// A skinned tetrahedron under a node that is elsewhere, which counts for nothing.
Document skinned() {
    Document document = tetra_with_nodes(
        R"([{"name": "a", "mesh": 0, "skin": 0, "translation": [9, 9, 9]}, {"name": "joint", "translation": [1, 2, 3], "scale": [2, 2, 2]}])");
    document.json["scenes"][0]["nodes"] = {0, 1};
    document.json["skins"] = Json::parse(R"([{"joints": [1]}])");
    const std::size_t joints =
        document.accessor(document.view(raw(std::vector<std::uint8_t>(16, 0))), 5121, "VEC4", 4);
    const std::size_t weights = document.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    primitive_of(document)["attributes"]["JOINTS_0"] = joints;
    primitive_of(document)["attributes"]["WEIGHTS_0"] = weights;
    return document;
}

}  // namespace

TEST_CASE("clip: an OBJ whose normals have indices, with two parts") {
    check_source("bar.obj");
}

TEST_CASE("clip: a PLY") {
    check_source("bar.ply");
}

TEST_CASE("clip: an STL") {
    check_source("bar.stl");
}

TEST_CASE("clip: a GLB of several primitives with the same vertices") {
    check_source("bar.glb");
}

TEST_CASE("clip: a mesh made in memory, without normals") {
    mesh::Mesh mesh = bar();
    mesh.normals = {};
    MadeFrames frames = walking(mesh);
    const clip::GltfReport report = check_clip(mesh, frames);
    CHECK(report.max_angle == 0);
}

TEST_CASE("clip: nodes that share a mesh, are scaled, sheared and mirrored, and move on their own") {
    const mesh::Mesh mesh = load_document(placed_twice());
    MadeFrames frames = walking(mesh);
    const clip::GltfReport report = check_clip(mesh, frames);
    REQUIRE(report.warnings.size() == 1);
    CHECK(report.warnings[0].find("animations") != std::string::npos);
}

TEST_CASE("clip: a file's own animation does not go on where nothing else moves") {
    const mesh::Mesh mesh = load_document(placed_twice());
    MadeFrames frames(mesh, 5, [](std::size_t, const glm::vec3&, bool, const glm::vec3& v) { return v; });
    const Folder folder;
    const std::vector<std::string> warnings = saved_clip(mesh, frames, folder / "clip.glb").warnings;
    REQUIRE(warnings.size() == 2);
    CHECK(warnings[0].find("animations are left out") != std::string::npos);
    CHECK(warnings[1] == "nothing moves: the file has no animation");
    CHECK_FALSE(Player(bytes_of(folder / "clip.glb")).json.contains("animations"));
}

TEST_CASE("clip: primitives of one mesh with vertices of their own, one of them without normals") {
    Document document = placed_twice();
    Json second = primitive_of(document);
    second["attributes"] = {{"POSITION", document.floats({1, 1, 1, 4, 1, 1, 1, 3, 1, 1, 1, 6}, "VEC3")}};
    document.json["meshes"][0]["primitives"].push_back(second);
    const mesh::Mesh mesh = load_document(document);
    MadeFrames frames = walking(mesh);
    (void)check_clip(mesh, frames);
}

TEST_CASE("clip: a skin is left out, with a warning, and its mesh stands where it was bound") {
    const mesh::Mesh mesh = load_document(skinned());
    MadeFrames frames = walking(mesh);
    const clip::GltfReport report = check_clip(mesh, frames);
    REQUIRE(report.warnings.size() == 1);
    CHECK(report.warnings[0].find("skins") != std::string::npos);
}

TEST_CASE("clip: a skinned mesh whose joints shear it stands so without a matrix that does") {
    for (const double across : {2.0, -2.0}) {  // a mirror, too
        Document document = skinned();
        document.json["nodes"] = Json::parse(
            R"([{"mesh": 0, "skin": 0}, {"children": [2], "translation": [5, -1, 2]}, {"rotation": [0.1, 0.3, 0.2, 0.9273618495495704]}])");
        document.json["nodes"][1]["scale"] = {1, across, 0.5};
        document.json["skins"][0]["joints"] = {2};
        const mesh::Mesh mesh = load_document(document);
        MadeFrames frames = walking(mesh);
        (void)check_clip(mesh, frames);
        MadeFrames two = growing(mesh);
        const Folder folder;
        (void)saved_clip(mesh, two, folder / "clip.glb");
        const Player player(bytes_of(folder / "clip.glb"));
        REQUIRE(player.json["nodes"].size() == 5);
        for (const auto& node : player.json["nodes"]) CHECK_FALSE(node.contains("matrix"));
        const mesh::Mesh back = mesh::load(folder / "clip.glb");
        REQUIRE(back.positions.size() == mesh.positions.size());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            CHECK(glm::length(back.positions[i] - mesh.positions[i]) < 1e-5f);
    }
}

TEST_CASE("clip: a skinned mesh is in all scenes that showed it, and once where there was none") {
    Document two = skinned();
    two.json["nodes"].push_back({{"children", {0}}});
    two.json["scenes"] = Json::parse(R"([{"nodes": [2, 1]}, {"nodes": [1]}, {"nodes": [1, 2]}])");
    Document none = skinned();
    none.json.erase("scene");
    none.json.erase("scenes");
    const auto scenes_of = [](const Document& document) {
        const mesh::Mesh mesh = load_document(document);
        MadeFrames frames = growing(mesh);
        const Folder folder;
        (void)saved_clip(mesh, frames, folder / "clip.glb");
        CHECK(mesh::load(folder / "clip.glb").positions == mesh.positions);
        const Player player(bytes_of(folder / "clip.glb"));
        std::vector<std::vector<int>> scenes;
        for (const auto& scene : player.json["scenes"]) scenes.push_back(scene["nodes"]);
        return scenes;
    };
    CHECK(scenes_of(two) == std::vector<std::vector<int>>{{2, 1, 4}, {1}, {1, 2, 4}});
    CHECK(scenes_of(none) == std::vector<std::vector<int>>{{0, 1, 3}});
}

TEST_CASE("clip: instances of one mesh take time in proportion to their number") {
    Document document = skinned();
    Json& nodes = document.json["nodes"];
    for (int i = 0; i < 20'000; ++i) {
        nodes.push_back(nodes[0]);
        document.json["scenes"][0]["nodes"].push_back(2 + i);
    }
    const mesh::Mesh mesh = load_document(document);
    MadeFrames frames = growing(mesh);
    const Folder folder;
    const auto start = std::chrono::steady_clock::now();
    (void)saved_clip(mesh, frames, folder / "clip.glb");
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    MESSAGE(seconds << " s");
    CHECK(seconds < 10);  // some two; with their square, 20
}

TEST_CASE("clip: morph targets of the file's own are left out, with a warning") {
    Document document = tetra();
    Json target = {{"POSITION", document.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}};
    primitive_of(document)["targets"].push_back(target);
    document.json["meshes"][0]["weights"] = {0.5};
    document.json["nodes"][0]["weights"] = {0.25};
    const mesh::Mesh mesh = load_document(document);
    MadeFrames frames = walking(mesh);
    const clip::GltfReport report = check_clip(mesh, frames);
    REQUIRE(report.warnings.size() == 1);
    CHECK(report.warnings[0].find("morph targets") != std::string::npos);
}

TEST_CASE("clip: data of motion that is left out are left out, too, unless an extension may number them") {
    const auto saved = [](const Document& document) {
        const mesh::Mesh mesh = load_document(document);
        MadeFrames frames = walking(mesh);
        const Folder folder;
        (void)saved_clip(mesh, frames, folder / "clip.glb");
        return Player(bytes_of(folder / "clip.glb"));
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Document document = skinned();
    document.json["nodes"][1] = {{"name", "joint"}};  // the mesh stands as the file has it
    const Document skinned_only = document;
    const std::size_t times = document.floats({0, 1}, "SCALAR"),
                      moves = document.floats({0, nan, 0, 0, 0, 1}, "VEC3"),
                      shifts = document.floats(std::vector<float>(12, nan), "VEC3");
    document.json["animations"] =
        Json::parse(R"([{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}])");
    document.json["animations"][0]["samplers"].push_back({{"input", times}, {"output", moves}});
    primitive_of(document)["targets"].push_back({{"POSITION", shifts}});
    const Player own = saved(document), plain = saved(tetra());
    for (const Player& player : {own, saved(skinned_only)}) {
        CHECK(player.bin == plain.bin);
        CHECK(player.json["accessors"] == plain.json["accessors"]);
        CHECK(player.json["bufferViews"] == plain.json["bufferViews"]);
        CHECK(player.json["meshes"][0]["primitives"] == plain.json["meshes"][0]["primitives"]);
    }
    const Json pointer = "/accessors/" + std::to_string(moves);
    for (const auto& [name, number] : {std::pair<std::string, Json>{"EXT_of_somebody", moves},
                                       {"KHR_lights_ies", moves},
                                       {"EXT_of_somebody", pointer}}) {
        Document known = document;
        known.json["extensions"][name] = {{"accessor", number}};
        const Player kept = saved(known);
        CHECK(kept.json["accessors"].size() > plain.json["accessors"].size());
        CHECK(kept.bin.size() > plain.bin.size());
    }
    Document lit = document;
    lit.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(R"([{"intensity": 2}])");
    CHECK(saved(lit).bin == plain.bin);
}

TEST_CASE("clip: what a GLB holds beside the moved mesh is kept") {
    Document document = placed_twice();
    document.json["materials"] = Json::parse(R"([{"name": "skin", "extras": {"tag": 7}}])");
    primitive_of(document)["material"] = 0;
    const mesh::Mesh mesh = load_document(document);
    MadeFrames frames = walking(mesh);
    const Folder folder;
    (void)saved_clip(mesh, frames, folder / "clip.glb");
    const Player player(bytes_of(folder / "clip.glb"));
    CHECK(player.json["materials"][0]["extras"]["tag"] == 7);
    for (const auto& of : player.json["meshes"]) {
        CHECK(of["name"] == "tetra");
        CHECK(of["primitives"][0]["attributes"].size() == 4);
        CHECK(of["primitives"][0]["material"] == 0);
    }
    for (std::size_t i = 0; i < 4; ++i) CHECK(player.json["accessors"][i]["count"] == 4);
}

TEST_CASE("clip: a glTF's buffer is that of a GLB") {
    const mesh::Mesh mesh = bar();
    MadeFrames frames = walking(mesh);
    const Folder folder;
    (void)saved_clip(mesh, frames, folder / "clip.glb");
    (void)saved_clip(mesh, frames, folder / "clip.gltf");
    const Document glb = opened(bytes_of(folder / "clip.glb"));
    const Json gltf = Json::parse(bytes_of(folder / "clip.gltf"));
    CHECK(gltf["buffers"][0]["uri"] == "data:application/octet-stream;base64," + base64(glb.buffer));
    CHECK(gltf["accessors"] == glb.json["accessors"]);
    CHECK(gltf["animations"] == glb.json["animations"]);
}
