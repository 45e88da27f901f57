// SPDX-License-Identifier: MIT
#include "refined.hpp"

#include "files.hpp"
#include "same.hpp"
#include "support/models.hpp"
#include "support/worst.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace goffer::mesh;
using namespace goffer::test;

namespace {

/// A box of quads, 1 by 1 by 16: texture coordinates with a seam at every edge, hard normals; one of its ends
/// is a part of its own with another material.
const std::string box =
    "# a box\n"
    "mtllib box.mtl\n"
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 16\nv 1 0 16\nv 1 1 16\nv 0 1 16 # the last\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "vn 0 -2 0\nvn 1 0 0\nvn 0 1 0\nvn -1 0 0\nvn 0 0 -1\nvn 0 0 1\n"
    "g side\ns 1\nusemtl red\n"
    "f 1/1/1 2/2/1 6/3/1 5/4/1\n"
    "f 2/1/2 3/2/2 7/3/2 6/4/2 # right\n"
    "f -6/-4/-4 -5/-3/-4 -1/-2/-4 -2/-1/-4\n"
    "f 4/1/4 1/2/4 5/3/4 8/4/4\n"
    "g ends\nusemtl blue\n"
    "f -5/-1/5 -6/-2/5 -7/-3/5 -8/-4/5\n"
    "f 5/1/6 6/2/6 7/3/6 8/4/6\n";

template <class T>
bool begins_with(const std::vector<T>& now, const std::vector<T>& was) {
    return now.size() >= was.size() && std::equal(was.begin(), was.end(), now.begin());
}

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (auto at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++found;
    return found;
}

Mesh without_source(Mesh mesh) {
    mesh.source = nullptr;
    return mesh;
}

/// Refined along an axis, it stays closed, and its file holds what is there.
void check_refined_model(const char* name, int axis) {
    const auto file = model(name);
    if (file.empty()) return;
    const Mesh mesh = load(file);
    const Mesh out = refined_along(mesh, axis, 12);
    CHECK(out.positions.size() > mesh.positions.size());
    CHECK(out.source != nullptr);
    CHECK(out.parts.size() == mesh.parts.size());
    CHECK(out.uvs.size() == mesh.uvs.size());
    CHECK(out.materials == mesh.materials);
    CHECK((open_edges(out) == 0) == (open_edges(mesh) == 0));
    const Mesh back = reloaded(out, name);
    CHECK(back.corners == out.corners);
    CHECK(back.uvs == out.uvs);
    CHECK(back.colors == out.colors);
    CHECK(back.parts == out.parts);
    REQUIRE(back.positions.size() == out.positions.size());
    float worst = 0, size = 0;
    for (std::size_t i = 0; i < back.positions.size(); ++i) {
        take_worst(worst, glm::length(back.positions[i] - out.positions[i]));
        size = std::max(size, glm::length(back.positions[i]));
    }
    CHECK(worst <= 1.2e-7f * size);
}

void append_typed(std::string& bytes, const std::string& type, double value, bool big) {
    if (type == "char") append_number(bytes, static_cast<std::int8_t>(value), big);
    if (type == "uchar") append_number(bytes, static_cast<std::uint8_t>(value), big);
    if (type == "short") append_number(bytes, static_cast<std::int16_t>(value), big);
    if (type == "ushort") append_number(bytes, static_cast<std::uint16_t>(value), big);
    if (type == "int") append_number(bytes, static_cast<std::int32_t>(value), big);
    if (type == "uint") append_number(bytes, static_cast<std::uint32_t>(value), big);
    if (type == "float") append_number(bytes, static_cast<float>(value), big);
    if (type == "double") append_number(bytes, value, big);
}

/// A PLY file in text, whose faces are triangles, as bytes.
std::string binary_ply(const std::string& text, bool big) {
    std::vector<std::pair<int, std::vector<std::string>>> elements;  // how many rows of which types
    std::istringstream lines(text);
    std::string bytes, line;
    while (std::getline(lines, line) && line != "end_header") {
        std::istringstream words(line);
        std::string word, name;
        words >> word >> name;
        if (word == "element") words >> elements.emplace_back().first;
        if (word == "property" && name != "list") elements.back().second.push_back(name);
        if (name == "list") elements.back().second = {"uchar", "int", "int", "int"};
        bytes += (word == "format" ? big ? "format binary_big_endian 1.0" : "format binary_little_endian 1.0"
                                   : line) +
                 "\n";
    }
    bytes += "end_header\n";
    for (const auto& [rows, types] : elements) {
        for (int row = 0; row < rows; ++row) {
            for (const std::string& type : types) {
                double value = 0;
                lines >> value;
                append_typed(bytes, type, value, big);
            }
        }
    }
    return bytes;
}

}  // namespace

