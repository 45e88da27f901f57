// SPDX-License-Identifier: MIT
#include "files.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cctype>
#include <cstring>
#include <limits>

using namespace goffer::mesh;
using namespace goffer::test;

namespace {

const std::string text =
    "solid  left part\n"
    "  facet normal 0 0 9\n    outer loop\n"
    "      vertex 0 0 0\n      vertex 1.50e0 0 0\n      vertex 0 1 0\n"
    "    endloop\n  endfacet\n"
    "endsolid left part\n"
    "SOLID empty\nENDSOLID\n"
    "solid right\n"
    "facet normal 0 0 1 outer loop vertex 0 0 1 vertex 1 0 1 vertex 0 1 1 endloop endfacet\n"
    "endsolid right\n";

/// Two facets, with odd normals and attribute bytes; the header may say "solid".
std::string binary(const std::string& name) {
    std::string bytes = name;
    bytes.resize(80, '#');
    append_number(bytes, std::uint32_t{2}, false);
    for (const float z : {0.0f, 1.0f}) {
        for (const float value : {0.0f, 0.0f, 9.0f, 0.0f, 0.0f, z, 1.5f, 0.0f, z, 0.0f, 1.0f, z})
            append_number(bytes, value, false);
        bytes += z == 0 ? "ab" : "cd";
    }
    return bytes;
}

}  // namespace

TEST_CASE("stl: text is read facet after facet, solids are parts") {
    const Mesh mesh = load_text("a.stl", text);
    CHECK(mesh.positions ==
          std::vector<glm::vec3>{{0, 0, 0}, {1.5f, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
    CHECK(mesh.corners == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5});
    CHECK(mesh.faces == std::vector<std::uint32_t>{3, 3});
    CHECK(mesh.parts == std::vector<Part>{{"left part", -1, 0, 1}, {"", -1, 1, 0}, {"right", -1, 1, 1}});
    CHECK(mesh.normals.empty());
    std::string capitals = text;
    for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    CHECK(load_text("a.stl", capitals).positions == mesh.positions);
}

TEST_CASE("stl: binary is read, even if it says solid") {
    for (const char* name : {"made by hand", "solid but binary"}) {
        const Mesh mesh = load_text("a.stl", binary(name));
        CHECK(mesh.positions ==
              std::vector<glm::vec3>{{0, 0, 0}, {1.5f, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1.5f, 0, 1}, {0, 1, 1}});
        CHECK(mesh.corners == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5});
        CHECK(mesh.warnings.empty());
    }
}

TEST_CASE("stl: one facet is enough of a binary file, even if that says solid") {
    std::string one = binary("solid but binary").substr(0, 84 + 50);
    one[80] = 1;
    CHECK(load_text("a.stl", one).corners == std::vector<std::uint32_t>{0, 1, 2});
}

TEST_CASE("stl: an unchanged mesh is written to the byte") {
    for (const std::string& bytes : {text, binary("x"), binary("solid"), binary("x") + "tail"})
        CHECK(saved(load_text("a.stl", bytes), "b.stl") == bytes);
}

TEST_CASE("stl: a byte order mark before text is passed over, and kept") {
    const std::string marked = "\xEF\xBB\xBF" + text;
    Mesh mesh = load_text("a.dat", marked);
    CHECK(mesh.positions == load_text("a.stl", text).positions);
    CHECK(saved(mesh, "b.stl") == marked);
    mesh.positions[3] = {0, 0, 3};
    CHECK(saved(mesh, "b.stl").starts_with("\xEF\xBB\xBFsolid  left part\n"));
}

TEST_CASE("stl: a facet that moves gets its new normal, the others stay as they are") {
    Mesh mesh = load_text("a.stl", text);
    mesh.positions[0] = {0, 0, 1};
    mesh.positions[1] = {0, 1, 1};
    mesh.positions[2] = {0, 0, 2};
    std::string expected = replaced(text, "normal 0 0 9", "normal 1 0 0");
    expected = replaced(expected, "      vertex 0 0 0\n      vertex 1.50e0 0 0\n      vertex 0 1 0\n",
                        "      vertex 0 0 1\n      vertex 0 1 1\n      vertex 0 0 2\n");
    CHECK(saved(mesh, "b.stl") == expected);

    mesh = load_text("a.stl", binary("solid"));
    mesh.positions[0] = {0, -1, 0};
    const std::string bytes = saved(mesh, "b.stl");
    CHECK(bytes.substr(0, 84) == binary("solid").substr(0, 84));
    CHECK(bytes.substr(132) == binary("solid").substr(132));
    float z = 0;
    std::memcpy(&z, bytes.data() + 92, 4);
    CHECK(z == 1.0f);
    CHECK(load_text("b.stl", bytes).positions == mesh.positions);
}

TEST_CASE("stl: polygons of another file become triangles, with unit normals or none") {
    const Mesh mesh = load_text("a.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\nf 1 1 2\n");
    const std::string bytes = saved(mesh, "b.stl");
    REQUIRE(bytes.size() == 84 + 3 * 50);
    std::array<float, 12> facet;
    std::memcpy(facet.data(), bytes.data() + 84 + 50, 48);
    CHECK(facet == std::array<float, 12>{0, 0, 1, 0, 0, 0, 2, 2, 0, 0, 2, 0});
    std::memcpy(facet.data(), bytes.data() + 84 + 100, 48);
    CHECK(facet == std::array<float, 12>{0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0});
    CHECK(bytes.substr(132, 2) == std::string(2, '\0'));
}

TEST_CASE("stl: what cannot be read in text is told with its line") {
    const auto error = [](const std::string& from, const std::string& to, const std::string& what) {
        const std::string message = load_error("a.stl", replaced(text, from, to));
        INFO(message);
        return tells(message, what);
    };
    CHECK(error("1.50e0", "1.5o", "line 5: '1.5o' is not a number"));
    CHECK(error("1.50e0", "nan", "line 5: vertex coordinate 'nan' is not finite"));
    CHECK(error("1.50e0", "1e40", "line 5: vertex coordinate"));
    CHECK(error("      vertex 0 1 0\n", "", "line 6: 'endloop' stands where vertex"));
    CHECK(error("    endloop", "      vertex 0 1 1\n    endloop", "line 7: 'vertex' stands where endloop"));
    CHECK(error("endsolid right\n", "", "the file ends where facet or endsolid"));
    CHECK(error("SOLID empty", "solid_empty", "line 10: 'solid_empty' stands where solid"));
    for (std::size_t size = 30; size < text.find("endsolid"); size += 7)
        CHECK(tells(load_error("a.stl", text.substr(0, size)), ": line "));
    CHECK(tells(load_error("a.stl", "solid nothing\nendsolid nothing\n"), "no facets"));
}

TEST_CASE("stl: what cannot be read in binary is told with its facet") {
    std::string bytes = binary("x");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(bytes.data() + 84 + 50 + 20, &nan, 4);
    CHECK(tells(load_error("a.stl", bytes), "facet 1 (counted from 0): a vertex coordinate is not finite"));
    CHECK(tells(load_error("a.stl", binary("x").substr(0, 180)), "says 2 facets, but there are bytes for 1"));
    CHECK(tells(load_error("a.stl", binary("solid").substr(0, 180)), "says 2 facets"));
    CHECK(tells(load_error("a.stl", binary("x").substr(0, 50)), "50 bytes"));
    CHECK(tells(load_error("a.stl", std::string(84, '\0')), "no facets"));
    CHECK(load_text("a.stl", binary("x") + "tail").warnings.size() == 1);
}
