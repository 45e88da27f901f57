// SPDX-License-Identifier: MIT
#include "files.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>

using namespace goffer::mesh;
using namespace goffer::test;

namespace {

/// Everything that has to survive: comments, odd blanks, colors, w, quads, groups, unknown statements, CRLF.
const std::string rich_obj =
    "# made by hand\r\n"
    "mtllib missing.mtl\r\n"
    "o thing\r\n"
    "v 0 0 0 1.0\r\n"
    "v  +1.50  0.0\t0 # second\r\n"
    "v 1 1 0 0.25 0.5 0.75\r\n"
    "v 0 1e0 0\r\n"
    "vp 0.1\r\n"
    "vt 0 0\r\nvt 1 0\r\nvt 1 1 0\r\n"
    "vn 0 0 1\r\nvn 0.00 1 0\r\n"
    "s 1\r\n"
    "usemtl red paint\r\n"
    "f 1/1/1 2/2/1 3/3/2 4//2\r\n"
    "g other\r\n"
    "usemtl\tblue\r\n"
    "f -4/-3/-2 -3/-2/-2 -1/-1/-1\r\n"
    "l 1 2\r\np 1\r\n"
    "# last line without an end";

/// `mesh` with vertex 1 moved and every entry's normal made different.
Mesh with_one_moved(const Mesh& mesh) {
    VertexArrays r = vertex_arrays(mesh);
    r.positions[1] = {2.5f, 1e-7f, 0.1f};
    for (std::size_t i = 0; i < r.normals.size(); ++i) r.normals[i] = {0.0f, 0.5f, static_cast<float>(i)};
    return with_vertex_arrays(mesh, r);
}

}  // namespace