TEST_CASE("refined: seams, hard normals and parts of a box go on over its pieces") {
    const Mesh whole = load_text("box.obj", box);
    for (const Mesh& mesh : {whole, without_source(whole)}) {
        const Mesh out = refined_along(mesh, 2);
        CHECK(begins_with(out.positions, mesh.positions));
        CHECK(begins_with(out.uvs[0].values, mesh.uvs[0].values));
        CHECK(begins_with(out.normals.values, mesh.normals.values));
        // four edges and four diagonals, a vertex each between two rows, whatever meets there
        CHECK(out.positions.size() == 8 + 8 * 15);
        CHECK(out.normals.values == mesh.normals.values);
        CHECK(out.uvs[0].values.size() == 4 + 3 * 15);
        CHECK(out.faces.size() == 4 * 2 * 31 + 2);
        CHECK(std::ranges::count(out.faces, 4u) == 2);
        REQUIRE(out.parts.size() == 2);
        CHECK(out.parts[0] == Part{"side", 0, 0, 4 * 2 * 31});
        CHECK(out.parts[1] == Part{"ends", 1, 4 * 2 * 31, 2});
        CHECK(open_edges(out) == 0);
        CHECK((out.source == nullptr) == (mesh.source == nullptr));
        double worst = 0;
        for (std::size_t c = 0; c < 3 * 4 * 2 * 31; ++c)  // v goes with z
            take_worst(worst, std::abs(static_cast<double>(corner_value(out, out.uvs[0], c).y) -
                                       static_cast<double>(out.positions[out.corners[c]].z) / 16));
        CHECK(worst < 1e-7);
    }
}

TEST_CASE("refined: normals and tangents have unit length, colors and texture coordinates are linear") {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 8}};
    mesh.corners = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    mesh.faces.assign(4, 3);
    for (const glm::vec3& p : mesh.positions) {
        mesh.colors.push_back(glm::vec4(p / 8.0f, 1 - p.z / 16));
        mesh.normals.values.push_back(2.0f * glm::vec3(1, p.z / 8, 0));
        mesh.tangents.values.emplace_back(0, 0, 3, p.z > 4 ? -1 : 1);
    }
    mesh.normals.values[1] = glm::vec3(0);
    mesh.uvs.resize(1);
    for (const glm::vec3& p : mesh.positions) mesh.uvs[0].values.emplace_back(0.1f * p.z, 1 - p.x);
    const Mesh out = refined_along(mesh, 2, 2);
    REQUIRE(out.positions.size() > 60);
    CHECK(begins_with(out.normals.values, mesh.normals.values));
    for (std::size_t i = 4; i < out.positions.size(); ++i) {
        const glm::vec3 p = out.positions[i];
        CHECK(glm::length(out.colors[i] - glm::vec4(p / 8.0f, 1 - p.z / 16)) < 1e-6f);
        CHECK(glm::length(out.uvs[0].values[i] - glm::vec2(0.1f * p.z, 1 - p.x)) < 1e-6f);
        CHECK(glm::length(out.normals.values[i]) == doctest::Approx(1).epsilon(1e-6));
        CHECK(glm::length(glm::vec3(out.tangents.values[i]) - glm::vec3(0, 0, 1)) < 1e-6f);
        CHECK(std::abs(out.tangents.values[i].w) == 1);
    }
}

