// SPDX-License-Identifier: MIT
#include "cache.hpp"

#include <goffer/mesh/mesh.hpp>

#include <doctest/doctest.h>

#include <chrono>
#include <cstdint>
#include <cstring>
#include <future>
#include <set>
#include <thread>

/// What is read is not written, whichever word names it; and what the cache keeps is kept.

using namespace goffer;
using namespace goffer::test;

namespace {

/// Makes m.obj, with materials of that name, which have a texture of that name.
void make_textured(const Folder& folder, const std::string& materials, const std::string& texture) {
    base(folder, "base.obj");
    folder.write("m.obj", "mtllib " + materials + "\nusemtl a\n" + bytes_of(folder / "base.obj"));
    folder.write(materials, "newmtl a\nmap_Kd " + texture + "\n");
    folder.write(texture, "a picture");
}

}  // namespace

TEST_CASE("animate: a report does not replace a frame") {
    const Folder folder;
    base(folder);
    const Words words{"animate", "base.ply", "--swing", "9", "--frames", "3", "-o", "f%d.ply", "--json"};
    refused(folder, 2, words + Words{"f1.ply"}, {"-o", "f%d.ply", "--json"});
    refused(folder, 2, words + Words{"f77.ply"}, {"-o", "f%d.ply", "--json"});
    CHECK(!std::filesystem::exists(folder / "f1.ply"));
    well(folder, words + Words{"f.json"});
}

TEST_CASE("cache: a report replaces nothing that the cache is made from or consists of") {
    const Folder folder;
    write(folder, scene_in(folder));
    const std::string worm = bytes_of(folder / "worm.ply");
    for (const std::string file : {"worm.ply", "keys.csv", "scene.json", "./worm.ply"})
        refused(folder, 2, cache_words("cache", {"--json", file}), {"--json", "replace"});
    CHECK(bytes_of(folder / "worm.ply") == worm);
    well(folder, cache_words("cache", {"--json", "cache.json"}));
    const auto whole = files_in(folder / "cache");
    refused(folder, 2, cache_words("cache", {"--json", "cache/report.json"}),
            {"--json", "folder of the cache"});
    refused(folder, 2, {"cache", "--verify", "cache", "--json", "cache/plan.json"}, {"--json", "folder"});
    const Words extract{"cache", "--extract", "0,0", "cache", "-o"};
    refused(folder, 2, extract + Words{"cache/bodies/worm.ply"}, {"-o", "folder"});
    refused(folder, 2, extract + Words{"y.ply", "--json", "y.ply"}, {"--json", "-o"});
    well(folder, extract + Words{"y.ply", "--json", "y.json"});
    CHECK(files_in(folder / "cache") == whole);
}

TEST_CASE("cache: a plan names large files so that it can be read again") {
    const Folder folder;
    const nlohmann::json scene = scene_in(folder);
    write(folder, scene);
    // Comments make the model's file large, and its bytes are read by no means slowly.
    well(folder, {"bend", "worm.ply", "--angle", "0", "-o", "worm.obj"});
    std::string text = bytes_of(folder / "worm.obj");
    const std::string comment = "#" + std::string(1 << 20, '-') + "\n";
    for (int i = 0; i < 65; ++i) text += comment;
    folder.write("worm.obj", text);
    nlohmann::json large = scene;
    large["bodies"]["worm"]["file"] = (folder / "worm.obj").string();
    write(folder, large);
    const Words words = cache_words("cache", {"--allow-outside", "--prepare"});
    well(folder, words);
    well(folder, words);
    const auto plan = nlohmann::json::parse(bytes_of(folder / "cache" / "plan.json"));
    REQUIRE(plan["files"].size() == 1);
    CHECK(plan["files"][0]["file"] == (folder / "worm.obj").string());
}

