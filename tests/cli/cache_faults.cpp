// SPDX-License-Identifier: MIT
#include "cache.hpp"
#include "support/rounds.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

/// `goffer cache`, given what is no scene, no plan, no manifest or no shard: one line, and nothing is
/// written.

using namespace goffer::test;

namespace {

/// The scene with one member changed.
nlohmann::json with(nlohmann::json scene, const std::string& place, const nlohmann::json& value) {
    scene[nlohmann::json::json_pointer(place)] = value;
    return scene;
}

}  // namespace

TEST_CASE("cache: scenes that are none") {
    const Folder folder;
    const nlohmann::json good = scene_in(folder);
    const auto refuse = [&](const std::string& place, const nlohmann::json& value, const Words& pieces) {
        CAPTURE(place);
        write(folder, with(good, place, value));
        refused(folder, 1, cache_words("cache"), pieces);
    };
    refuse("/version", 2, {"version", "1..1"});
    refuse("/fps", 0, {"fps"});
    refuse("/fps", "fast", {"fps"});
    refuse("/frames", 0, {"frames", "1..1000000"});
    refuse("/frames", 1e300, {"frames"});
    refuse("/frames", 2.5, {"frames", "whole number"});
    refuse("/frames", -1.0, {"frames"});
    refuse("/wind", 1, {"'wind'", "instances"});
    refuse("/bodies", nlohmann::json::object(), {"bodies", "none"});
    refuse("/bodies/worm/file", "none.ply", {"none.ply"});
    refuse("/bodies/worm/file", "../worm.ply", {"bodies.worm.file", "--allow-outside"});
    refuse("/bodies/worm/folds", "many", {"bodies.worm", "--folds", "many"});
    refuse("/bodies/worm/foldz", 3, {"bodies.worm.foldz", "not an option"});
    refuse("/bodies/worm/max_memory", "9G", {"bodies.worm.max_memory"});
    refuse("/bodies/worm/allow_outside", true, {"bodies.worm.allow_outside"});
    refuse("/bodies/worm/level", 1, {"bodies.worm.level", "model"});
    refuse("/bodies/a~1b", {{"file", "worm.ply"}}, {"a/b", "letters"});
    refuse("/motions/sway", {{"swing", {1, 2, 3}}, {"seconds", 1}}, {"motions.sway"});
    refuse("/motions/keys", "../keys.csv", {"motions.keys", "--allow-outside"});
    refuse("/instances", nlohmann::json::array(), {"instances"});
    refuse("/instances/0/body", "bird", {"instances[0].body", "bird"});
    refuse("/instances/0/motion", "fly", {"instances[0].motion", "fly"});
    refuse("/instances/0/grid", {4, 0.5}, {"instances[0].grid"});
    refuse("/instances/0/grid", {1e7, 1e7}, {"10000000"});
    refuse("/instances/0/spacing", 3, {"instances[0].spacing"});
    refuse("/instances/0/count", 3, {"instances[0].count", "grid"});
    refuse("/instances/1/count", 3, {"instances[1].count", "transforms"});
    refuse("/instances/1/scale", {1, 2}, {"instances[1].scale"});
    refuse("/instances/1/weight", 2, {"instances[1].weight", "0..1"});
    refuse("/instances/2/rotation", {1, 1, 1, 1}, {"instances[2].rotation", "unit"});
    refuse("/instances/2/transform", {1, 2, 3}, {"instances[2]"});
    refuse("/instances/2/offset", 1, {"instances[2].offset", "motion"});
    refuse("/instances/2/poses", "none.f32", {"none.f32"});
    for (const std::string text : {"", "{", "[]", "{\"version\":1}", "{\"version\":1,\"fps\":24,\"fps\":"}) {
        folder.write("scene.json", text);
        refused(folder, 1, cache_words("cache"), {"scene.json"});
    }
    folder.write("scene.json", std::string(100'000, '['));
    refused(folder, 1, cache_words("cache"), {"scene.json", "deep"});
}

TEST_CASE("cache: columns that do not fit, or are no numbers") {
    const Folder folder;
    nlohmann::json scene = scene_in(folder);
    scene["instances"] = {{{"body", "worm"}, {"poses", "poses.csv"}}};
    write(folder, scene);
    std::string numbers;
    for (int i = 0; i < 18; ++i) numbers += "0.5\n";
    folder.write("poses.csv", numbers);
    well(folder, cache_words("good"));
    folder.write("poses.csv", numbers + "1");
    refused(folder, 1, cache_words("cache"), {"poses.csv", "19 numbers", "9 frames x 1 instances"});
    folder.write("poses.csv", "1e-50" + numbers.substr(3));
    well(folder, cache_words("tiny"));
    folder.write("poses.csv", "1e50" + numbers.substr(3));
    const Result huge = run(folder, cache_words("huge"));
    CHECK(huge.code == 1);
    CHECK(huge.err.find("poses.csv: '1e50', after 0 numbers, is more than a 32-bit float holds") !=
          std::string::npos);
    folder.write("poses.csv", numbers + "one");
    refused(folder, 1, cache_words("cache"), {"poses.csv", "'one'"});
    scene["instances"][0]["poses"] = "poses.f32";
    write(folder, scene);
    folder.write("poses.f32", "12345");
    refused(folder, 1, cache_words("cache"), {"poses.f32", "5 bytes"});
    std::string bytes(18 * 4, '\0');
    scene["instances"][0]["transforms"] = "far.csv";
    scene["instances"][0]["scale"] = 1e10;
    write(folder, scene);
    folder.write("poses.f32", bytes);
    folder.write("far.csv", "1,0,0 0,1,0 0,0,1e9 0,0,0");
    for (const std::string format : {"positions", "poses"}) {
        const Result far = run(folder, cache_words("far", {"--format", format}));
        CHECK(far.code == 1);
        CHECK(far.err.find("instances[0]: number 0 of it") != std::string::npos);
    }
    scene["instances"][0].erase("transforms");
    write(folder, scene);
    bytes[4 * 7 + 3] = '\x7f', bytes[4 * 7 + 2] = '\x80';  // infinity
    folder.write("poses.f32", bytes);
    const Result result = run(folder, cache_words("cache"));
    CHECK(result.code == 1);
    CHECK(result.err.find("number 7") != std::string::npos);
    CHECK(files_in(folder / "cache").count("shard-000000.gofferc") == 0);
}

TEST_CASE("cache: folders and words that are none") {
    const Folder folder;
    write(folder, scene_in(folder));
    folder.write("file", "kept");
    std::filesystem::create_directory(folder / "other");
    folder.write("other/letter.txt", "kept");
    refused(folder, 1, cache_words("file"), {"file", "not a folder"});
    refused(folder, 1, cache_words("other"), {"other", "letter.txt"});
    std::filesystem::create_directories(folder / "linked/bodies");
    std::filesystem::create_symlink(folder / "file", folder / "linked/bodies/worm.goffer");
    refused(folder, 1, cache_words("linked"), {"linked/bodies/worm.goffer", "not a file of a cache"});
    refused(folder, 2, {"cache", "scene.json"}, {"-o"});
    for (const std::string share : {"0/3", "4/3", "3", "1/0", "a/b", "-1/3", "1/3x", ""})
        refused(folder, 2, cache_words("cache", {"--shard", share}), {"--shard"});
    refused(folder, 2, cache_words("cache", {"--format", "small"}), {"--format", "small"});
    refused(folder, 2, cache_words("cache", {"--isa", "mmx"}), {"--isa", "mmx"});
    refused(folder, 2, cache_words("cache", {"--shard-size", "big"}), {"--shard-size", "big"});
    refused(folder, 2, cache_words("cache", {"--shard-frames", "0"}), {"--shard-frames"});
    refused(folder, 2, cache_words("cache", {"--prepare", "--shard", "1/2"}), {"--shard", "--prepare"});
    refused(folder, 2, {"cache", "--verify", "x", "--format", "poses"}, {"--format", "--verify"});
    refused(folder, 2, {"cache", "--extract", "1", "-o", "a.ply", "x"}, {"--extract", "'1'"});
    refused(folder, 1, {"cache", "--verify", "x"}, {"x: there is no such folder"});
    refused(folder, 1, {"cache", "--verify", "."}, {"manifest.json"});
    refused(folder, 1, {"cache", "--extract", "1,1", "-o", "a.ply", "x"}, {"x: there is no such folder"});
    std::filesystem::create_directory(folder / "empty");
    refused(folder, 1, {"cache", "--extract", "1,1", "-o", "a.ply", "empty"}, {"plan.json"});
    refused(folder, 1, {"cache", "--verify", "scene.json"}, {"scene.json: is not a folder"});
    refused(folder, 2, cache_words("scene.json"), {"scene.json"});
}

TEST_CASE("cache: damaged plans, manifests and shards end in one line") {
    const Folder folder(quick_place());
    write(folder, scene_in(folder));
    well(folder, cache_words("cache", small_shards));
    const auto whole = files_in(folder / "cache");
    refused(folder, 1, {"cache", "--extract", "9,0", "-o", "a.ply", "cache"}, {"0..8", "0..13"});
    std::mt19937 random(7);
    const auto below = [&](std::size_t end) { return random() % end; };
    for (int round = 0; round < rounds(120, 24); ++round) {
        const std::string name = round % 3 == 0   ? "plan.json"
                                 : round % 3 == 1 ? "manifest.json"
                                                  : "shard-000000.gofferc";
        std::string bytes = whole.at(name);
        if (round % 4 == 0) bytes.resize(below(bytes.size()));
        for (std::size_t i = 0; i < 3 && !bytes.empty(); ++i)
            bytes[below(std::min<std::size_t>(bytes.size(), 2000))] = static_cast<char>(random());
        folder.write("cache/" + name, bytes);
        for (const Words& words : {Words{"cache", "--verify", "cache"},
                                   Words{"cache", "--extract", "0,0", "-o", "a.ply", "cache"}}) {
            const Result result = run(folder, words);
            CAPTURE(result.err);
            CHECK(result.code <= 1);
            CHECK(std::ranges::count(result.err, '\n') == result.code);
        }
        folder.write("cache/" + name, whole.at(name));
    }
    // A plan that is damaged holds choices that nobody else knows. Where it is removed it is made anew, and
    // the shards are as they were.
    for (const std::string plan : {"{}", "", "{\"kind\": \"goffer cache\", \"version\": 2}"}) {
        folder.write("cache/plan.json", plan);
        refused(folder, 1, cache_words("cache", small_shards), {"plan.json", "remove that file"});
    }
    std::filesystem::remove(folder / "cache" / "plan.json");
    CHECK(report(folder, cache_words("cache", small_shards))["baked"] == 0);
    CHECK(files_in(folder / "cache") == whole);
}
