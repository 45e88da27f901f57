// SPDX-License-Identifier: MIT
#include "cache.hpp"

#include "support/rounds.hpp"

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/job.hpp>
#include <goffer/mesh/mesh.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numbers>

/// `goffer cache`: the same bits whatever the shares, whatever was there before, and the kernels' own.

using namespace goffer;
using namespace goffer::test;

namespace {

/// Poses of `frames` x `instances` x 1 region, as a game has them, and their file.
std::vector<float> pose_file(const Folder& folder, std::size_t count) {
    std::vector<float> angles;
    for (std::size_t i = 0; i < count; ++i) {
        const double degrees = 5 + 3 * static_cast<double>(i);
        angles.push_back(static_cast<float>(degrees * std::numbers::pi / 180));
        angles.push_back(static_cast<float>(10 * static_cast<double>(i) * std::numbers::pi / 180));
    }
    folder.write("poses.f32", {reinterpret_cast<const char*>(angles.data()), angles.size() * sizeof(float)});
    return angles;
}

/// 3 frames of 2 instances that such a file moves, all of them carried by `transform`.
void write_posed_scene(const Folder& folder, const nlohmann::json& transform) {
    base(folder, "worm.ply", {"--columns", "8", "--rows", "33"});
    folder.write("places.csv", "\xEF\xBB\xBF+1,0,0 0,1,0 0,0,1 0,0,0\n0,1,0 -1,0,0 0,0,1 5,6,7\n");
    const nlohmann::json scene{{"version", 1},
                               {"fps", 24},
                               {"frames", 3.0},  // a whole number all the same
                               {"bodies", {{"worm", {{"file", "worm.ply"}, {"refine", "off"}}}}},
                               {"instances",
                                {{{"body", "worm"},
                                  {"poses", "poses.f32"},
                                  {"count", 2},
                                  {"transforms", "places.csv"},
                                  {"transform", transform}}}}};
    write(folder, scene);
}

}  // namespace

TEST_CASE("cache: the same bits whatever the shares, their order and the threads") {
    const Folder folder;
    write(folder, scene_in(folder));
    for (const std::string format : {"positions", "packed", "poses"}) {
        CAPTURE(format);
        const Words how = small_shards + Words{"--format", format};
        const auto whole = report(folder, cache_words("whole-" + format, how + Words{"--threads", "1"}));
        CHECK(whole["shards"] == 9);
        CHECK(whole["baked"] == 9);
        const auto wanted = files_in(folder / ("whole-" + format));
        double bytes = 0;
        for (const auto& [name, content] : wanted)
            if (name.ends_with(".gofferc")) bytes += static_cast<double>(content.size());
        CHECK(whole["bytes"] == bytes);
        CHECK(wanted.size() == 9 + 2 + 2);
        for (const int shares : {1, 3, 7}) {
            for (const bool backward : {false, true}) {
                const std::string place = format + std::to_string(shares) + (backward ? "b" : "f");
                for (int i = 1; i <= shares; ++i) {
                    const std::string share =
                        std::to_string(backward ? shares + 1 - i : i) + "/" + std::to_string(shares);
                    well(folder, cache_words(place, how + Words{"--shard", share}));
                }
                CHECK(!std::filesystem::exists(folder / place / "manifest.json"));
                CHECK(report(folder, cache_words(place))["baked"] == 0);
                CHECK(files_in(folder / place) == wanted);
            }
        }
    }
}

TEST_CASE("cache: frames and instances have the same bits however they are cut into shards") {
    const Folder folder;
    write(folder, scene_in(folder));
    well(folder, cache_words("one"));
    well(folder, cache_words("many", small_shards));
    well(folder, cache_words("least", {"--shard-size", "1"}));
    CHECK(report(folder, cache_words("least"))["shards"] == 9 * 14);
    for (const std::string place : {"0,0", "3,11", "4,12", "8,13"}) {
        for (const std::string from : {"one", "many", "least"})
            well(folder, {"cache", "--extract", place, "-o", from + ".ply", from});
        CHECK(bytes_of(folder / "one.ply") == bytes_of(folder / "many.ply"));
        CHECK(bytes_of(folder / "one.ply") == bytes_of(folder / "least.ply"));
    }
}