TEST_CASE("obj: everything is read in file order") {
    const Mesh mesh = load_text("a.obj", rich_obj);
    CHECK(mesh.positions == std::vector<glm::vec3>{{0, 0, 0}, {1.5f, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(mesh.faces == std::vector<std::uint32_t>{4, 3});
    CHECK(mesh.corners == std::vector<std::uint32_t>{0, 1, 2, 3, 0, 1, 3});
    REQUIRE(mesh.uvs.size() == 1);
    CHECK(mesh.uvs[0].values == std::vector<glm::vec2>{{0, 0}, {1, 0}, {1, 1}});
    CHECK(mesh.uvs[0].corners == std::vector<std::uint32_t>{0, 1, 2, Attribute<glm::vec2>::none, 0, 1, 2});
    CHECK(mesh.normals.values == std::vector<glm::vec3>{{0, 0, 1}, {0, 1, 0}});
    CHECK(mesh.normals.corners == std::vector<std::uint32_t>{0, 0, 1, 1, 0, 0, 1});
    CHECK(mesh.colors ==
          std::vector<glm::vec4>{glm::vec4(1), glm::vec4(1), {0.25f, 0.5f, 0.75f, 1}, glm::vec4(1)});
    CHECK(mesh.parts == std::vector<Part>{{"thing", 0, 0, 1}, {"other", 1, 1, 1}});
    CHECK(mesh.materials == std::vector<Material>{{.name = "red paint"}, {.name = "blue"}});
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].find("missing.mtl") != std::string::npos);
}

TEST_CASE("obj: an unchanged mesh is written to the byte") {
    const Mesh mesh = load_text("a.obj", rich_obj);
    CHECK(saved(mesh, "b.obj") == rich_obj);
    CHECK(saved(with_vertex_arrays(mesh, vertex_arrays(mesh)), "b.obj") == rich_obj);
}

TEST_CASE("obj: only lines that changed are written anew") {
    Mesh mesh = load_text("a.obj", rich_obj);
    mesh.positions[1] = {2.5f, 1e-7f, 0.1f};
    mesh.positions[2].z = -1;
    mesh.normals.values[1] = {1, 0, 0};
    std::string expected = replaced(rich_obj, "v  +1.50  0.0\t0 # second", "v  2.5  1e-07\t0.1 # second");
    expected = replaced(expected, "v 1 1 0 0.25", "v 1 1 -1 0.25");
    CHECK(saved(mesh, "b.obj") == replaced(expected, "vn 0.00 1 0", "vn 1 0 0"));
}

TEST_CASE("obj: split normals follow the last one, and faces refer to them") {
    // Records: vertices 0..3, each with one normal.
    const Mesh mesh = with_one_moved(load_text("a.obj", rich_obj));
    std::string expected = replaced(rich_obj, "v  +1.50  0.0\t0 #", "v  2.5  1e-07\t0.1 #");
    expected = replaced(expected, "vn 0 0 1\r\nvn 0.00 1 0\r\n",
                        "vn 0 0.5 0\r\nvn 0 0.5 2\r\nvn 0 0.5 1\r\nvn 0 0.5 3\r\n");
    expected = replaced(expected, "f 1/1/1 2/2/1 3/3/2 4//2", "f 1/1/1 2/2/3 3/3/2 4//4");
    expected = replaced(expected, "f -4/-3/-2 -3/-2/-2 -1/-1/-1", "f -4/-3/1 -3/-2/-2 -1/-1/-1");
    CHECK(saved(mesh, "b.obj") == expected);
    const Mesh again = load_text("b.obj", expected);
    CHECK(again.positions == mesh.positions);
    CHECK(again.normals == mesh.normals);
}

TEST_CASE("obj: references that count backwards from before the last normal stay right") {
    const std::string text =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf -3//-1 -2//-1 -1//-1\nv 5 5 5\nvn 0 1 0\nf 1//-1 3//-2 "
        "-1//-1\n";
    const Mesh mesh = with_one_moved(load_text("a.obj", text));
    const Mesh again = reloaded(mesh, "b.obj");
    CHECK(again.normals.values.size() == 5);
    CHECK(again.positions == mesh.positions);
    CHECK(vertex_arrays(again).normals == vertex_arrays(mesh).normals);
}

TEST_CASE("obj: a mesh changed beyond bending is written anew") {
    Mesh mesh = load_text("a.obj", rich_obj);
    mesh.materials[1].base_color = {0.25f, 0.5f, 1.0f, 0.5f};
    mesh.parts[0].name = "new\nname";
    const Mesh again = reloaded(mesh, "b c.obj");
    CHECK(again.corners == mesh.corners);
    CHECK(again.uvs == mesh.uvs);
    CHECK(again.normals == mesh.normals);
    CHECK(again.colors == mesh.colors);
    CHECK(again.materials == mesh.materials);
    CHECK(again.parts[0].name == "new_name");
    CHECK(again.warnings.empty());
}

TEST_CASE("obj: materials that share a name stay apart") {
    Mesh mesh = load_text("a.obj", triangle_obj);
    mesh.materials = {{.name = "a"}, {.name = "a"}, {.name = ""}};
    mesh.parts = {{"p", 1, 0, 1}};
    const Mesh again = reloaded(mesh, "b.obj");
    REQUIRE(again.materials.size() == 1);
    CHECK(again.materials[0].name == "a_2");
}

TEST_CASE("obj: base colors come from the material file") {
    const Folder folder;
    folder.write("my colors.mtl",
                 "newmtl red paint\nKd 1 0.5 0\nd 0.25\nmap_Kd red.png\n\nnewmtl unused\nKd 0 0 0\n");
    const Mesh mesh = load(folder.write("a.obj", replaced(rich_obj, "missing.mtl", "my colors.mtl")));
    CHECK(mesh.materials[0].base_color == glm::vec4(1, 0.5f, 0, 0.25f));
    CHECK(mesh.materials[1].base_color == Material{}.base_color);
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(tells(mesh.warnings[0], "my colors.mtl: names 'red.png', which is not there"));
}

TEST_CASE("obj: base colors are no brighter than white and no darker than black") {
    const Folder folder;
    folder.write("missing.mtl", "newmtl red paint\nKd 1.5 -0.5 0.5\nd 1.5\n");
    const Mesh mesh = load(folder.write("a.obj", rich_obj));
    CHECK(mesh.materials[0].base_color == glm::vec4(1, 0, 0.5f, 1));
}

TEST_CASE("obj: the way to the material file stays right in another folder") {
    const Folder from, to;
    from.write("missing.mtl", "newmtl blue\nKd 0 0 1\n");
    const Mesh mesh = load(from.write("a.obj", rich_obj));
    save(mesh, from / "b.obj");
    CHECK(bytes_of(from / "b.obj") == rich_obj);
    save(mesh, to / "b.obj");
    const Mesh gray = load(to / "b.obj");
    REQUIRE(gray.warnings.size() == 1);
    CHECK(gray.warnings[0].find(": mtllib names") != std::string::npos);
    const Mesh moved = load(to / "b.obj", {.allow_outside = true});
    CHECK(moved.warnings.empty());
    CHECK(moved.materials == mesh.materials);
    CHECK(bytes_of(to / "b.obj").find("/missing.mtl\r\no thing") != std::string::npos);
}

TEST_CASE("obj: continued lines, a byte order mark and old line ends are read and kept") {
    const std::string text =
        "\xEF\xBB\xBFv 0 0 0\rv 1 \\\r 0 0\rv 0 1 0\r# a path C:\\\rv 1 1 \\\r\n0\rf 1 2 \\\r 4 3\r";
    const Mesh mesh = load_text("a.obj", text);
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.faces == std::vector<std::uint32_t>{4});
    CHECK(saved(mesh, "b.obj") == text);
    Mesh moved = mesh;
    moved.positions[1] = {4, 5, 6};
    CHECK(saved(moved, "b.obj") == replaced(text, "v 1 \\\r 0 0", "v 4 \\\r 5 6"));
}

