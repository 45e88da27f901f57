// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

/// Outputs that cannot be written and fits that cannot be used: exit code 1, one line, nothing written.

using namespace goffer::test;
using nlohmann::json;

namespace {

struct Place {
    Folder folder;
    json fit;

    Place() {
        fit = report(folder, {"inspect", base(folder)});
        for (const std::string name : {"out.ply", "out.png", "out.json"}) folder.write(name, "kept");
        std::filesystem::create_directory(folder / "sub.ply");
        std::filesystem::create_directory(folder / "sub.png");
    }

    void refuse_bend(const Words& words, const Words& pieces) const {
        refused(folder, 1, Words{"bend", "base.ply"} + words, pieces);
    }
    void refuse_fit(const std::string& text, const Words& pieces) const {
        folder.write("fit.json", text);
        refuse_bend({"-o", "out.ply", "--fit", "fit.json"}, Words{"fit.json"} + pieces);
    }
    void refuse_field(const char* name, const json& value, const Words& pieces) const {
        json changed = fit;
        changed["fit"][name] = value;
        CAPTURE(name);
        refuse_fit(changed.dump(), pieces);
    }
};

}  // namespace

TEST_CASE("bad files: outputs that cannot be written") {
    const Place place;
    for (const std::string name : {"no/out.ply", "base.ply/out.ply", "sub.ply", "/proc/out.ply"}) {
        place.refuse_bend({"-o", name}, {name});
        place.refuse_bend({"-o", "new.ply", "--json", name}, {name});
    }
    for (const std::string name : {"no/out.png", "base.ply/out.png", "sub.png", "/proc/out.png"})
        place.refuse_bend({"-o", "out.ply", "--png", name}, {name});
    refused(place.folder, 1, {"inspect", "base.ply", "--json", "no/out.json"}, {"no/out.json", "folder"});
    place.refuse_bend({"-o", "out.ply", "--json", "/dev/full"}, {"/dev/full", "not a regular file"});
}

TEST_CASE("bad files: one output that fails keeps the others from being written") {
    const Place place;
    place.refuse_bend({"-o", "out.ply", "--png", "out.png", "--json", "no/out.json"}, {"no/out.json"});
    place.refuse_bend({"-o", "new.ply", "--png", "new.png", "--json", "no/out.json"}, {"no/out.json"});
    place.refuse_bend({"-o", "new.ply", "--png", "no/new.png", "--json", "new.json"}, {"no/new.png"});
    place.refuse_bend({"-o", "no/new.ply", "--png", "new.png", "--json", "new.json"}, {"no/new.ply"});
}

TEST_CASE("bad files: fits that are none") {
    const Place place;
    place.refuse_bend({"-o", "out.ply", "--fit", "none.json"}, {"none.json: there is no such file"});
    place.refuse_bend({"-o", "out.ply", "--fit", "sub.ply"}, {"sub.ply", "goffer inspect --json"});
    for (const std::string text :
         {"[]", "{}", "null", "3", "{\"fit\": []}", "{\"fit\": {}}", "{\"fit\": {\"origin\": [0, 0]}}"}) {
        CAPTURE(text);
        place.refuse_fit(text, {"not a fit", "goffer inspect --json"});
    }
    for (const std::string text : {"", "garbage", "{", "\xff\xfe\x00\x01"}) {
        CAPTURE(text);
        place.refuse_fit(text, {"is not JSON", "goffer inspect --json"});
    }
    place.refuse_fit(place.fit.dump().substr(0, 200), {"is not JSON"});
    place.refuse_fit(std::string(100000, '['), {"nested more than 32 deep"});
    place.refuse_field("arcs", nlohmann::json::parse(std::string(500, '[') + std::string(500, ']')),
                       {"nested more than 32 deep"});
}

