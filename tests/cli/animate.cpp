// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "pixels.hpp"
#include "progress.hpp"
#include "support/sanitized.hpp"

#include <goffer/clip/point_cache.hpp>

#include <doctest/doctest.h>
#include <fcntl.h>
#include <glm/geometric.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

/// `goffer animate`, held against `goffer bend`, frame by frame.

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

namespace {

/// What `goffer bend` writes of base.ply.
std::string bent_base(const Folder& folder, const Words& words) {
    well(folder, Words{"bend", "base.ply", "-o", "bent.ply"} + words);
    return bytes_of(folder / "bent.ply");
}

void write_keys(const Folder& folder) {
    folder.write("keys.json", R"({"interpolation": "linear", "keys": [
        {"time": 0, "angle": 0}, {"time": 1, "angle": 60, "direction": 30}, {"time": 2, "angle": -20, "direction": 30}]})");
    folder.write("keys.csv", "\"time\",\"angle\",direction\n\"0\",0,0\n\" 1 \",60,30\n2,-20,30\n");
    folder.write("path.txt", "0 0 0\n5 0 10\n0 3 20\n10 0 30\n20 -5 20\n");
}

/// Files of the folder whose names begin so, in order.
std::vector<std::string> files_of(const Folder& folder, const std::string& begin) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / ".")) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(begin)) names.push_back(name);
    }
    std::ranges::sort(names);
    return names;
}

}  // namespace

TEST_CASE("animate: frames of keys are those of bend in the same poses, bit for bit") {
    const Folder folder;
    base(folder);
    write_keys(folder);
    const json all =
        report(folder, {"animate", "base.ply", "-o", "f%d.ply", "--keys", "keys.json", "--fps", "4"});
    CHECK(all["frames"] == 9);
    CHECK(all["fps"] == 4.0);
    CHECK(all["reached_angle"].get<double>() == doctest::Approx(60));
    CHECK(all["clamped_frames"] == 0);
    CHECK(std::abs(all["worst_area_change"].get<double>()) < 1e-3);
    CHECK(files_of(folder, "f").size() == 9);
    CHECK(bytes_of(folder / "f1.ply") == bent_base(folder, {"--angle", "0"}));
    CHECK(bytes_of(folder / "f3.ply") == bent_base(folder, {"--angle", "30", "--direction", "30"}));
    CHECK(bytes_of(folder / "f5.ply") == bent_base(folder, {"--angle", "60", "--direction", "30"}));
    CHECK(bytes_of(folder / "f9.ply") == bent_base(folder, {"--angle", "-20", "--direction", "30"}));
    std::uint64_t bytes = 0;
    for (const std::string& name : files_of(folder, "f")) bytes += bytes_of(folder / name).size();
    CHECK(all["bytes"] == bytes);
}

TEST_CASE("animate: a table of keys makes the files that JSON makes") {
    const Folder folder;
    base(folder);
    write_keys(folder);
    well(folder, {"animate", "base.ply", "-o", "a%02d.obj", "--keys", "keys.json", "--fps", "2"});
    well(folder, {"animate", "base.ply", "-o", "b%02d.obj", "--keys", "keys.csv", "--fps", "2",
                  "--interpolation", "linear"});
    CHECK(files_of(folder, "a") ==
          std::vector<std::string>{"a01.obj", "a02.obj", "a03.obj", "a04.obj", "a05.obj"});
    for (const std::string number : {"01", "02", "03", "04", "05"})
        CHECK(bytes_of(folder / ("a" + number + ".obj")) == bytes_of(folder / ("b" + number + ".obj")));
}

TEST_CASE("animate: the keys of README.md, as JSON and as a table, make the same frames") {
    const Folder folder;
    base(folder);
    const std::string readme = bytes_of(GOFFER_SOURCE_DIR "/README.md");
    const auto block = [&](const std::string& kind) {
        const std::size_t first = readme.find("```" + kind + "\n") + 4 + kind.size();
        return readme.substr(first, readme.find("```", first) - first);
    };
    CHECK(block("json") == bytes_of(GOFFER_SOURCE_DIR "/tests/data/keys.json"));
    folder.write("keys.json", block("json"));
    folder.write("keys.csv", block("csv"));
    for (const std::string kind : {"json", "csv"})
        well(folder, {"animate", "base.ply", "-o", kind + "%d.ply", "--keys", "keys." + kind, "--fps", "2"});
    for (const std::string number : {"1", "2", "3", "4", "5"})
        CHECK(bytes_of(folder / ("json" + number + ".ply")) == bytes_of(folder / ("csv" + number + ".ply")));
    CHECK(bytes_of(folder / "json3.ply") ==
          bent_base(folder, {"--regions", "0.5,0.5", "--angles", "60,-40", "--directions", "0,90"}));
    well(folder, {"bend", "base.ply", "-o", "laid.ply", "--path", GOFFER_SOURCE_DIR "/tests/data/track.txt"});
}