TEST_CASE("refined: a mesh that nothing is cut of keeps its source") {
    const Mesh mesh = load_text("box.obj", box);
    std::vector<std::uint32_t> parents;
    for (std::uint32_t t = 0; t < 12; ++t) parents.push_back(t);
    const Mesh out = refined(mesh, {{}, triangles(mesh), parents});
    check_same(out, mesh);
    CHECK(saved(out, "box.obj") == box);
}

TEST_CASE("refined: OBJ keeps its text, faces that count backwards count over the new vertices") {
    const Mesh mesh = load_text("box.obj", box);
    const Mesh out = refined_along(mesh, 2);
    check_same(out, refined_along(without_source(mesh), 2));
    const std::string text = saved(out, "out.obj");
    check_same(load_text("again.obj", text), out);
    for (const char* line : {"# a box\n", "v 0 1 16 # the last\n", "g side\ns 1\nusemtl red\n", "vn 0 -2 0\n",
                             "g ends\nusemtl blue\n", "f 5/1/6 6/2/6 7/3/6 8/4/6\n"})
        CHECK(text.find(line) != text.npos);
    CHECK(text.find("f 4/4/5 3/3/5 2/2/5 1/1/5\n") != text.npos);  // was all negative
    CHECK(count(text, "\nv ") == 8 + 120);
    CHECK(text.find("\nv ", text.find("\nvt ")) == text.npos);
    const std::string windows =
        saved(refined_along(load_text("box.obj", replaced(box, "\n", "\r\n")), 2), "out.obj");
    CHECK(windows == replaced(text, "\n", "\r\n"));
}

TEST_CASE("refined: OBJ colors, and normals that were split by a bend before") {
    Mesh mesh = load_text("c.obj",
                          "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nv 0 0 8 0 1 0.5\nvn 1 0 0\n"
                          "f 1//1 3//1 2//1\nf 1//1 2//1 4//1\nf 1//1 4//1 3//1\nf 2//1 3//1 4//1\n");
    VertexArrays bent = vertex_arrays(mesh);
    for (std::size_t i = 0; i < bent.normals.size(); ++i)
        bent.normals[i] = glm::normalize(glm::vec3(1, 0.25f * static_cast<float>(i), 0));
    mesh = with_vertex_arrays(mesh, bent);
    const Mesh out = refined_along(mesh, 2);
    check_same(out, refined_along(without_source(mesh), 2));
    check_same(reloaded(out, "again.obj"), out);
    CHECK(out.colors.size() == out.positions.size());
}

TEST_CASE("refined: PLY keeps all elements and properties, names from the nearer end") {
    const std::string text =
        "ply\nformat ascii 1.0\ncomment kept\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "property int id\nproperty float heat\nelement face 4\nproperty list uchar int vertex_indices\n"
        "property int kind\nelement mark 1\nproperty int a\nend_header\n"
        "0 0 0 0 0 0 7 0\n1 0 0 0 0 0 7 0\n0 1 0 0 0 0 7 0\n0 0 16 160 0 255 9 32\n"
        "3 0 2 1 5\n3 0 1 3 6\n3 0 3 2 7\n3 1 2 3 8\n77\n";
    const Mesh mesh = load_text("t.ply", text);
    const Mesh out = refined_along(mesh, 2);
    const Mesh alone = refined_along(without_source(mesh), 2);
    CHECK(out.positions == alone.positions);
    CHECK(out.corners == alone.corners);
    REQUIRE(out.positions.size() == 4 + 3 * 15);
    const std::string now = saved(out, "out.ply");
    CHECK(now.find("comment kept\nelement vertex 49\n") != now.npos);
    CHECK(now.find("element face 94\n") != now.npos);
    CHECK(now.find("end_header\n0 0 0 0 0 0 7 0\n1 0 0 0 0 0 7 0\n") != now.npos);
    CHECK(now.find("\n0 0 1 10 0 16 7 2\n") != now.npos);
    CHECK(now.find("\n0 0 12 120 0 191 9 24\n") != now.npos);
    CHECK(now.find("\n3 0 2 1 5\n") != now.npos);
    CHECK(now.ends_with(" 8\n77\n"));
    check_same(load_text("again.ply", now), out);
    CHECK(load_text("again.ply", now).warnings.empty());

    const Mesh bytes = refined_along(reloaded(without_source(mesh), "binary.ply"), 2);
    CHECK(bytes.positions == alone.positions);
    CHECK(bytes.corners == alone.corners);
    for (std::size_t i = 4; i < 49; ++i)  // of 0 to 255, as far as bytes go
        CHECK(bytes.colors[i].b == std::round(alone.colors[i].b * 255) / 255);
}

