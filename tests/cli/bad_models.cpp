// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

/// Models that are broken or no bodies: exit code 1, one line that names the file, nothing written.

using namespace goffer::test;

namespace {

constexpr const char* endings[] = {".obj", ".ply", ".stl", ".glb", ".gltf"};

struct Refusals {
    Folder folder;

    Refusals() {
        for (const std::string name : {"out.ply", "out.png", "out.json"}) folder.write(name, "kept");
    }

    /// Both commands refuse it, by name.
    void refuse(const std::string& name, const Words& pieces = {}) const {
        const Words all = Words{"goffer: " + name + ": "} + pieces;
        refused(folder, 1, {"inspect", name, "--json", "out.json"}, all);
        refused(folder, 1, {"bend", name, "-o", "out.ply", "--png", "out.png", "--json", "out.json"}, all);
    }
    void refuse(const std::string& name, const std::string& bytes, const Words& pieces) const {
        folder.write(name, bytes);
        CAPTURE(bytes);
        refuse(name, pieces);
    }
};

std::string garbage(std::size_t size) {
    std::mt19937 random(5);
    std::string bytes(size, '\0');
    for (char& c : bytes) c = static_cast<char>(random() & 0xff);
    return bytes;
}

const std::string tetrahedron = "f 1 2 3\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

}  // namespace

TEST_CASE("bad models: missing, empty, folders, not a mesh") {
    const Refusals place;
    for (const std::string ending : endings) {
        place.refuse("none" + ending, {"no such file"});
        place.refuse("empty" + ending, "", {"empty"});
        std::filesystem::create_directory(place.folder / ("folder" + ending));
        place.refuse("folder" + ending, {"folder"});
        place.refuse("garbage" + ending, garbage(5000), {});
        place.refuse("short" + ending, garbage(7), {});
        place.refuse("zero" + ending, std::string(3000, '\0'), {});
        place.refuse("words" + ending, "Dear reader,\nthis is a letter.\n", {});
    }
    place.refuse("letter.txt", "Dear reader,\nthis is a letter.\n", {".glb"});
    place.refuse("/dev/null");
}

TEST_CASE("bad models: cut off") {
    const Refusals place;
    for (const std::string ending : endings) {
        const std::string name = base(place.folder, "whole" + ending, {"--columns", "16", "--rows", "41"});
        const std::string whole = bytes_of(place.folder / name);
        // An OBJ that ends after a face is a whole file.
        const std::size_t most = ending == ".obj"    ? whole.find("\nf ") - 3
                                 : ending == ".gltf" ? whole.rfind('}')
                                                     : whole.size() - 1;
        for (const double share : {0.001, 0.01, 0.1, 0.3, 0.6, 0.9, 1.0}) {
            const auto size = static_cast<std::size_t>(share * static_cast<double>(most));
            place.refuse("cut" + ending, whole.substr(0, std::max<std::size_t>(size, 1)), {});
        }
    }
}

TEST_CASE("bad models: coordinates that are no numbers") {
    const Refusals place;
    const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (const std::string bad : {"nan", "inf", "-inf", "1e39", "NaN"}) {
        CAPTURE(bad);
        place.refuse("bad.obj", three + "v 0 0 " + bad + "\n" + tetrahedron, {});
        place.refuse(
            "bad.ply",
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
            "float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 "
            "0\n0 1 0\n0 0 " +
                std::string(bad) + "\n3 0 1 2\n",
            {});
        place.refuse("bad.stl",
                     "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 " +
                         std::string(bad) + "\nendloop\nendfacet\nendsolid s\n",
                     {});
    }
    const auto binary = [&](const std::string& ending, float value) {
        const std::string name = base(place.folder, "good" + ending, {"--columns", "5", "--rows", "5"});
        std::string bytes = bytes_of(place.folder / name);
        const float one = 1;  // the first vertex's x
        const std::string from(reinterpret_cast<const char*>(&one), 4);
        const auto at = bytes.find(from, ending == ".ply" ? bytes.find("end_header") : 84);
        REQUIRE(at != bytes.npos);
        bytes.replace(at, 4, reinterpret_cast<const char*>(&value), 4);
        place.refuse("bad" + ending, bytes, {});
    };
    for (const std::string ending : {".ply", ".stl", ".glb"}) {
        binary(ending, std::nanf(""));
        binary(ending, -HUGE_VALF);
    }
}

TEST_CASE("bad models: no triangles, one triangle") {
    const Refusals place;
    const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    place.refuse("points.obj", three, {"no faces"});
    place.refuse("lines.obj", three + "l 1 2 3\n", {"no faces"});
    place.refuse("one.obj", three + "f 1 2 3\n", {"one plane"});
    place.refuse("none.stl", "solid s\nendsolid s\n", {});
    place.refuse("none.stl", std::string(84, '\0'), {});
    place.refuse("none.ply",
                 "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
                 "float z\nend_header\n0 0 0\n",
                 {"no faces"});
    place.refuse("none.gltf", "{\"asset\": {\"version\": \"2.0\"}}", {});
    place.refuse("none.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"scenes\": [{\"nodes\": []}]}", {});
}

