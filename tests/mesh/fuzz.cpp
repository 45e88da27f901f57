// SPDX-License-Identifier: MIT
#include "files.hpp"
#include "refined.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>

using namespace goffer::mesh;
using namespace goffer::test;

namespace {

const std::string obj =
    "mtllib m.mtl\nv 0 0 0 1 0 0\nv 1.5 0 0\nv 1 1 0\nv 0 1e0 0\nvt 0 0\nvt 1 0\nvn 0 0 1\nusemtl a\n"
    "f 1/1/1 2/2/1 3/1/1 \\\n 4//1\ng x\nf -1 -2 -3\nl 1 2\n";
const std::string mtl =
    "newmtl a\nKd 0.5 0.5 0.5\nd 0.5\nmap_Kd -o 1 1 1 -s 2 2 2 a.png\nKs 1 1 1\nNs 10\nillum 2\n";
const std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty double y\nproperty float z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
    "property list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n"
    "0 0 0 1 2 3\n1 0 0 4 5 6\n0 1 0 7 8 9\n3 0 1 2 6 0 0 1 0 0 1\n";
const std::string stl =
    "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
    "0\nendloop\nendfacet\nendsolid\n";

/// Cuts, flips, doubles or swaps a few bytes.
std::string mutated_text(std::string bytes, std::mt19937& random) {
    const auto place = [&] { return random() % (bytes.size() + 1); };
    for (std::uint32_t n = 1 + random() % 2; n > 0; --n) {
        const std::size_t at = place();
        switch (random() % 6) {
            case 0:
                bytes.resize(at);
                break;
            case 1:
                bytes.insert(at, 1, static_cast<char>(random()));
                break;
            case 2:
                bytes.erase(at, 1 + random() % 8);
                break;
            case 3:
                bytes.insert(at, bytes.substr(place(), random() % 40));
                break;
            case 4:
                bytes.insert(at, 1, "0123456789-./ \n\\#e"[random() % 18]);
                break;
            default:
                if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1u << random() % 8));
        }
    }
    return bytes;
}

/// Loads what a mutation made of `bytes`; what loads can also be written, bent and written, and refined and
/// written, in its own format. Returns how many loaded.
int survive(const std::string& name, const std::string& bytes, int rounds, const std::string& beside = {}) {
    const Folder folder(quick_place());
    const auto out_file = folder / ("out-" + name);
    std::mt19937 random(20150627);
    int loaded = 0;
    for (int i = 0; i < rounds; ++i) {
        if (!beside.empty()) folder.write("m.mtl", mutated_text(beside, random));
        const auto file =
            folder.write(name, beside.empty() || i % 2 == 0 ? mutated_text(bytes, random) : bytes);
        try {
            const Mesh mesh = load(file);
            ++loaded;
            save(mesh, out_file);
            CHECK(bytes_of(out_file) == bytes_of(file));
            std::filesystem::remove(out_file);
            VertexArrays bent = vertex_arrays(mesh);
            for (glm::vec3& position : bent.positions) position += glm::vec3(1, 2, 3);
            for (std::size_t r = 0; r < bent.normals.size(); ++r) bent.normals[r] = {0, 0, r};
            const Mesh out = with_vertex_arrays(mesh, bent);
            save(out, out_file);
            CHECK(load(out_file).positions == out.positions);
            std::filesystem::remove(out_file);
            const Mesh cut = refined(mesh, halves(mesh).pieces());
            save(cut, out_file);
            CHECK(load(out_file).positions == cut.positions);
            CHECK(load(out_file).corners == cut.corners);
            std::filesystem::remove(out_file);
        } catch (const Error& error) {
            const std::string what = error.what();
            CHECK(what.find(name) != what.npos);
            CHECK(what.find('\n') == what.npos);
        }
    }
    return loaded;
}

}  // namespace

TEST_CASE("fuzz: OBJ and MTL files load or are refused") {
    CHECK(survive("a.obj", obj, 3000, mtl) > 1000);
}

TEST_CASE("fuzz: PLY files load or are refused") {
    CHECK(survive("a.ply", ply, 3000) > 100);
    Mesh mesh = load_text("a.ply", ply);
    mesh.source = nullptr;
    CHECK(survive("b.ply", saved(mesh, "a.ply"), 3000) > 100);
}

TEST_CASE("fuzz: STL files load or are refused") {
    CHECK(survive("a.stl", stl, 3000) > 100);
    Mesh mesh = load_text("a.stl", stl);
    mesh.source = nullptr;
    CHECK(survive("b.stl", saved(mesh, "a.stl"), 3000) > 400);
}

TEST_CASE("fuzz: bytes without any sense are refused under every name") {
    std::mt19937 random(7);
    const Folder folder(quick_place());
    for (int i = 0; i < 500; ++i) {
        std::string bytes(1 + random() % 300, '\0');
        std::ranges::generate(bytes, [&] { return static_cast<char>(random()); });
        for (const char* name : {"a.obj", "a.ply", "a.stl", "a.glb", "a.gltf"}) {
            const auto file = folder.write(name, bytes);
            CHECK(!error_of([&] { (void)load(file); }).empty());
        }
    }
}