TEST_CASE("animate: more than a full turn is said") {
    const Folder folder;
    base(folder, "base.ply", {"--length", "30", "--rows", "481"});
    const auto swing = [&](const std::string& angle) {
        return report(
            folder, {"animate", "base.ply", "-o", "s.mdd", "--swing", angle, "--frames", "4", "--fps", "2"});
    };
    CHECK(swing("359")["frames_beyond_full_turn"] == 0);
    const json round = swing("-370,370");
    CHECK(round["frames_beyond_full_turn"] == 2);
    REQUIRE(round["warnings"].size() == 1);
    CHECK(
        round["warnings"][0].get<std::string>().starts_with("in 2 frames it bends by more than a full turn"));
}

TEST_CASE("animate: a swing goes there and back") {
    const Folder folder;
    base(folder);
    const json all = report(folder, {"animate", "base.ply", "-o", "s%d.ply", "--swing", "-40,80", "--frames",
                                     "4", "--direction", "10", "--regions", "0.5,0.5", "--fps", "2"});
    CHECK(all["repeats"] == true);
    CHECK(all["seconds"] == 2.0);
    const auto at = [&](const std::string& angle) {
        return bent_base(folder, {"--angle", angle, "--direction", "10", "--regions", "0.5,0.5"});
    };
    CHECK(bytes_of(folder / "s1.ply") == at("-40"));
    CHECK(bytes_of(folder / "s3.ply") == at("80"));
    well(folder, {"bend", "base.ply", "-o", "half.ply", "--angle", "20", "--direction", "10", "--regions",
                  "0.5,0.5"});
    CHECK(farthest(mesh::load(folder / "s2.ply"), mesh::load(folder / "half.ply")) < 1e-5);
    CHECK(farthest(mesh::load(folder / "s4.ply"), mesh::load(folder / "half.ply")) < 1e-5);
}

TEST_CASE("animate: frames of a walk are those of bend along the path from there, bit for bit") {
    const Folder folder;
    base(folder);
    write_keys(folder);
    const json all =
        report(folder, {"animate", "base.ply", "-o", "w%d.ply", "--path", "path.txt", "--frames", "3"});
    CHECK(all["regions"] == 8);
    CHECK(all["path_error"].get<double>() < 0.3);
    const json first = report(folder, {"bend", "base.ply", "-o", "first.ply", "--path", "path.txt"});
    const double way = first["path"]["length"].get<double>() - 10;
    CHECK(bytes_of(folder / "w1.ply") == bytes_of(folder / "first.ply"));
    const auto from = [&](double start) {
        char text[64];
        std::snprintf(text, sizeof text, "%.17g", start);
        return bent_base(folder, {"--path", "path.txt", "--path-start", text});
    };
    CHECK(bytes_of(folder / "w2.ply") == from(way / 2));
    CHECK(bytes_of(folder / "w3.ply") == from(way));
}

TEST_CASE("animate: a point cache has the places of the sequence's vertices") {
    const Folder folder;
    base(folder, "base.ply", {"--rows", "201"});
    write_keys(folder);
    for (const std::string name : {"worm.mdd", "worm.pc2"}) {
        const json all =
            report(folder, {"animate", "base.ply", "-o", name, "--path", "path.txt", "--frames", "3"});
        CHECK(all["bytes"] == bytes_of(folder / name).size());
        clip::PointCache cache = clip::read_point_cache(folder / name);
        REQUIRE(cache.header().frames == 3);
        well(folder, {"animate", "base.ply", "-o", "w%d.ply", "--path", "path.txt", "--frames", "3"});
        for (std::size_t frame = 0; frame < 3; ++frame) {
            mesh::Mesh model = mesh::load(folder / ("w" + std::to_string(frame + 1) + ".ply")),
                       cached = model;
            REQUIRE(cache.header().points == model.positions.size());
            cache.read(frame, cached.positions);
            CHECK(farthest(model, cached) < 1e-5);
        }
    }
}