TEST_CASE("refined: PLY elements with a row for each face are left out, since the faces are others") {
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element texture_face 4\nproperty uchar tx\nproperty list uchar int corners\n"
        "comment of faces\nelement face 4\nproperty list uchar int vertex_indices\nelement mark 1\nproperty "
        "int a\n"
        "element more 4\nproperty int b\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n0 0 16\n1 3 0 1 2\n1 3 0 1 2\n1 3 0 1 2\n1 3 0 1 2\n"
        "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n77\n1\n2\n3\n4\n";
    const Mesh mesh = load_text("t.ply", text);
    const Mesh out = refined_along(mesh, 2);
    REQUIRE(out.warnings.size() == 2);
    CHECK(out.warnings[0].starts_with("element texture_face is left out: "));
    CHECK(out.warnings[1].starts_with("element more is left out: "));
    const std::string now = saved(out, "out.ply");
    CHECK(now.find(
              "property float z\ncomment of faces\nelement face 94\nproperty list uchar int vertex_indices\n"
              "element mark 1\nproperty int a\nend_header\n") != now.npos);
    CHECK(now.ends_with("\n77\n"));
    check_same(load_text("again.ply", now), out);
    const Mesh unended = load_text("t.ply", replaced(text, "3\n4\n", "3\n4"));
    CHECK(saved(refined_along(unended, 2), "out.ply") == now);
    // They stay where nothing is cut.
    CHECK(saved(mesh, "same.ply") == text);
}

TEST_CASE("refined: a binary PLY gets the numbers that its text gets, in every type and byte order") {
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty float z\n"
        "property char a\nproperty uchar b\nproperty short c\nproperty ushort d\nproperty int e\n"
        "property uint f\nproperty float g\nproperty double h\n"
        "property float nx\nproperty float ny\nproperty float nz\n"
        "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 -100 200 -30000 60000 -2000000 4000000000 0.5 0.25 0 0 -1\n"
        "1 0 0 -100 200 -30000 60000 -2000000 4000000000 0.5 0.25 1 0 0\n"
        "0 1 0 -100 200 -30000 60000 -2000000 4000000000 0.5 0.25 0 1 0\n"
        "0 0 16 100 10 30000 10 2000000 1 16.5 32.25 0 0 1\n"
        "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    const std::string expected = saved(refined_along(load_text("t.ply", text), 2), "out.ply");
    REQUIRE(expected.find("\n0 0 1 -100 200 -30000 60000 -2000000 4000000000 1.5 2.25 ") != expected.npos);
    for (const bool big : {false, true}) {
        const std::string bytes = saved(refined_along(load_text("b.ply", binary_ply(text, big)), 2), "b.ply");
        CHECK(bytes == binary_ply(expected, big));
    }
}

TEST_CASE("refined: a PLY whose types are too small for the new vertices is written anew") {
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty short x\nproperty short y\nproperty short z\n"
        "element face 4\nproperty list uchar uchar vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n0 0 5\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    const Mesh out = refined_along(load_text("t.ply", text), 2, 9);
    CHECK(out.positions.size() > 256);
    CHECK(open_edges(out) == 0);
    check_same(reloaded(out, "again.ply"), out);
}