TEST_CASE("bad files: fits with a field that cannot be") {
    const Place place;
    place.refuse_field("radius", -1, {"radius", "-1"});
    place.refuse_field("radius", 0, {"radius"});
    place.refuse_field("radius", "wide", {"not a fit"});
    place.refuse_field("radius", nullptr, {"not a fit"});
    place.refuse_field("length", -10, {"length", "-10"});
    place.refuse_field("axis", {0, 0, 0}, {"axis"});
    place.refuse_field("axis", {0, 0, 7}, {"axis"});
    place.refuse_field("axis", {1, 0}, {"not a fit"});
    place.refuse_field("axis", {1, 0, 0}, {"zero", "orthogonal"});
    place.refuse_field("zero", {0, 0, 0}, {"zero"});
    place.refuse_field("origin", {"a", "b", "c"}, {"not a fit"});
    place.refuse_field("rest_angle", 300, {"rest_angle"});
}

TEST_CASE("bad files: the fit of another mesh") {
    const Place place;
    place.refuse_field("length", 5, {"vertex", "outside", "0..5"});
    place.refuse_field("length", 1e-30, {"vertex", "outside", "0..1e-30"});
    place.refuse_field("origin", {0, 0, 3}, {"vertex", "z = -3", "outside"});
}

TEST_CASE("bad files: where the report cannot be written, no output is") {
    const Place place;
    const std::string go = "cd '" + (place.folder / ".").string() + "' && '" + GOFFER_COMMAND + "' ";
    for (const std::string words :
         {"bend base.ply --angle 10 -o out.ply --png out.png --json out.json >/dev/full 2>/dev/null",
          "bend base.ply --angle 10 -o out.ply --png out.png --json - >/dev/full 2>/dev/null",
          "bend base.ply --angle 10 -o out.ply --json - >&- 2>/dev/null",
          "refine base.ply --folds 8 -o out.ply >/dev/full 2>/dev/null",
          "base -o out.ply >/dev/full 2>/dev/null",
          "crowd base.ply --frames 1 --instances 2 --png out.png >/dev/full 2>/dev/null"}) {
        CAPTURE(words);
        const Snapshot before = snapshot(place.folder);
        CHECK(std::system((go + words).c_str()) != 0);
        CHECK(snapshot(place.folder) == before);
    }
}

TEST_CASE("bad files: numbers that no body can have are refused before vertices are added") {
    const Place place;
    std::ofstream(place.folder / "far.obj")
        << "v 1e20 0 0\nv 1e20 1e19 0\nv 1e20 0 1e21\nv 1.1e20 1e19 1e21\n"
           "f 1 2 3\nf 2 4 3\nf 1 3 4\nf 1 4 2\n";
    refused(place.folder, 1, {"bend", "far.obj", "-o", "new.obj", "--axis", "0,0,1"},
            {"far.obj: cannot bind: origin: out of range", "scale or move the model"});
}

TEST_CASE("bad files: a pipe as a fit is refused, standard input and a shell's pipe are read") {
    const Place place;
    REQUIRE(mkfifo((place.folder / "pipe").c_str(), 0600) == 0);
    const Result result = run(place.folder, {"bend", "base.ply", "-o", "new.ply", "--fit", "pipe"});
    CHECK(result.code == 1);
    CHECK(result.err.find("pipe: cannot be read, since it is not a regular file") != result.err.npos);
    const std::string go = "cd '" + (place.folder / ".").string() + "' && '" + GOFFER_COMMAND + "' ";
    const std::string fit = go + "inspect base.ply --json - 2>/dev/null | '" + GOFFER_COMMAND + "' ";
    CHECK(std::system((fit + "bend base.ply -o new.ply --fit /dev/stdin >/dev/null").c_str()) == 0);
}

TEST_CASE("bad files: control characters in a name are escaped") {
    const Place place;
    refused(place.folder, 1, {"inspect", "a\x1b[31m\tb.obj"},
            {"a\\x1b[31m\\x09b.obj: there is no such file"});
    std::filesystem::copy(place.folder / "base.ply", place.folder / "red\x1b[31m.ply");
    const std::string out = well(place.folder, {"inspect", "red\x1b[31m.ply"});
    CHECK(out.find('\x1b') == out.npos);
    CHECK(out.find("red\\x1b[31m.ply") != out.npos);
}