TEST_CASE("animate: animated glTF and a vertex-animation texture") {
    const Folder folder;
    base(folder);
    const Words swing{"--swing", "60", "--frames", "12"};
    const json gltf = report(folder, Words{"animate", "base.ply", "-o", "worm.glb"} + swing);
    CHECK(gltf["gltf"]["within"] == true);
    CHECK(gltf["gltf"]["targets"].get<int>() >= 1);
    CHECK(gltf["bytes"] == bytes_of(folder / "worm.glb").size());
    CHECK(mesh::load(folder / "worm.glb").positions.size() ==
          mesh::load(folder / "base.ply").positions.size());
    CHECK(gltf["warnings"].empty());
    const json still = report(folder, {"animate", "base.ply", "-o", "still.glb", "--swing", "0"});
    REQUIRE(still["warnings"].size() == 1);
    CHECK(still["warnings"][0] == "nothing moves: the file has no animation");
    const json few = report(folder, Words{"animate", "base.ply", "-o", "worm.glb", "--targets", "1"} + swing);
    CHECK(few["gltf"]["targets"] == 1);
    const json exact =
        report(folder, Words{"animate", "base.ply", "-o", "worm.glb", "--max-error", "0.01"} + swing);
    CHECK(exact["gltf"]["targets"].get<int>() > gltf["gltf"]["targets"].get<int>());
    CHECK(exact["gltf"]["max_error"].get<double>() < 1e-4 * 10.2);
    for (const Words& more : {Words{"--targets", "3"}, Words{"--max-error", "1"}})
        CHECK(run(folder, Words{"animate", "base.ply", "-o", "worm.mdd"} + swing + more).code == 2);
    mesh::save(mesh::load(folder / "base.ply"), folder / "worm.mesh.glb");
    CHECK(run(folder, Words{"animate", "worm.mesh.glb", "-o", "worm.json"} + swing).code == 2);
    const json texture = report(folder, Words{"animate", "base.ply", "-o", "worm.json"} + swing);
    CHECK(texture["texture"]["files"].size() == 6);
    CHECK(texture["texture"]["position_error"].get<double>() < 1e-3);
    CHECK(Pixels(folder / "worm.positions.png").width == texture["texture"]["width"].get<std::size_t>());
}

TEST_CASE("animate: pictures are taken from one place, from which all frames are seen") {
    const Folder folder;
    base(folder);
    well(folder, {"animate", "base.ply", "-o", "p%d.png", "--swing", "100", "--frames", "4", "--size",
                  "160x120", "--camera", "side"});
    CHECK(files_of(folder, "p") == std::vector<std::string>{"p1.png", "p2.png", "p3.png", "p4.png"});
    // The base's end stays in its place, on the left, and nothing is cut off.
    const auto is_body = [](const std::array<int, 3>& c) { return c[0] - c[2] > 40; };
    std::vector<std::size_t> lefts;
    for (const std::string name : {"p1.png", "p2.png", "p3.png", "p4.png"}) {
        const Pixels pixels(folder / name);
        REQUIRE(pixels.width == 160);
        std::size_t left = pixels.width;
        for (std::size_t y = 0; y < pixels.height; ++y) {
            for (std::size_t x = 0; x < pixels.width; ++x) {
                const bool edge = x == 0 || y == 0 || x + 1 == pixels.width || y + 1 == pixels.height;
                if (is_body(pixels.at(x, y))) left = std::min(left, x);
                if (edge) CHECK(!is_body(pixels.at(x, y)));
            }
        }
        lefts.push_back(left);
    }
    for (const std::size_t left : lefts) CHECK(std::abs(double(left) - double(lefts[0])) <= 1);
    CHECK(bytes_of(folder / "p2.png") == bytes_of(folder / "p4.png"));
    CHECK(bytes_of(folder / "p1.png") != bytes_of(folder / "p3.png"));
}

TEST_CASE("animate: a folder in the place of a frame is found before any is written") {
    const Folder folder;
    base(folder);
    std::filesystem::create_directory(folder / "q_0002.obj");
    refused(folder, 1, {"animate", "base.ply", "--swing", "30", "--frames", "3", "-o", "q_%04d.obj"},
            {"q_0002.obj", "is a folder"});
    CHECK(!std::filesystem::exists(folder / "q_0001.obj"));
}