TEST_CASE("cache: members that are there twice, and shards of no bytes") {
    const Folder folder;
    nlohmann::json scene = scene_in(folder);
    std::string text = scene.dump();
    text.insert(1, "\"frames\": 2, ");
    folder.write("scene.json", text);
    refused(folder, 1, cache_words("cache"), {"scene.json", "'frames' twice"});
    write(folder, scene);
    refused(folder, 2, cache_words("cache", {"--shard-size", "0"}), {"--shard-size"});
    folder.write("keys.json", R"({"keys": [{"time": 0, "angle": 0, "angle": 9}, {"time": 1, "angle": 3}]})");
    refused(folder, 1, {"animate", "worm.ply", "--keys", "keys.json", "-o", "a.mdd"},
            {"keys.json", "'angle' twice"});
}

TEST_CASE("cache: poses beyond what a body can are counted in every format") {
    const Folder folder;
    nlohmann::json scene = scene_in(folder);
    scene["motions"]["sway"] = {{"swing", 3000}, {"seconds", 2}};
    write(folder, scene);
    std::set<std::string> warnings;
    for (const std::string format : {"positions", "packed", "poses"}) {
        const Result result = run(folder, cache_words(format, {"--format", format}));
        CHECK(result.code == 0);
        const std::size_t at = result.err.find("times an instance was to be bent further");
        REQUIRE(at != std::string::npos);
        warnings.insert(result.err);
    }
    CHECK(warnings.size() == 1);
}

TEST_CASE("cache: what an earlier plan had is removed, and noticed before") {
    const Folder folder;
    nlohmann::json scene = scene_in(folder);
    write(folder, scene);
    well(folder, cache_words("cache", small_shards));
    folder.write("cache/bodies/old.goffer", "a body of no plan");
    CHECK(run(folder, {"cache", "--verify", "cache"}).err.find("1 fault") != std::string::npos);
    well(folder, cache_words("cache", small_shards));
    CHECK(!std::filesystem::exists(folder / "cache/bodies/old.goffer"));
    well(folder, {"cache", "--verify", "cache"});
}