TEST_CASE("obj: numbers are written so that they read back exactly") {
    Mesh mesh = load_text("a.obj", triangle_obj);
    for (const float value : {0.1f, 1.0f / 3, 1e-38f, 3.4028235e38f, 1.17549435e-38f, -16777217.0f, 1e-45f}) {
        mesh.positions[0] = {value, -value, std::nextafter(value, 0.0f)};
        CHECK(reloaded(mesh, "b.obj").positions == mesh.positions);
    }
}

TEST_CASE("obj: what cannot be read is told with its line") {
    const auto error = [](const std::string& from, const std::string& to, const std::string& what) {
        const std::string message = load_error("a.obj", replaced(rich_obj, from, to));
        INFO(message);
        return tells(message, what);
    };
    CHECK(error("+1.50", "1,50", "line 5: '1,50' is not a number"));
    CHECK(error("+1.50", "+-1", "line 5: '+-1' is not a number"));
    CHECK(error("+1.50", "0x10", "line 5: '0x10' is not a number"));
    CHECK(error("+1.50", "nan", "line 5: vertex x is not finite"));
    CHECK(error("1e0", "-inf", "line 7: vertex y is not finite"));
    CHECK(error("1e0", "1e39", "line 7: vertex y is not finite"));
    CHECK(error("v 0 1e0 0", "v 0 1", "line 7: v has 2 numbers and needs 3"));
    CHECK(error("0.75", "red", "line 6: 'red' is not a number"));
    CHECK(error("vn 0.00 1 0", "vn 0 NaN 0", "line 13: the normal is not finite"));
    CHECK(error("vt 1 1 0", "vt", "line 11: vt has 0 numbers"));
    CHECK(error("f 1/1/1", "f 0/1/1", "line 16: vertex index '0' is out of range"));
    CHECK(error("f 1/1/1", "f 5/1/1", "line 16: vertex index '5' is out of range"));
    CHECK(error("f 1/1/1", "f 1/4/1", "line 16: texture coordinate index '4' is out of range"));
    CHECK(error("f 1/1/1", "f 1/1/3", "line 16: normal index '3' is out of range"));
    CHECK(error("f 1/1/1", "f 99999999999999999999/1/1", "line 16: vertex index"));
    CHECK(error("f 1/1/1", "f /1/1", "line 16: face corner '/1/1' names no vertex"));
    CHECK(error("f 1/1/1", "f 1.5", "line 16: vertex index '1.5' is not a whole number"));
    CHECK(error("f -4/-3/-2", "f -5/-3/-2", "line 19: vertex index '-5' is out of range"));
    CHECK(error("f -4/-3/-2", "f x", "line 19: vertex index 'x'"));
    CHECK(error("s 1", std::string("s \0", 3), "line 14: binary data"));
}