TEST_CASE("animate: a sequence replaces its own frames, and is not left in front of another's") {
    const Folder folder;
    base(folder);
    folder.write("f2.ply", "old");
    folder.write("f02.ply", "not of the pattern");
    const Words swing{"animate", "base.ply", "--swing", "9", "-o", "f%d.ply", "--frames"};
    well(folder, swing + Words{"3"});
    CHECK(bytes_of(folder / "f2.ply") != "old");
    CHECK(bytes_of(folder / "f02.ply") == "not of the pattern");
    refused(folder, 1, swing + Words{"2"}, {"f3.ply", "to f2.ply", "remove it"});
}

TEST_CASE("animate: memory does not grow with the number of frames") {
    const Folder folder;
    base(folder);
    const auto peak_of = [&](const char* frames) {
        const pid_t child = fork();
        if (child == 0) {
            const int out = open("/dev/null", O_WRONLY);
            if (out < 0 || dup2(out, STDOUT_FILENO) < 0 || chdir((folder / ".").c_str()) != 0) _exit(99);
            execl(GOFFER_COMMAND, "goffer", "animate", "base.ply", "--swing", "60", "--frames", frames, "-o",
                  "worm.mdd", nullptr);
            _exit(98);
        }
        int status = 0;
        rusage used{};
        REQUIRE(wait4(child, &status, 0, &used) == child);
        REQUIRE(WEXITSTATUS(status) == 0);
        return static_cast<double>(used.ru_maxrss);  // kB
    };
    // All 600 frames are 74 MB, and the records of each with their normals twice that.
    const double many = peak_of("600"), few = peak_of("6");
    if (!sanitized) CHECK(many < few + 8000);
}

TEST_CASE("animate: ended early, it leaves whole frames and no others") {
    for (const int signal : {SIGINT, SIGTERM}) {
        const Folder folder;
        base(folder);
        const pid_t child = fork();
        if (child == 0) {
            if (chdir((folder / ".").c_str()) != 0) _exit(99);
            execl(GOFFER_COMMAND, "goffer", "animate", "base.ply", "--swing", "60", "--frames", "5000", "-o",
                  "f%d.ply", nullptr);
            _exit(98);
        }
        const auto start = std::chrono::steady_clock::now();
        while (files_of(folder, "f").size() < 5 &&
               std::chrono::steady_clock::now() - start < std::chrono::seconds(60))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        kill(child, signal);
        int status = 0;
        REQUIRE(waitpid(child, &status, 0) == child);
        CHECK(WIFSIGNALED(status));
        CHECK(WTERMSIG(status) == signal);
        CHECK(files_of(folder, ".goffer").empty());
        const std::vector<std::string> names = files_of(folder, "f");
        CHECK(names.size() >= 5);
        CHECK(names.size() < 5000);
        const std::size_t whole = mesh::load(folder / "base.ply").positions.size();
        for (const std::string& name : names) CHECK(mesh::load(folder / name).positions.size() == whole);
    }
}

TEST_CASE("progress: a bar, and the time that is left") {
    CHECK(cli::progress_line("doing", 0, 0, 7) == "doing ... 7 s");
    CHECK(cli::progress_line("doing", 0, 8, 7) == "doing ... 7 s");
    CHECK(cli::progress_line("doing", 2, 8, 10) == "doing [######..................] 2 of 8, 30 s left");
    CHECK(cli::progress_line("doing", 1, 100, 10) == "doing [........................] 1 of 100, 16:30 left");
    CHECK(cli::progress_line("doing", 1, 1000, 10) ==
          "doing [........................] 1 of 1000, 2:46:30 left");
    CHECK(cli::progress_line("doing", 9, 8, 10) == "doing [########################] 8 of 8, 0 s left");
    CHECK(cli::progress_line("doing", 0.0, 7) == "doing ... 7 s");
    CHECK(cli::progress_line("doing", 0.0001, 7) == "doing ... 7 s");
    CHECK(cli::progress_line("doing", 1.0 / 3, 2) == "doing [########................] 33 %, 4 s left");
    CHECK(cli::progress_line("doing", 0.5, 400) == "doing [############............] 50 %, 6:40 left");
    CHECK(cli::progress_line("doing", 1.5, 7) == "doing [########################] 100 %, 0 s left");
}