TEST_CASE("refined: STL keeps header, solids and attributes") {
    const Mesh solid = load_text("box.obj", box);
    std::string bytes = saved(without_source(solid), "box.stl");
    std::memcpy(bytes.data(), "a header", 8);
    for (std::size_t f = 0; f < 12; ++f) bytes[84 + 50 * f + 48] = static_cast<char>('a' + f);
    const Mesh out = refined_along(load_text("box.stl", bytes), 2);
    const std::string now = saved(out, "out.stl");
    REQUIRE(out.faces.size() == 4 * 2 * 31 + 4);
    CHECK(now.size() == 84 + 50 * out.faces.size());
    CHECK(now.starts_with("a header"));
    for (std::size_t f = 0; f < 31; ++f) CHECK(now[84 + 50 * f + 48] == 'a');
    CHECK(now[84 + 50 * 31 + 48] == 'b');
    CHECK(now.substr(now.size() - 50) == bytes.substr(bytes.size() - 50));
    CHECK(open_edges(out) == 0);
    check_same(load_text("again.stl", now), out);

    const std::string text =
        "solid one\n  facet normal 0 0 -1\n    outer loop\n      vertex 0 0 0\n      vertex 0 1 0\n"
        "      vertex 1 0 0\n    endloop\n  endfacet\nendsolid one\nsolid two\n"
        "facet normal 1 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 0 16 endloop endfacet\n"
        "facet normal 1 0 0 outer loop vertex 0 0 0 vertex 0 0 16 vertex 0 1 0 endloop endfacet\n"
        "facet normal 1 0 0 outer loop vertex 1 0 0 vertex 0 1 0 vertex 0 0 16 endloop endfacet\n"
        "endsolid two\n";
    const Mesh lines = refined_along(load_text("t.stl", text), 2);
    const std::string after = saved(lines, "out.stl");
    CHECK(after.starts_with(text.substr(0, text.find("solid two") + 9)));
    CHECK(after.ends_with("endsolid two\n"));
    REQUIRE(lines.parts.size() == 2);
    CHECK(lines.parts[0] == Part{"one", -1, 0, 1});
    CHECK(lines.parts[1] == Part{"two", -1, 1, 3 * 31});
    CHECK(open_edges(lines) == 0);
    check_same(load_text("again.stl", after), lines);
}

TEST_CASE("refined: banana.obj, and its file holds what is there") {
    check_refined_model("banana.obj", 1);
}

TEST_CASE("refined: blub_open.obj, and its file holds what is there") {
    check_refined_model("blub_open.obj", 2);
}

TEST_CASE("refined: koala.obj, and its file holds what is there") {
    check_refined_model("koala.obj", 2);
}

TEST_CASE("refined: fuze.ply, and its file holds what is there") {
    check_refined_model("fuze.ply", 2);
}

TEST_CASE("refined: lh_trochanterfemur.stl, and its file holds what is there") {
    check_refined_model("lh_trochanterfemur.stl", 2);
}

TEST_CASE("refined: wine_bottle.glb, and its file holds what is there") {
    check_refined_model("wine_bottle.glb", 1);
}

TEST_CASE("refined: log_01.glb, and its file holds what is there") {
    check_refined_model("log_01.glb", 1);
}

TEST_CASE("refined: cushion_02.glb, and its file holds what is there") {
    check_refined_model("cushion_02.glb", 0);
}

TEST_CASE("refined: insect_leg.glb, and its file holds what is there") {
    check_refined_model("insect_leg.glb", 0);
}

TEST_CASE("refined: WaterBottle.gltf, and its file holds what is there") {
    check_refined_model("WaterBottle.gltf", 1);
}

