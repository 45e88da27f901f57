// SPDX-License-Identifier: MIT
#include "command_folder.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <regex>
#include <string>

/// The programs of samples/how_to do what they say.

namespace goffer::test {
namespace {

namespace fs = std::filesystem;

/// Bodies of a worm in a folder: worm.goffer, and chain.goffer of eight regions.
class Bodies {
public:
    Bodies() {
        const std::string eighths = ".125,.125,.125,.125,.125,.125,.125,.125";
        folder_.goffer("base --length 10 --radius 1 --columns 24 --rows 81 --caps -o worm.ply");
        folder_.goffer("bake worm.ply --refine off --socket tip=0,0,10 --socket side=1,0,5 -o worm.goffer");
        folder_.goffer("bake worm.ply --refine off --amplitude none --regions " + eighths +
                       " -o chain.goffer");
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
    prints("bind_and_bend", "", R"(the last vertex went from 1\.0 0\.0 10\.0 to 5\.3 -0\.3 4\.7\n)");
    prints("body_file", "worm.goffer chain.goffer",
           R"(to draw: \d+ triangles, 2 sockets\n(frame [01]: revision 1, \d+ vertices\n){2})"
           R"(to draw: \d+ triangles, 0 sockets\n(frame [23]: revision 2, \d+ vertices\n){2})"
           R"(removed: the handle names nothing\n)");
    prints("own_scheduler", "worm.goffer", R"(200 instances in 16 pieces\n)");
    prints("tbb_arena", "worm.goffer", R"(200 instances on 2 threads, and 1\.414\n)");
    prints("culling_and_detail", "worm.goffer", R"(frame 0: 61 of 100\n(frame [1-3]: 31 of 100\n){3})");
    for (const std::string name :
         {"own_scheduler", "tbb_arena", "culling_and_detail", "motion_vectors", "shader"})
        prints(name, "chain.goffer", "this program is for bodies of one region\n");
    prints(
        "sockets_and_capsules", "worm.goffer",
        R"(tip: 2\.33 -?0\.00 9\.11\nside: 1\.63 -?0\.00 4\.43\n4 capsules, the first of radius 1\.\d+\n)");
    prints("path", "chain.goffer", R"(8 regions, off the path by \d\.\d % of the length\n)");
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
        if (name == "bind_and_bend") continue;
        CAPTURE(name);
        CHECK(bodies.run(name, "").starts_with("usage: " + name + " FILE.goffer"));
        const std::string files = name == "body_file" ? "worm.ply worm.ply" : "worm.ply";
        CHECK(bodies.run(name, files) == "worm.ply: body file: not a body file; goffer bake makes one\n");
    }
}

TEST_CASE("how to: the README lists every program") {
    const std::string readme = bytes_of(GOFFER_SOURCE_DIR "/README.md");
    std::size_t programs = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(GOFFER_SOURCE_DIR "/samples/how_to")) {
        ++programs;
        const std::string name = "(samples/how_to/" + entry.path().filename().string() + ")";
        CAPTURE(name);
        CHECK(readme.find(name) != std::string::npos);
    }
    CHECK(programs == 11);
}

}  // namespace goffer::test
