// SPDX-License-Identifier: MIT
#include "command_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>

/// The programs of samples/how_to do what they say.

namespace goffer::test {
namespace {

namespace fs = std::filesystem;

/// Bodies in a folder: of a worm worm.goffer, levels.goffer with a coarser mesh, and chain.goffer of eight
/// regions; and short.goffer, of another worm.
class Bodies {
public:
    Bodies() {
        const std::string eighths = ".125,.125,.125,.125,.125,.125,.125,.125";
        folder_.goffer("base --length 10 --radius 1 --columns 24 --rows 81 --caps -o worm.ply");
        folder_.goffer("base --length 10 --radius 1 --columns 12 --rows 21 --caps -o far.ply");
        folder_.goffer("base --length 6 --radius 1 --columns 16 --rows 41 --caps -o short.ply");
        folder_.goffer("bake worm.ply --refine off --socket tip=0,0,10 --socket side=1,0,5 -o worm.goffer");
        folder_.goffer("bake worm.ply --refine off --amplitude none --regions " + eighths +
                       " -o chain.goffer");
        folder_.goffer("bake worm.ply --lod far.ply --refine off -o levels.goffer");
        folder_.goffer("bake short.ply --refine off -o short.goffer");
    }

    /// What `how_to/<name> <file>` prints.
    [[nodiscard]] std::string run(const std::string& name, const std::string& files) const {
        return folder_.output(GOFFER_HOW_TO "/" + name, files);
    }

private:
    CommandFolder folder_;
};

}  // namespace

TEST_CASE("how to: each program does what it says") {
    const Bodies bodies;
    const auto prints = [&](const std::string& name, const std::string& files, const std::string& pattern) {
        const std::string out = bodies.run(name, files);
        CAPTURE(name);
        CAPTURE(out);
        CHECK(std::regex_match(out, std::regex(pattern)));
    };
    prints("refine", "", R"(72 vertices: 0 folds\n\d+ vertices: 20 folds\n)");
    prints("bind_and_bend", "", R"(the last vertex went from 1\.0 0\.0 10\.0 to 5\.3 -0\.3 4\.7\n)");
    // The outer line keeps its length L: at angle a its end is L sin(a) / a high.
    prints("body_file", "worm.goffer short.goffer",
           R"(to draw: 3888 triangles, 2 sockets\n)"
           R"(frame 0: revision 1, 100 worms of 1946 vertices, up to 10\.00 high\n)"
           R"(frame 1: revision 1, 100 worms of 1946 vertices, up to 9\.93 high\n)"
           R"(to draw: 1312 triangles, 0 sockets\n)"
           R"(frame 2: revision 2, 100 worms of 658 vertices, up to 5\.84 high\n)"
           R"(frame 3: revision 2, 100 worms of 658 vertices, up to 5\.65 high\n)"
           R"(removed: the handle names nothing\n)");
    prints("body_file", "worm.goffer chain.goffer",
           R"((?:.*\n)*frame 3: revision 2, 100 worms of 1946 vertices, up to .*\n)"
           R"(removed: the handle names nothing\n)");
    prints("mapped_file", "worm.goffer",
           R"(\d+ bytes mapped, triangles at byte \d+ of them\n)"
           R"(bent from 10\.00 to 9\.59 high\n)");
    prints("crowd", "worm.goffer short.goffer",
           R"(frame 0: 1000 creatures, up to 10\.00 high, up to 6\.00 high\n)"
           R"(frame 1: 1000 creatures, up to 9\.90 high, up to 5\.94 high\n)"
           R"(frame 2: 1000 creatures, up to 9\.59 high, up to 5\.75 high\n)");
    prints("levels", "levels.goffer",
           R"(frame 0, level 0: 10 worms of 3888 triangles\nframe 0, level 1: 90 worms of 504 triangles\n)"
           R"(frame 0: 100 bent\n)"
           R"(frame 1, level 0: 15 worms of 3888 triangles\nframe 1, level 1: 85 worms of 504 triangles\n)"
           R"(frame 1: 100 bent\n)"
           R"(frame 2, level 0: 19 worms of 3888 triangles\nframe 2, level 1: 81 worms of 504 triangles\n)"
           R"(frame 2: 100 bent\n)");
    for (const std::string body : {"worm", "chain"})
        prints("job_system", body + ".goffer",
               R"((frame [012]: a job of the game's own, 16 of the crowd: as on one thread\n){3})");
    prints("own_scheduler", "worm.goffer", R"(200 instances in 16 pieces\n)");
    prints("tbb_arena", "worm.goffer", R"(200 instances on 2 threads, and 1\.414\n)");
    prints("culling_and_detail", "worm.goffer", R"(frame 0: 61 of 100\n(frame [1-3]: 31 of 100\n){3})");
    for (const std::string name :
         {"own_scheduler", "tbb_arena", "culling_and_detail", "levels", "motion_vectors", "shader"})
        prints(name, "chain.goffer", "this program is for bodies of one region\n");
    prints("crowd", "worm.goffer chain.goffer", "this program is for bodies of one region\n");
    prints(
        "sockets_and_capsules", "worm.goffer",
        R"(tip: 2\.33 -?0\.00 9\.11\nside: 1\.63 -?0\.00 4\.43\n4 capsules, the first of radius 1\.\d+\n)");
    prints("path", "chain.goffer",
           R"((frame (0|10|20): 8 regions, off the path by \d\.\d % of the length\n){3})");
    prints("skinning", "worm.goffer", R"(\d+ vertices, bent and skinned: x to 7\.7, 1\.0 at rest\n)");
    prints(
        "motion_vectors", "worm.goffer",
        R"(frame 0: moved by 0\.000 at most\nframe 1: moved by 1\.06\d at most\nframe 2: moved by 1\.03\d at most\n)");
    prints("shader", "worm.goffer",
           R"(vertices: 44 bytes each; normals from byte 32 on; text: \d{4} bytes\n)"
           R"(frame 0: 272000 bytes to upload, curvature 0\.000\n)"
           R"(frame 1: 272000 bytes to upload, curvature 0\.050\n)"
           R"(frame 2: 272000 bytes to upload, curvature 0\.100\n)");
    prints("packed", "worm.goffer", R"(\d+ bytes instead of \d+, off by \de-0[567] of the length\n)");
}

TEST_CASE("how to: programs say what is wrong with a file, and how they are called") {
    const Bodies bodies;
    for (const fs::directory_entry& entry : fs::directory_iterator(GOFFER_SOURCE_DIR "/samples/how_to")) {
        const std::string name = entry.path().stem().string();
        if (name == "bind_and_bend" || name == "refine") continue;
        CAPTURE(name);
        CHECK(bodies.run(name, "").starts_with("usage: " + name + " FILE.goffer"));
        const bool two = name == "body_file" || name == "crowd";
        const std::string files = two ? "worm.ply worm.ply" : "worm.ply";
        CHECK(bodies.run(name, files) == "worm.ply: body file: not a body file; goffer bake makes one\n");
    }
}

TEST_CASE("how to: the README lists every program, and each is short") {
    const std::string readme = bytes_of(GOFFER_SOURCE_DIR "/README.md");
    std::size_t programs = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(GOFFER_SOURCE_DIR "/samples/how_to")) {
        ++programs;
        const std::string name = "(samples/how_to/" + entry.path().filename().string() + ")";
        CAPTURE(name);
        CHECK(readme.find(name) != std::string::npos);
        const std::string text = bytes_of(entry.path());
        CHECK(std::count(text.begin(), text.end(), '\n') < 60);
    }
    CHECK(programs == 16);
}

}  // namespace goffer::test
