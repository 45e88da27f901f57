// SPDX-License-Identifier: MIT
#include "files.hpp"

#include <doctest/doctest.h>

using namespace goffer::mesh;
using namespace goffer::test;

namespace {

/// Normals, colors, unknown properties and elements of all types and both spellings, lists before and behind.
const std::string header =
    "ply\nformat ascii 1.0\ncomment made by hand\nobj_info kept\n"
    "element vertex 4\n"
    "property uint8 label\nproperty float x\nproperty float32 y\nproperty double z\n"
    "property list uchar short odd\n"
    "property float nx\nproperty float ny\nproperty float nz\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    "element camera 1\nproperty float64 focus\nproperty int8 a\nproperty int16 b\nproperty ushort c\n"
    "property uint d\n"
    "element face 2\nproperty uint16 flags\nproperty list uint8 int32 vertex_indices\n"
    "property list uchar float texcoord\n"
    "element empty 7\n"
    "end_header\n";
const std::string body =
    "1 0 0 0.00 0 0 0 1 255 0 51\n"
    "2 1.50 0 0 2 -7 8 0 0 1 0 0 0\n"
    "\n"
    "3 1 1 0 0 0 0 1 0 255 0\n"
    "4  0 1 0 0 0 1 0 0 0 255\n"
    "35.5 -1 -300 60000 4000000000\n"
    "9 4 0 1 2 3 8 0 0 1 0 1 1 0 1\n"
    "9 3 0 2 3 0\n";
const std::string rich_ply = header + body;

/// The numbers of the body of `rich`, as bytes of the types in its header.
struct Binary {
    bool big;
    std::string bytes;
    template <class T>
    Binary& put(T value) {
        append_number(bytes, value, big);
        return *this;
    }
    template <class T, class... Values>
    Binary& all(Values... values) {
        (put(static_cast<T>(values)), ...);
        return *this;
    }
};

std::string rich_binary(bool big) {
    Binary b{big, replaced(header, "ascii", big ? "binary_big_endian" : "binary_little_endian")};
    using u8 = std::uint8_t;
    b.all<u8>(1).all<float>(0, 0).all<double>(0).all<u8>(0).all<float>(0, 0, 1).all<u8>(255, 0, 51);
    b.all<u8>(2).all<float>(1.5, 0).all<double>(0).all<u8>(2).all<std::int16_t>(-7, 8);
    b.all<float>(0, 0, 1).all<u8>(0, 0, 0);
    b.all<u8>(3).all<float>(1, 1).all<double>(0).all<u8>(0).all<float>(0, 0, 1).all<u8>(0, 255, 0);
    b.all<u8>(4).all<float>(0, 1).all<double>(0).all<u8>(0).all<float>(0, 1, 0).all<u8>(0, 0, 255);
    b.all<double>(35.5)
        .all<std::int8_t>(-1)
        .all<std::int16_t>(-300)
        .all<std::uint16_t>(60000)
        .all<std::uint32_t>(4e9);
    b.all<std::uint16_t>(9)
        .all<u8>(4)
        .all<std::int32_t>(0, 1, 2, 3)
        .all<u8>(8)
        .all<float>(0, 0, 1, 0, 1, 1, 0, 1);
    b.all<std::uint16_t>(9).all<u8>(3).all<std::int32_t>(0, 2, 3).all<u8>(0);
    return b.bytes;
}

void check_rich(const Mesh& mesh) {
    constexpr std::uint32_t none = Attribute<glm::vec2>::none;
    CHECK(mesh.positions == std::vector<glm::vec3>{{0, 0, 0}, {1.5f, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(mesh.normals.values == std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 1, 0}});
    CHECK(mesh.normals.per_vertex());
    CHECK(mesh.faces == std::vector<std::uint32_t>{4, 3});
    CHECK(mesh.corners == std::vector<std::uint32_t>{0, 1, 2, 3, 0, 2, 3});
    CHECK(mesh.colors == std::vector<glm::vec4>{{1, 0, 0.2f, 1}, {0, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}});
    REQUIRE(mesh.uvs.size() == 1);
    CHECK(mesh.uvs[0].values == std::vector<glm::vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    CHECK(mesh.uvs[0].corners == std::vector<std::uint32_t>{0, 1, 2, 3, none, none, none});
    CHECK(mesh.parts == std::vector<Part>{{"", -1, 0, 2}});
    CHECK(mesh.warnings.empty());
}

std::string small(const std::string& vertex_type, const std::string& vertices) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty " + vertex_type + " x\nproperty " +
           vertex_type + " y\nproperty " + vertex_type +
           " z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n" + vertices + "3 0 1 2\n";
}

}  // namespace

TEST_CASE("ply: everything is read, in text and in both byte orders") {
    check_rich(load_text("a.ply", rich_ply));
    check_rich(load_text("a.ply", rich_binary(false)));
    check_rich(load_text("a.ply", rich_binary(true)));
    check_rich(load_text("a.ply", replaced(rich_ply, "\n", "\r\n")));
}

TEST_CASE("ply: a byte order mark before text is passed over, and kept") {
    const std::string marked = "\xEF\xBB\xBF" + rich_ply;
    const Mesh mesh = load_text("a.dat", marked);
    check_rich(mesh);
    CHECK(saved(mesh, "b.ply") == marked);
    CHECK(tells(load_error("a.ply", replaced(marked, "property uint8 label", "property long label")),
                "line 6: type 'long'"));
    Mesh moved = mesh;
    moved.positions[1] = {4, 5, 6};
    CHECK(saved(moved, "b.ply") == replaced(marked, "2 1.50 0 0 2", "2 4 5 6 2"));
}

TEST_CASE("ply: an unchanged mesh is written to the byte") {
    for (const std::string& text :
         {rich_ply, rich_binary(false), rich_binary(true), replaced(rich_ply, "\n", "\r\n")}) {
        const Mesh mesh = load_text("a.ply", text);
        CHECK(saved(mesh, "b.ply") == text);
        CHECK(saved(with_vertex_arrays(mesh, vertex_arrays(mesh)), "b.ply") == text);
    }
}

TEST_CASE("ply: only numbers that changed are written anew, in the file's types") {
    const auto bend = [](Mesh mesh) {
        mesh.positions[1] = {0.1f, 0, 0.3f};
        mesh.normals.values[3] = {0, 0.5f, 0};
        return mesh;
    };
    const std::string z = "0.3";
    const std::string text = replaced(rich_ply, "2 1.50 0 0 2", "2 0.1 0 " + z + " 2");
    CHECK(saved(bend(load_text("a.ply", rich_ply)), "b.ply") ==
          replaced(text, "0 0 1 0 0 0 255", "0 0 0.5 0 0 0 255"));
    for (const bool big : {false, true}) {
        const std::string bytes = rich_binary(big);
        const auto line = [&](float x, double dz) {
            return Binary{big, {}}.all<std::uint8_t>(2).all<float>(x, 0).put(dz).bytes;
        };
        const auto normal = [&](float y) {
            return Binary{big, {}}.all<float>(0, y, 0).all<std::uint8_t>(0, 0, 255).bytes;
        };
        const std::string expected = replaced(bytes, line(1.5f, 0), line(0.1f, double{0.3f}));
        CHECK(saved(bend(load_text("a.ply", bytes)), "b.ply") == replaced(expected, normal(1), normal(0.5f)));
    }
}

TEST_CASE("ply: integer coordinates become floats when they change") {
    const std::string text = small("short", "0 0 0\n10 0 0\n0 10 0\n");
    Mesh mesh = load_text("a.ply", text);
    CHECK(saved(mesh, "b.ply") == text);
    mesh.positions[1].x = 9.5f;
    CHECK(saved(mesh, "b.ply") == replaced(replaced(text, "short", "float"), "10 0 0", "9.5 0 0"));
    Binary b{false, replaced(text.substr(0, text.find("end_header")), "ascii", "binary_little_endian") +
                        "end_header\n"};
    b.all<std::int16_t>(0, 0, 0, 10, 0, 0, 0, 10, 0).all<std::uint8_t>(3).all<std::int32_t>(0, 1, 2);
    mesh = load_text("a.ply", b.bytes);
    mesh.positions[1].x = 9.5f;
    const Mesh again = reloaded(mesh, "b.ply");
    CHECK(again.positions == mesh.positions);
    CHECK(again.corners == mesh.corners);
}

TEST_CASE("ply: doubles are read as the nearest floats") {
    const Mesh mesh = load_text("a.ply", small("double", "0.1 0 0\n1.0000000001 0 0\n0 1e-60 0\n"));
    CHECK(mesh.positions == std::vector<glm::vec3>{{0.1f, 0, 0}, {1, 0, 0}, {0, 0, 0}});
}

TEST_CASE("ply: a mesh of another making keeps what PLY can carry") {
    Mesh mesh =
        load_text("a.obj",
                  "v 0 0 0 0.1 0.2 0.3\nv 1 0 0 0.1 0.2 0.3\nv 1 1 0 0.1 0.2 0.3\nv 0 1 0 0.1 0.2 0.3\n"
                  "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nvn 1 0 0\n"
                  "f 1/1/1 2/2/1 3/3/1 4/4/1\nf 1/1/2 3/3/2 4/4/2\nf 1 2 3\n");
    const Mesh again = reloaded(mesh, "b.ply");
    CHECK(again.positions == mesh.positions);
    CHECK(again.corners == mesh.corners);
    CHECK(again.faces == mesh.faces);
    CHECK(again.colors == mesh.colors);
    REQUIRE(again.uvs.size() == 1);
    for (std::size_t c = 0; c < 7; ++c)
        CHECK(again.uvs[0].values[again.uvs[0].corners[c]] == mesh.uvs[0].values[mesh.uvs[0].corners[c]]);
    CHECK(again.uvs[0].corners[7] == Attribute<glm::vec2>::none);
    const float half = 0.70710678f;
    CHECK(again.normals.values ==
          std::vector<glm::vec3>{{half, 0, half}, {0, 0, 1}, {half, 0, half}, {half, 0, half}});
}

TEST_CASE("ply: a large polygon does not overflow its count") {
    Mesh mesh;
    for (int i = 0; i < 300; ++i) mesh.positions.emplace_back(i, i % 7, 0);
    for (std::uint32_t i = 0; i < 300; ++i) mesh.corners.push_back(i);
    mesh.faces = {300};
    mesh.uvs.resize(1);
    mesh.uvs[0].values.assign(300, {0.5f, 0.25f});
    const Mesh again = reloaded(mesh, "b.ply");
    CHECK(again.faces == mesh.faces);
    CHECK(again.corners == mesh.corners);
    CHECK(again.uvs == mesh.uvs);
}

TEST_CASE("ply: what cannot be read is told with its line, element and row") {
    const auto error = [](const std::string& from, const std::string& to, const std::string& what) {
        const std::string message = load_error("a.ply", replaced(rich_ply, from, to));
        INFO(message);
        return tells(message, what);
    };
    CHECK(error("1.50", "abc",
                "line 30: element 'vertex', row 1 of 4 (counted from 0): 'abc' is not a number"));
    CHECK(error("1.50", "nan", "row 1 of 4 (counted from 0): 'x' is not finite"));
    CHECK(error("0 0 1 0 0 0\n\n", "0 nan 1 0 0 0\n\n", "'ny' is not finite"));
    CHECK(error("2 -7 8", "3 -7 8",
                "line 30: element 'vertex', row 1 of 4 (counted from 0): the line has too few"));
    CHECK(error("2 -7 8", "-2 -7 8", "line 30"));
    CHECK(error("2 -7 8", "1 -7 8",
                "line 30: element 'vertex', row 1 of 4 (counted from 0): the line has more"));
    CHECK(
        error("3 0 2 3", "3 0 2 4", "line 36: element 'face', row 1 of 2 (counted from 0): vertex index 4"));
    CHECK(error("3 0 2 3", "3 0 2 -1", "element 'face', row 1 of 2 (counted from 0): vertex index -1"));
    CHECK(
        tells(load_error("a.ply", replaced(replaced(rich_ply, "list uint8 int32", "list int8 int32"),
                                           "9 4 0 1 2 3", "9 -4 0 1 2 3")),
              "line 35: element 'face', row 0 of 2 (counted from 0): list 'vertex_indices' has a negative"));
    CHECK(error("element vertex 4", "element vertex 40", "row 4 of 40"));
    CHECK(error("element vertex 4", "element vertex 3", "element 'camera', row 0 of 1"));
    CHECK(error("element vertex 4", "element vertex -4", "line 5: element count '-4'"));
    CHECK(error("element face 2", "element face 9999999999999999999999", "line 23: element count"));
    CHECK(error("element face 2", "element face 9000000000000000000", "the file ends before this row"));
    CHECK(error("element face", "element camera", "line 23: element 'camera' is there twice"));
    CHECK(error("property uint8 label", "property long label", "line 6: type 'long'"));
    CHECK(error("list uchar short", "list float short", "line 10: a list's count"));
    CHECK(error("ascii", "utf8", "line 2: format 'utf8'"));
    CHECK(error("property uint8 label", "proper uint8 label", "line 6: 'proper' is not a word"));
    CHECK(error("float x", "float xx", "no property x"));
    CHECK(error("element vertex", "element point", "no element vertex"));
    CHECK(error("vertex_indices", "edges", "there are no faces"));
    CHECK(error("element face 2", "element face 0", "there are no faces"));
    CHECK(error("end_header", "end", "'end' is not a word"));
    CHECK(tells(load_error("a.ply", header.substr(0, header.find("end_header"))), "end_header"));
    CHECK(tells(load_error("a.ply", "ply\nelement vertex 1\nend_header\n"), "format"));
}

TEST_CASE("ply: a cut off or lying binary file is refused without allocating what it claims") {
    const std::string bytes = rich_binary(true);
    CHECK(tells(load_error("a.ply", bytes.substr(0, bytes.size() - 1)), "element 'face', row 1 of 2"));
    CHECK(tells(load_error("a.ply", replaced(bytes, "element vertex 4", "element vertex 4000000000000")),
                "element \'vertex\', row"));
    CHECK(tells(load_error("a.ply", replaced(bytes, "list uchar short", "list uint short")),
                "the file ends within"));
    CHECK(load_text("a.ply", bytes + "tail").warnings.size() == 1);
}

TEST_CASE("ply: faces of two corners are left out with a warning") {
    const Mesh mesh = load_text("a.ply", replaced(rich_ply, "9 3 0 2 3 0", "9 2 0 2 0"));
    CHECK(mesh.faces.size() == 1);
    CHECK(mesh.warnings.size() == 1);
}

TEST_CASE("ply: texture coordinates that are no numbers are 0, with a warning") {
    const Mesh mesh = load_text("a.ply", replaced(rich_ply, "8 0 0 1 0 1 1 0 1", "8 0 0 nan 0 1 inf 0 1"));
    CHECK(mesh.uvs[0].values == std::vector<glm::vec2>{{0, 0}, {0, 0}, {1, 0}, {0, 1}});
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0] ==
          "2 uv or color values are not finite: taken as 0, but kept in a file of the same format");
}