TEST_CASE("refined: vertices between new vertices are those of two refinements, one after the other") {
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float heat\n"
        "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 0 0 0 1\n1 0 0 0 0 80 2\n0 1 0 80 0 0 4\n0 0 8 160 0 240 8\n"
        "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    const std::string loose = saved(without_its_file(load_text("box.obj", box)), "box.stl");
    for (const auto& file : {std::pair{"box.obj", box}, {"t.ply", ply}, {"box.stl", loose}}) {
        const std::string name = file.first, &text = file.second;
        CAPTURE(name);
        const Mesh mesh = load_text(name, text), half = refined(mesh, halves(mesh).pieces());
        const Mesh twice = refined(half, halves(half).pieces());
        const Mesh once = refined(mesh, quarters(mesh).pieces());
        CHECK(once.source != nullptr);
        CHECK(open_edges(once) == 0);
        CHECK(once.faces == twice.faces);
        CHECK(once.parts == twice.parts);
        REQUIRE(once.corners.size() == twice.corners.size());
        std::size_t other = 0;
        for (std::size_t c = 0; c < once.corners.size(); ++c) {
            const std::uint32_t a = once.corners[c], b = twice.corners[c];
            other += once.positions[a] != twice.positions[b];
            other += corner_value(once, once.normals, c) != corner_value(twice, twice.normals, c);
            if (!once.colors.empty()) other += once.colors[a] != twice.colors[b];
            for (std::size_t s = 0; s < once.uvs.size(); ++s)
                other += corner_value(once, once.uvs[s], c) != corner_value(twice, twice.uvs[s], c);
        }
        CHECK(other == 0);
        if (text == ply) CHECK(saved(once, "out.ply") == saved(twice, "out.ply"));
    }
}

TEST_CASE("refined: pieces of another mesh are refused") {
    const Mesh mesh = without_source(load_text("box.obj", box));
    const MeshRecipe good = recipe(mesh, 2);
    const auto told = [&](auto&& break_it) {
        MeshRecipe bad = good;
        break_it(bad);
        const std::string message = error_of([&] { (void)refined(mesh, bad.pieces()); });
        CHECK(message.starts_with("refined: "));
        CHECK(message.ends_with("; give what was made for this mesh"));
        return message;
    };
    using R = MeshRecipe;
    CHECK(told([](R& r) { r.vertices[3].t = 1; }).find("new vertex 3 does not lie") != std::string::npos);
    CHECK(told([](R& r) { r.vertices[3].t = std::nan(""); }).find("new vertex 3") != std::string::npos);
    CHECK(told([](R& r) { r.vertices[4].a = 12; }).find("new vertex 4") != std::string::npos);
    // between new vertices of edges that no triangle has all of
    CHECK(told([](R& r) { r.vertices[60] = {8, 8 + 45, 0.5}; }).find("new vertex 60") != std::string::npos);
    CHECK(told([](R& r) { r.made.triangles[5] = 7; }).find("piece 1: vertex 7") != std::string::npos);
    CHECK(told([](R& r) { r.made.triangles[5] = 128; }).find("piece 1: vertex 128") != std::string::npos);
    CHECK(told([](R& r) { r.made.triangles.pop_back(); }).find("corners for") != std::string::npos);
    CHECK(told([](R& r) { r.made.parents.back() = 12; }).find("triangle 12") != std::string::npos);
    CHECK(told([](R& r) { r.made.parents[40] = 0; }).find("piece 40 is of triangle 0") != std::string::npos);
    CHECK(told([](R& r) {
              r.made.parents.pop_back();
              r.made.triangles.resize(3 * r.made.parents.size());
          }).find("11 of 12 triangles") != std::string::npos);
}

TEST_CASE("refined: numbers of a text PLY that are doubles stay so") {
    const Mesh mesh = load_text(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property double stamp\nelement face 1\nproperty list uchar int vertex_indices\n"
        "property double share\nend_header\n0 0 0 1234567890.123\n1 0 0 1234567890.123\n"
        "0 1 0 1234567890.123\n3 0 1 2 0.123456789012\n");
    const Mesh half = refined(mesh, halves(mesh).pieces());
    const std::string text = saved(half, "b.ply");
    CHECK(half.positions.size() > 3);
    CHECK(count(text, "1234567890.123\n") == half.positions.size());
    CHECK(count(text, "0.123456789012\n") == half.faces.size());
}