TEST_CASE("bad models: all in one point, on one line, in one plane") {
    const Refusals place;
    place.refuse("point.obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nv 1 2 3\n" + tetrahedron, {"one point"});
    place.refuse("line.obj", "v 0 0 0\nv 1 1 2\nv 2 2 4\nv 5 5 10\n" + tetrahedron, {"one line"});
    place.refuse("plane.obj", "v 0 0 0\nv 1 0 1\nv 0 1 0\nv 5 3 5\n" + tetrahedron, {"one plane"});
    // About an axis that it has no extent along, or no surface around.
    base(place.folder, "base.ply");
    for (const std::string axis : {"x", "y", "z"}) {
        refused(place.folder, 1, {"inspect", "plane.obj", "--axis", axis}, {"plane.obj", "one plane"});
        CHECK(run(place.folder, {"inspect", "base.ply", "--axis", axis}).code == 0);
    }
}

TEST_CASE("bad models: an index out of range") {
    const Refusals place;
    const std::string four = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 9\n";
    for (const std::string face :
         {"f 1 2 5\n", "f 0 1 2\n", "f 1 2 -9\n", "f 1 2 4294967297\n", "f 1 2 1e1\n"}) {
        CAPTURE(face);
        place.refuse("index.obj", four + tetrahedron + face, {"line 9"});
    }
    for (const std::string index : {"4", "-1", "4294967295"}) {
        place.refuse(
            "index.ply",
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
            "float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 "
            "0\n0 1 0\n0 0 1\n3 0 1 " +
                std::string(index) + "\n",
            {});
    }
}

TEST_CASE("bad models: materials outside the model's folder are left out, unless that is allowed") {
    const Refusals place;
    std::filesystem::create_directory(place.folder / "in");
    const std::string name = base(place.folder, "in/base.obj", {"--columns", "16", "--rows", "41"});
    place.folder.write("secret.mtl", "newmtl a\nKd 1 0 0\n");
    place.folder.write("in/bad.obj", "mtllib ../secret.mtl\nusemtl a\n" + bytes_of(place.folder / name));
    for (const Words& words : {Words{"inspect", "in/bad.obj"}, Words{"refine", "in/bad.obj", "-o", "out.glb"},
                               Words{"bend", "in/bad.obj", "-o", "out.glb"}, Words{"crowd", "in/bad.obj"}}) {
        const Result left_out = run(place.folder, words);
        CHECK(left_out.code == 0);
        CHECK(left_out.err.find("line 1: mtllib names '../secret.mtl'") != std::string::npos);
        const Result read = run(place.folder, words + Words{"--allow-outside"});
        CHECK(read.code == 0);
        CHECK(read.err.find("mtllib") == std::string::npos);
    }
}

TEST_CASE("bad models: what would take more memory than is allowed") {
    const Refusals place;
    base(place.folder, "base.ply", {"--columns", "16", "--rows", "41"});
    base(place.folder, "large.ply", {"--columns", "100", "--rows", "41"});
    for (const std::string command : {"inspect", "crowd"})
        refused(place.folder, 1, {command, "large.ply", "--max-memory", "1M"},
                {"large.ply: 4100 vertices and 8000 triangles", "1 MiB", "--max-memory"});
    // Below the limit as it is, above it when refined.
    refused(place.folder, 1, {"refine", "base.ply", "-o", "out.ply", "--folds", "64", "--max-memory", "1M"},
            {"base.ply: refined", "ask for fewer folds, or allow more with --max-memory"});
    CHECK(run(place.folder, {"refine", "base.ply", "-o", "new.ply", "--folds", "64"}).code == 0);
    refused(place.folder, 1, {"inspect", "base.ply", "--max-memory", "10k"},
            {"base.ply: takes more than the 10 KiB"});
    refused(place.folder, 2, {"base", "-o", "out.ply", "--max-memory", "1M"},
            {"--columns, --rows", "--max-memory"});
    for (const std::string word : {"much", "-1", "18446744073709551616", "", "M", "8X", "8.5.G"})
        refused(place.folder, 2, {"inspect", "base.ply", "--max-memory", word},
                {"--max-memory: '" + word + "' is not a size, such as 500M or 8G"});
}

TEST_CASE("bad models: many vertices without a triangle are no reason to wait") {
    const Folder folder;
    base(folder, "base.obj", {"--columns", "128", "--rows", "257"});
    std::string text;
    for (int i = 0; i < 200000; ++i) text += std::string("v 0 0 ") + std::to_string(100 + i) + "\n";
    folder.write("more.obj", bytes_of(folder / "base.obj") + text);
    CHECK(report(folder, {"inspect", "more.obj"})["fit"]["length"].get<double>() == doctest::Approx(10));
    CHECK(run(folder, {"bend", "more.obj", "-o", "out.obj", "--angle", "200"}).code == 0);
}

TEST_CASE("bad models: too far from the origin for floats") {
    const Refusals place;
    std::string text;
    for (const std::string z : {"0", "1"})
        for (const std::string xy : {"1e9 1e9 ", "1.0000001e9 1e9 ", "1e9 1.0000001e9 "})
            text += std::string("v ") + xy + z + "\n";
    place.refuse("far.obj", text + "f 1 2 3\nf 4 5 6\nf 1 2 5 4\nf 2 3 6 5\nf 3 1 4 6\n", {});
}