TEST_CASE("obj: a file without a mesh is refused") {
    CHECK(tells(load_error("a.obj", "# nothing\n"), "has no vertices"));
    CHECK(tells(load_error("a.obj", "hello world"), "has no vertices"));
    CHECK(tells(load_error("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), "has no faces"));
    CHECK(tells(load_error("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n"), "has no faces"));
}

TEST_CASE("obj: faces of two corners are left out with a warning, and stay in the file") {
    const std::string text = triangle_obj + "f 1 2\nf 3 2 1\n";
    Mesh mesh = load_text("a.obj", text);
    CHECK(mesh.faces.size() == 2);
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].find("1 face has fewer than 3 corners") == 0);
    mesh.positions[0].x = 8;
    CHECK(saved(mesh, "b.obj") == replaced(text, "v 0 0 0", "v 8 0 0"));
}

TEST_CASE("obj: a texture coordinate that is not finite counts as 0, with a warning") {
    const Mesh mesh = load_text("a.obj", replaced(triangle_obj, "f 1 2 3", "vt nan 1\nf 1/1 2/1 3/1"));
    CHECK(mesh.uvs[0].values[0] == glm::vec2(0, 1));
    CHECK(mesh.warnings.size() == 1);
}

TEST_CASE("obj: normals that no face uses are no attribute, and stay in the file") {
    const std::string text = "vn 0 0 1\n" + triangle_obj;
    Mesh mesh = load_text("a.obj", text);
    CHECK(mesh.normals.empty());
    CHECK(mesh.uvs.empty());
    CHECK(saved(mesh, "b.obj") == text);
}

TEST_CASE("obj: numbers with the sign before the letter of the exponent are read as others read them") {
    const Mesh mesh =
        load_text("a.obj", "v 1e+2 2.e+1 3.1+e2\nv +1e-2 +2.e-1 -3.1-E2\nv 1E2 +2. 0\nf 1 2 3\n");
    CHECK(mesh.positions[0] == glm::vec3(100, 20, 3.1f));
    CHECK(mesh.positions[1] == glm::vec3(0.01f, 0.2f, -3.1f));
    CHECK(mesh.positions[2] == glm::vec3(100, 2, 0));
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].starts_with("2 numbers are written like 3.1+e2"));
    for (const char* bad : {"+e2", "3.1+e", "3.1+e2x", "3.1+f2"})
        CHECK(tells(load_error("a.obj", std::string("v 0 0 ") + bad + "\n"), "is not a number"));
}

TEST_CASE("obj: a material for each face takes no more than a moment, to read and to write") {
    constexpr int many = 200000;
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < many; ++i) text += "usemtl m" + std::to_string(i) + "\nf 1 2 3\n";
    const auto start = std::chrono::steady_clock::now();
    Mesh mesh = load_text("a.obj", text);
    CHECK(mesh.materials.size() == many);
    for (Material& material : mesh.materials) material.name = "same";
    mesh.source = nullptr;
    CHECK(saved(mesh, "b.obj").find("usemtl same_200000\n") != std::string::npos);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(10));
}

TEST_CASE("obj: numbers beyond float's range are 0 or an infinity by their size, however they are written") {
    const auto triangle = [](const std::string& x) { return "v " + x + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"; };
    const std::string zeros(60, '0');
    for (const std::string& small :
         std::vector<std::string>{"0.01e-60", "10.0e-60", "." + zeros + "1", "000.0" + zeros + "1", "-1e-60",
                                  "1e-99999999999999999999", "+0.5E-70"}) {
        CAPTURE(small);
        CHECK(load_text("a.obj", triangle(small)).positions[0].x == 0);
    }
    for (const std::string& large :
         std::vector<std::string>{"10.0e60", "0.01e60", "1" + zeros, "0.1e99999999999999999999", "-1e60"}) {
        CAPTURE(large);
        CHECK(load_error("a.obj", triangle(large)).find("not finite") != std::string::npos);
    }
}

TEST_CASE("obj: faces without a material get a name that no material has, and none is blank") {
    Mesh mesh = load_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\nf 2 1 3\n");
    mesh.source = nullptr;
    mesh.materials.resize(2);
    mesh.materials[0].name = "none";
    mesh.materials[1].name = "  ";
    mesh.parts = {{"a", 0, 0, 1}, {"b", -1, 1, 1}, {"c", 1, 2, 1}};
    const std::string text = saved(mesh, "b.obj");
    CHECK(text.find("usemtl none\n") < text.find("usemtl none_2\n"));
    CHECK(text.find("usemtl none_2\n") < text.find("usemtl material\n"));
    CHECK(text.find("usemtl material\n") != text.npos);
}

TEST_CASE("obj: a material file may be named as on Windows") {
    const Folder folder;
    std::filesystem::create_directory(folder / "sub");
    folder.write("sub/m.mtl", "newmtl red\nKd 1 0 0\n");
    const Mesh mesh =
        load(folder.write("a.obj", "mtllib sub\\m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n"));
    CHECK(mesh.warnings.empty());
    REQUIRE(mesh.materials.size() == 1);
    CHECK(mesh.materials[0].base_color.r == 1);
}