TEST_CASE("cache: lists of bodies and motions cost no more than the instances there are") {
    const Folder folder;
    nlohmann::json scene = scene_in(folder);
    scene["instances"] = nlohmann::json::array();
    nlohmann::json entry = {{"translation", {0, 0, 0}}};
    for (int i = 0; i < 20'011; ++i) entry["body"].push_back("worm");
    for (int i = 0; i < 20'021; ++i) entry["motion"].push_back("sway");
    scene["instances"].push_back(entry);
    write(folder, scene);
    well(folder, cache_words("cache"));
}

TEST_CASE("cache: numbers in texts share the memory that is allowed") {
    const Folder folder;
    nlohmann::json scene = scene_in(folder);
    constexpr int count = 3000;
    std::string text;
    for (int i = 0; i < count; ++i) text += "1 0 0 0 1 0 0 0 1 2 2 0\n";
    const nlohmann::json entry = {{"body", "worm"}, {"count", count}, {"transforms", "places.csv"}};
    folder.write("places.csv", text);
    scene["instances"] = nlohmann::json::array({entry});
    write(folder, scene);
    const Words memory{"--prepare", "--max-memory", "500K"};
    well(folder, cache_words("one", memory));
    for (int i = 0; i < 2000; ++i) scene["instances"].push_back(entry);  // one file, once in memory
    scene["instances"][0]["count"] = count;
    write(folder, scene);
    well(folder, cache_words("many", memory));
    folder.write("other.csv", text);
    folder.write("third.csv", text);
    for (const std::string file : {"other.csv", "third.csv"}) {
        scene["instances"].push_back(entry);
        scene["instances"].back()["transforms"] = file;
    }
    write(folder, scene);
    refused(folder, 1, cache_words("two", memory), {".csv", "--max-memory"});
}

TEST_CASE("animate: a vertex-animation texture keeps the model's texture coordinates") {
    const Folder folder;
    std::filesystem::copy_file(GOFFER_SOURCE_DIR "/tests/data/wine_bottle.glb", folder / "bottle.glb");
    (void)report(folder, {"animate", "bottle.glb", "--swing", "20", "--frames", "3", "--refine", "off", "-o",
                          "b.json"});
    const auto distinct = [](const mesh::Mesh& mesh) {
        std::set<std::pair<float, float>> uvs;
        for (const glm::vec2& uv : mesh::vertex_arrays_with_uvs(mesh).uvs) uvs.insert({uv.x, uv.y});
        return uvs;
    };
    const auto before = distinct(mesh::load(folder / "bottle.glb"));
    CHECK(before.size() > 300);
    CHECK(distinct(mesh::load(folder / "b.mesh.glb")) == before);
}

TEST_CASE("cache: buffers that a glTF names are part of what a cache is made from") {
    const Folder folder;
    nlohmann::json scene = scene_in(folder);
    well(folder, {"bend", "worm.ply", "--angle", "0", "-o", "worm.glb"});
    // Its two chunks as two files, of which one has a name that takes percent signs.
    const std::string glb = bytes_of(folder / "worm.glb");
    std::uint32_t length = 0;
    std::memcpy(&length, &glb[12], sizeof length);
    auto document = nlohmann::json::parse(glb.substr(20, length));
    const std::string bytes = glb.substr(20 + length + 8);
    document["buffers"][0]["uri"] = "my%20buffer.bin";
    for (const std::string name : {"named.gltf", "named.GLTF"}) {
        folder.write("my buffer.bin", bytes);
        folder.write(name, document.dump());
        scene["bodies"]["worm"]["file"] = name;
        write(folder, scene);
        refused(folder, 2, cache_words("cache", {"--json", "my buffer.bin"}), {"--json", "replace"});
        CHECK(report(folder, cache_words("cache"))["baked"] == 1);
        CHECK(report(folder, cache_words("cache"))["baked"] == 0);
        std::string other = bytes;
        other[other.size() / 2] ^= 1;  // another number in the middle of the buffer
        folder.write("my buffer.bin", other);
        CHECK(report(folder, cache_words("cache"))["baked"] == 1);
    }
    refused(folder, 2, {"bend", "named.gltf", "--angle", "9", "-o", "b.ply", "--json", "my buffer.bin"},
            {"--json", "replace"});
}

TEST_CASE("materials and textures of a model are no place for an output") {
    const Folder folder;
    make_textured(folder, "m.mtl", "t.png");
    const Words bend{"bend", "m.obj", "--angle", "9", "-o", "b.glb"};
    refused(folder, 2, bend + Words{"--json", "m.mtl"}, {"--json", "replace"});
    refused(folder, 2, bend + Words{"--png", "t.png"}, {"--png", "replace"});
    refused(folder, 2, {"bake", "m.obj", "-o", "t.png"}, {"-o", "replace"});
    // A model is told by its content.
    std::filesystem::copy_file(folder / "m.obj", folder / "m.txt");
    const Words text{"bend", "m.txt", "--angle", "9", "-o", "b.glb"};
    refused(folder, 2, text + Words{"--json", "m.mtl"}, {"--json", "replace"});
    refused(folder, 2, text + Words{"--png", "t.png"}, {"--png", "replace"});
    CHECK(bytes_of(folder / "t.png") == "a picture");
}

TEST_CASE("files that a model names are looked for with the memory that it may take") {
    const Folder folder;
    well(folder, {"base", "--length", "10", "--radius", "1", "-o", "m.gltf"});
    auto model = nlohmann::json::parse(bytes_of(folder / "m.gltf"));
    model["images"] = {{{"uri", "t.png"}}};
    model["extras"] = std::vector<int>(200'000);
    folder.write("m.gltf", model.dump());
    folder.write("t.png", "a picture");
    const Words bend{"bend", "m.gltf", "--angle", "9", "-o", "b.glb", "--png", "t.png", "--max-memory"};
    refused(folder, 1, bend + Words{"4M"}, {"m.gltf", "--max-memory"});
    refused(folder, 2, bend + Words{"1G"}, {"--png", "replace"});
}

TEST_CASE("animate: a sequence replaces nothing that its model names, and no report its materials") {
    const Folder folder;
    make_textured(folder, "m_2.mtl", "m_0001.png");
    const Words animate{"animate", "m.obj", "--swing", "9", "--frames", "2", "-o"};
    refused(folder, 2, animate + Words{"m_%04d.png"}, {"-o", "replace", "MODEL"});
    refused(folder, 2, animate + Words{"m_%d.obj"}, {"-o", "replace", "MODEL"});
    refused(folder, 2, animate + Words{"f_%d.obj", "--json", "f_2.mtl"}, {"-o", "replace", "--json"});
    CHECK(bytes_of(folder / "m_0001.png") == "a picture");
    well(folder, animate + Words{"m_%d.ply"});
    std::filesystem::rename(folder / "m_2.ply", folder / "kept.ply");
    const std::string kept = bytes_of(folder / "kept.ply");
    const Words again{"animate", "kept.ply", "--swing", "9", "--frames", "2", "-o"};
    std::filesystem::create_symlink("k_1.ply", folder / "latest.ply");
    CHECK(run(folder, again + Words{"k_%d.ply"}).code == 0);  // a link to a frame is no frame
    std::filesystem::create_symlink("kept.ply", folder / "m_2.ply");
    CHECK(run(folder, again + Words{"m_%d.ply"}).err.find("m_2.ply") != std::string::npos);
    std::filesystem::create_symlink("g_1.ply", folder / "report.json");
    CHECK(run(folder, again + Words{"g_%d.ply", "--json", "report.json"}).code == 2);
    std::filesystem::rename(folder / "kept.ply", folder / "g_2.ply");
    std::filesystem::create_symlink("g_2.ply", folder / "kept.ply");
    CHECK(run(folder, again + Words{"g_%d.ply"}).code == 2);
    std::filesystem::create_symlink("m_2.mtl", folder / "h_1.mtl");
    CHECK(run(folder, again + Words{"h_%d.obj"}).err.find("h_1.mtl: is a link") != std::string::npos);
    CHECK(bytes_of(folder / "g_2.ply") == kept);
}

TEST_CASE("two outputs are two files, whatever links lead there") {
    const Folder folder;
    base(folder);
    std::filesystem::create_symlink("out.ply", folder / "report.json");
    const Result result = run(folder, {"bend", "base.ply", "-o", "out.ply", "--json", "report.json"});
    CHECK(result.code == 2);
    CHECK(result.err.find("--json: report.json would replace the file of -o") != std::string::npos);
    CHECK(!std::filesystem::exists(folder / "out.ply"));
}

TEST_CASE("cache: what it is made from does not lie in its folder") {
    const Folder folder;
    nlohmann::json scene = scene_in(folder);
    write(folder, scene);
    well(folder, cache_words("cache"));
    std::filesystem::copy_file(folder / "worm.ply", folder / "cache/shard-000009.gofferc");
    scene["bodies"]["worm"]["file"] = "cache/shard-000009.gofferc";
    write(folder, scene);
    refused(folder, 1, cache_words("cache"),
            {"cache/shard-000009.gofferc", "lies in the folder of the cache"});
}

TEST_CASE("cache: whichever way leads to the scene's folder, the cache is the same") {
    const Folder folder;
    nlohmann::json scene = scene_in(folder);
    scene["bodies"]["snake"]["file"] = (folder / "worm.ply").string();
    write(folder, scene);
    const std::string whole = (folder / "scene.json").string();
    CHECK(report(folder, cache_words("cache", {"--allow-outside"}))["baked"] == 1);
    CHECK(report(folder, {"cache", whole, "-o", "cache", "--allow-outside"})["baked"] == 0);
}

TEST_CASE("cache: without its plan, a cache is as its manifest says, and without both it is not guessed") {
    const Folder folder;
    write(folder, scene_in(folder));
    well(folder, cache_words("cache", small_shards + Words{"--format", "poses"}));
    const auto whole = files_in(folder / "cache");
    std::filesystem::remove(folder / "cache/plan.json");
    CHECK(run(folder, {"cache", "--verify", "cache"}).err.find("1 fault") != std::string::npos);
    CHECK(report(folder, cache_words("cache"))["baked"] == 0);
    CHECK(files_in(folder / "cache") == whole);
    std::filesystem::remove(folder / "cache/plan.json");
    std::filesystem::remove(folder / "cache/manifest.json");
    refused(folder, 1, cache_words("cache"), {"cache", "--format"});
}

TEST_CASE("cache: a manifest or a plan that says something else is found") {
    const Folder folder;
    write(folder, scene_in(folder));
    well(folder, cache_words("cache", small_shards));
    const auto change = [&](const std::string& name, const std::string& from, const std::string& to) {
        const std::string text = bytes_of(folder / name);
        std::string changed = text;
        const std::size_t at = changed.find(from);
        REQUIRE(at != std::string::npos);
        folder.write(name, changed.replace(at, from.size(), to));
        CHECK(run(folder, {"cache", "--verify", "cache"}).code == 1);
        folder.write(name, text);
    };
    for (const std::string name : {"cache/manifest.json", "cache/plan.json"}) {
        change(name, "\"fps\": 24", "\"fps\": 25");
        change(name, "\"vertices\": 136", "\"vertices\": 135");
    }
    change("cache/manifest.json", "bodies/worm.goffer", "bodies/warm.goffer");
    well(folder, {"cache", "--verify", "cache"});
}

TEST_CASE("cache: what is made anew is said, and a share makes nothing anew") {
    const Folder folder;
    nlohmann::json scene = scene_in(folder);
    write(folder, scene);
    well(folder, cache_words("cache", small_shards));
    const auto whole = files_in(folder / "cache");
    refused(folder, 1, cache_words("cache", {"--shard", "1/2", "--format", "poses"}),
            {"another cache", "format was positions", "--prepare"});
    scene["fps"] = 25;
    write(folder, scene);
    refused(folder, 1, cache_words("cache", {"--shard", "1/2"}), {"another cache", "scene"});
    CHECK(files_in(folder / "cache") == whole);
    const Result anew = run(folder, cache_words("cache", {"--format", "poses"}));
    CHECK(anew.code == 0);
    CHECK(anew.err.find("format was positions, and is poses") != std::string::npos);
    CHECK(anew.err.find("its scene") != std::string::npos);
    well(folder, cache_words("cache"));
}

TEST_CASE("cache: a file that changes while a cache is baked ends the run") {
    const Folder folder;
    nlohmann::json scene = scene_in(folder);
    scene["frames"] = 20'000;
    write(folder, scene);
    const Words words = cache_words("cache", {"--shard-frames", "10"});
    std::future<Result> baking = std::async(std::launch::async, [&] { return run(folder, words); });
    const auto start = std::chrono::steady_clock::now();
    while (!std::filesystem::exists(folder / "cache/shard-000001.gofferc") &&
           std::chrono::steady_clock::now() - start < std::chrono::seconds(60))
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const auto before = std::filesystem::last_write_time(folder / "keys.csv");
    std::filesystem::last_write_time(folder / "keys.csv", before + std::chrono::seconds(9));
    const Result result = baking.get();
    CHECK(result.code == 1);
    CHECK(result.err.find("keys.csv: has changed") != std::string::npos);
    CHECK(!std::filesystem::exists(folder / "cache/manifest.json"));
    CHECK(!std::filesystem::exists(folder / "cache/shard-001999.gofferc"));
}