TEST_CASE("cache: an instance that is mirrored comes out with its faces outward") {
    const auto volume_of = [](const std::filesystem::path& file) {
        const mesh::Mesh mesh = mesh::load(file);
        double volume = 0;
        for (std::size_t first = 0, f = 0; f < mesh.faces.size(); first += mesh.faces[f++]) {
            const auto corner = [&](std::size_t i) {
                return glm::dvec3(mesh.positions[mesh.corners[first + i]]);
            };
            for (std::size_t i = 1; i + 1 < mesh.faces[f]; ++i)
                volume += glm::dot(corner(0), glm::cross(corner(i), corner(i + 1))) / 6;
        }
        return volume;
    };
    const Folder folder;
    pose_file(folder, 3 * 2);
    for (const int side : {1, -1}) {
        write_posed_scene(folder, {side, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
        for (const std::string format : {"positions", "packed", "poses"}) {
            CAPTURE(format);
            const std::string place = format + std::to_string(side);
            well(folder, cache_words(place, {"--format", format}));
            well(folder, {"cache", "--extract", "2,0", "-o", place + ".ply", place});
            CHECK(volume_of(folder / (place + ".ply")) > 0.5 * volume_of(folder / "worm.ply"));
        }
    }
}

TEST_CASE("cache: a shard has the bits of the kernels, where its page says") {
    const Folder folder;
    const std::vector<float> angles = pose_file(folder, 3 * 2);
    write_posed_scene(folder, {0, 1, 0, -1, 0, 0, 0, 0, 1, 10, 20, 30});
    const auto made = report(folder, cache_words("cache"));
    const auto file = bend::load_file((folder / "cache/bodies/worm.goffer").c_str());
    REQUIRE(file);
    const bend::Body& body = file->levels[0].body;
    const std::string shard = bytes_of(folder / "cache/shard-000000.gofferc");
    std::uint64_t data = 0, frame_bytes = 0;
    std::memcpy(&data, &shard[88], sizeof data);
    std::memcpy(&frame_bytes, &shard[96], sizeof frame_bytes);
    CHECK(data == 192);
    const glm::mat4x3 places[2] = {{0, 1, 0, -1, 0, 0, 0, 0, 1, 10, 20, 30},
                                   {-1, 0, 0, 0, -1, 0, 0, 0, 1, 4, 25, 37}};
    for (std::size_t i = 0; i < 6; ++i) {
        std::vector<glm::vec3> positions(body.vertex_count());
        bend::DeformJob job{.body = &body, .pose = {angles[2 * i], angles[2 * i + 1]}};
        job.transform = places[i % 2];
        job.isa = *parse_isa(made["isa"].get<std::string>());
        job.positions = interleaved<3>(&positions[0].x, positions.size());
        bend::run(job);
        std::uint64_t offset = 0;
        std::memcpy(&offset, &shard[128 + 16 * (i % 2) + 8], sizeof offset);
        const std::size_t bytes = positions.size() * sizeof(glm::vec3);
        const std::size_t at = data + i / 2 * frame_bytes + offset;
        REQUIRE(at + bytes <= shard.size());
        CHECK(std::memcmp(&shard[at], positions.data(), bytes) == 0);
    }
}

TEST_CASE("cache: an instance taken out is what goffer bend makes of the body, bit for bit") {
    const Folder folder;
    (void)pose_file(folder, 3 * 2);
    write_posed_scene(folder, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    well(folder, cache_words("raw"));
    well(folder, cache_words("lazy", {"--format", "poses"}));
    well(folder, cache_words("packed", {"--format", "packed"}));
    for (const int frame : {0, 2}) {  // instance 0, which stands where its model does
        const std::string angle = std::to_string(5 + 3 * 2 * frame),
                          direction = std::to_string(10 * 2 * frame);
        well(folder, {"bend", "raw/bodies/worm.goffer", "--angle", angle, "--direction", direction, "-o",
                      "bent.ply"});
        const mesh::Mesh bent = mesh::load(folder / "bent.ply");
        for (const std::string from : {"raw", "lazy"}) {
            well(folder, {"cache", "--extract", std::to_string(frame) + ",0", "-o", "out.ply", from});
            CHECK(mesh::load(folder / "out.ply").positions == bent.positions);
        }
        well(folder, {"cache", "--extract", std::to_string(frame) + ",0", "-o", "out.ply", "packed"});
        const double off = farthest(mesh::load(folder / "out.ply"), bent);
        CHECK(off < 12 * std::sqrt(3.0) / 131070 * 1.1);  // half a step of a box 12 long
        CHECK(off > 0);
    }
}

TEST_CASE("cache: what is missing or wrong is baked anew, and nothing else") {
    const Folder folder;
    nlohmann::json scene = scene_in(folder);
    write(folder, scene);
    well(folder, cache_words("cache", small_shards));
    const auto wanted = files_in(folder / "cache");
    const std::string name = folder / "cache/shard-000004.gofferc";
    const std::string good = bytes_of(name);
    const auto mended = [&](const char* what) {
        CAPTURE(what);
        CHECK(run(folder, {"cache", "--verify", "cache"}).code == 1);
        const auto again = report(folder, cache_words("cache"));
        CHECK(again["baked"] == 1);
        CHECK(again["kept"] == 8);
        CHECK(files_in(folder / "cache") == wanted);
        well(folder, {"cache", "--verify", "cache"});
    };
    std::filesystem::remove(name);
    mended("deleted");
    for (const std::size_t at :
         {std::size_t{0}, std::size_t{40}, std::size_t{130}, good.size() / 2, good.size() - 1}) {
        std::string bytes = good;
        bytes[at] = static_cast<char>(bytes[at] ^ 1);
        folder.write("cache/shard-000004.gofferc", bytes);
        mended("flipped");
    }
    for (const std::size_t size : {std::size_t{0}, std::size_t{100}, good.size() - 64}) {
        folder.write("cache/shard-000004.gofferc", good.substr(0, size));
        mended("cut");
    }
    folder.write("cache/shard-000004.gofferc", good + std::string(64, '\0'));
    mended("longer");
    folder.write("cache/shard-000004.gofferc", bytes_of(folder / "cache/shard-000003.gofferc"));
    mended("another");
    std::filesystem::remove(name);
    std::filesystem::create_directory(name);
    CHECK(run(folder, cache_words("cache")).code == 1);
    std::filesystem::remove(name);
    mended("a folder");
}

TEST_CASE("cache: another scene, or another of its files, makes all shards wrong") {
    const Folder folder;
    nlohmann::json scene = scene_in(folder);
    write(folder, scene);
    well(folder, cache_words("cache", small_shards));
    const auto changed = [&](const char* what) {
        CAPTURE(what);
        const auto again = report(folder, cache_words("cache"));
        CHECK(again["wrong"] == 9);
        well(folder, {"cache", "--verify", "cache"});
    };
    scene["fps"] = 25;
    write(folder, scene);
    changed("scene");
    folder.write("keys.csv", "time,angle\n0,0\n1,51\n");
    changed("motion");
    base(folder, "worm.ply", {"--columns", "8", "--rows", "17", "--radius", "1.1"});
    changed("model");
    scene["frames"] = 4;
    write(folder, scene);
    CHECK(report(folder, cache_words("cache"))["shards"] == 3);
    well(folder, {"cache", "--verify", "cache"});  // the other six are gone
    CHECK(report(folder, cache_words("cache", {"--isa", "scalar"}))["wrong"] == 3);
    CHECK(report(folder, cache_words("cache"))["isa"] == "scalar");  // as the folder has it
}

TEST_CASE("cache: verify names each file at fault in a line of its own") {
    const Folder folder;
    write(folder, scene_in(folder));
    well(folder, cache_words("cache", small_shards));
    CHECK(report(folder, {"cache", "--verify", "cache"})["faults"].empty());
    std::filesystem::remove(folder / "cache/shard-000002.gofferc");
    folder.write("cache/shard-000005.gofferc", "GOFFCA");
    folder.write("cache/shard-000077.gofferc", "stray");
    std::filesystem::remove(folder / "cache/bodies/snake.goffer");
    const Result result = run(folder, {"cache", "--verify", "cache"});
    CHECK(result.code == 1);
    CHECK(std::ranges::count(result.out, '\n') == 4);
    for (const char* piece :
         {"shard-000002.gofferc: is missing", "shard-000005.gofferc: is cut off",
          "shard-000077.gofferc: is not in the manifest", "bodies/snake.goffer: is missing"})
        CHECK_MESSAGE(result.out.find(piece) != std::string::npos, result.out);
    CHECK(result.err.find("4 faults") != std::string::npos);
    well(folder, cache_words("cache"));
    well(folder, {"cache", "--verify", "cache"});
    std::filesystem::remove(folder / "cache/manifest.json");
    refused(folder, 1, {"cache", "--verify", "cache"}, {"manifest.json", "not whole"});
}

TEST_CASE("cache: the commands of its page") {
    const std::filesystem::path farm = std::filesystem::path(GOFFER_SOURCE_DIR) / "samples/farm";
    const std::string page = bytes_of(farm / "README.md"), fence = "```sh\n";
    const std::size_t begin = page.find(fence) + fence.size();
    const Folder folder;
    folder.write("commands.sh", page.substr(begin, page.find("```", begin) - begin));
    std::filesystem::copy(farm / "places.csv", folder / "places.csv");
    std::string scene = bytes_of(farm / "crowd.json");
    const std::string frames = "\"frames\": 240";
    REQUIRE(scene.find(frames) != scene.npos);
    if (!all_rounds()) scene.replace(scene.find(frames), frames.size(), "\"frames\": 40");
    folder.write("crowd.json", scene);
    const std::string words = "cd " + (folder / ".").string() +
                              " && PATH=" + std::filesystem::path(GOFFER_COMMAND).parent_path().string() +
                              ":$PATH sh -e commands.sh >/dev/null";
    CHECK(std::system(words.c_str()) == 0);
    const std::size_t shards = all_rounds() ? 24 : 4;
    CHECK(files_in(folder / "cache").size() == shards + 2 + 2);
    CHECK(mesh::load(folder / "worm_995.obj").positions.size() == 204);
}