TEST_CASE("ply: an index that is no number, or too large for one, is told as it is") {
    const auto with_index = [](const std::string& index) {
        return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
               "z\n"
               "element face 1\nproperty list uchar double vertex_indices\nend_header\n"
               "0 0 0\n1 0 0\n0 1 0\n3 0 1 " +
               index + "\n";
    };
    CHECK(tells(load_error("a.ply", with_index("nan")), "vertex index nan is out of range"));
    CHECK(tells(load_error("a.ply", with_index("1e300")), "vertex index 1e+300 is out of range"));
    CHECK(tells(load_error("a.ply", with_index("-inf")), "vertex index -inf is out of range"));
    CHECK(tells(load_error("a.ply", with_index("1.5")), "vertex index 1.5 is out of range"));
}

TEST_CASE("ply: a header line of an old Blender is taken for a comment, and kept") {
    const std::string bytes =
        "ply\nformat ascii 1.0\nCreated by Blender3D 247 - www.blender.org, source file: \nelement vertex 3\n"
        "property float x\nproperty float y\nproperty float z\nelement face 1\n"
        "property list uchar uint vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const Mesh mesh = load_text("a.ply", bytes);
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].starts_with("line 3: 'Created' is not a word"));
    CHECK(saved(mesh, "b.ply") == bytes);
}
