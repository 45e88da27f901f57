// SPDX-License-Identifier: MIT
#include "gltf_files.hpp"
#include "support/models.hpp"

#include <algorithm>
#include <limits>

using namespace goffer::test;
using goffer::mesh::Attribute;
using goffer::mesh::load;
using goffer::mesh::Mesh;

namespace {

Mesh nodes(const char* json) {
    return load_document(tetra_with_nodes(json));
}

struct Counts {
    std::size_t vertices, triangles, parts = 1, uv_sets = 1;
    bool tangents = false;
};

void check_read_model(const char* name, const Counts& known) {
    const auto file = model(name);
    if (file.empty()) return;
    const Mesh mesh = load(file);
    CHECK(mesh.positions.size() == known.vertices);
    CHECK(mesh.faces.size() == known.triangles);
    CHECK(mesh.parts.size() == known.parts);
    CHECK(mesh.uvs.size() == known.uv_sets);
    CHECK(mesh.normals.per_vertex());
    CHECK(mesh.normals.values.size() == known.vertices);
    CHECK(mesh.tangents.empty() != known.tangents);
    // Some are kept without their textures.
    CHECK(std::ranges::all_of(
        mesh.warnings, [](const std::string& said) { return said.starts_with("a texture is missing: "); }));
}

}  // namespace

TEST_CASE("gltf: a tetrahedron comes in as it is, from GLB and from data URIs") {
    for (const char* name : {"d.glb", "d.gltf"}) {
        const Mesh mesh = load_text(name, name[3] == 'l' ? tetra().gltf() : tetra().glb());
        REQUIRE(mesh.positions.size() == 4);
        CHECK(mesh.positions[3] == glm::vec3(0, 0, 3));
        CHECK(mesh.normals.per_vertex());
        CHECK(mesh.normals.values[2] == glm::vec3(0, 1, 0));
        CHECK(mesh.tangents.values[2] == glm::vec4(1, 0, 0, -1));
        CHECK(mesh.uvs.at(0).values[3] == glm::vec2(0.75f, 0.0f));  // v is turned: up in a mesh, down in glTF
        CHECK(mesh.corners == std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
        CHECK(mesh.faces == std::vector<std::uint32_t>(4, 3));
        REQUIRE(mesh.parts.size() == 1);
        CHECK(mesh.parts[0].name == "tetra");
        CHECK(mesh.parts[0].face_count == 4);
        CHECK(mesh.colors.empty());
        CHECK(mesh.warnings.empty());
        CHECK(mesh.source);
    }
}

TEST_CASE("gltf: transforms of a chain of nodes are applied, scale before rotation before translation") {
    const Mesh mesh = nodes(
        R"([{"children": [1], "translation": [1, 2, 3], "rotation": [0, 0, 0.70710678118654752, 0.70710678118654752],
                                 "scale": [2, 2, 2]}, {"mesh": 0, "translation": [0, 0, 5]}])");
    CHECK(close(mesh.positions[0], {1, 2, 13}));
    CHECK(close(mesh.positions[1], {1, 6, 13}));   // (2, 0, 5) doubled, then x to y
    CHECK(close(mesh.positions[2], {-1, 2, 13}));  // y to -x
    CHECK(close(mesh.normals.values[2], {-1, 0, 0}));
}

TEST_CASE("gltf: a matrix is column-major and equals its translation, rotation and scale") {
    const Mesh matrix =
        nodes(R"([{"mesh": 0, "matrix": [0, 3, 0, 0, -2, 0, 0, 0, 0, 0, 4, 0, 7, 8, 9, 1]}])");
    const Mesh parts = nodes(
        R"([{"mesh": 0, "translation": [7, 8, 9], "rotation": [0, 0, 0.70710678118654752, 0.70710678118654752],
                                  "scale": [3, 2, 4]}])");
    CHECK(close(matrix.positions[1], {7, 14, 9}));
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(close(matrix.positions[i], parts.positions[i]));
        CHECK(close(matrix.normals.values[i], parts.normals.values[i]));
        CHECK(close(glm::vec3(matrix.tangents.values[i]), glm::vec3(parts.tangents.values[i])));
    }
}

TEST_CASE("gltf: a matrix is taken as affine, whatever its last row says") {
    const Mesh affine =
        nodes(R"([{"mesh": 0, "matrix": [0, 3, 0, 0, -2, 0, 0, 0, 0, 0, 4, 0, 7, 8, 9, 1]}])");
    Mesh other =
        nodes(R"([{"mesh": 0, "matrix": [0, 3, 0, 0.5, -2, 0, 0, 0.25, 0, 0, 4, -0.5, 7, 8, 9, 2]}])");
    CHECK(other.positions == affine.positions);
    CHECK(other.normals == affine.normals);
    for (glm::vec3& position : other.positions) position += glm::vec3(1, 2, 3);
    const Mesh again = reloaded(other, "moved.glb");  // by the inverse, and the matrix
    for (std::size_t i = 0; i < 4; ++i) CHECK(close(again.positions[i], other.positions[i]));
}

TEST_CASE("gltf: uneven scale takes normals by the inverse transpose and tangents by the matrix") {
    const Mesh mesh = nodes(R"([{"mesh": 0, "scale": [2, 1, 1]}])");
    CHECK(close(mesh.normals.values[1], glm::normalize(glm::vec3(0.5f, 1, 0))));
    CHECK(close(glm::vec3(mesh.tangents.values[1]), glm::normalize(glm::vec3(2, -1, 0))));
    CHECK(glm::dot(mesh.normals.values[1], glm::vec3(mesh.tangents.values[1])) ==
          doctest::Approx(0).epsilon(1e-6));
}

TEST_CASE("gltf: a mirror turns triangles round and keeps normals looking outward") {
    const Mesh mesh = nodes(R"([{"mesh": 0, "scale": [-1, 1, 1]}])");
    CHECK(volume(mesh) == doctest::Approx(6));
    CHECK(close(mesh.normals.values[1], glm::normalize(glm::vec3(-1, 1, 0))));
    for (std::size_t i = 0; i < 4; ++i) {  // the bitangent is carried along like any vector
        const Mesh rest = load_document(tetra());
        const auto bitangent = [i](const Mesh& m) {
            return glm::cross(m.normals.values[i], glm::vec3(m.tangents.values[i])) * m.tangents.values[i].w;
        };
        CHECK(close(bitangent(mesh), bitangent(rest) * glm::vec3(-1, 1, 1)));
    }
}

TEST_CASE("gltf: what a node presses flat keeps its sides") {
    const Mesh rest = load_document(tetra()), flat = nodes(R"([{"mesh": 0, "scale": [1, 1, 0]}])");
    CHECK(flat.corners == rest.corners);
    CHECK(flat.normals.values[3] == glm::vec3(0, 0, 1));
    CHECK(flat.tangents.values[2] == glm::vec4(1, 0, 0, -1));
    REQUIRE(flat.warnings.size() == 1);
    CHECK(flat.warnings[0].find("flat") != std::string::npos);
}

TEST_CASE("gltf: the default scene is read, or the first, or all nodes where there is none") {
    Document document =
        tetra_with_nodes(R"([{"mesh": 0}, {"mesh": 0, "translation": [10, 0, 0]}, {"children": [0, 1]}])");
    document.json["scenes"] = Json::parse(R"([{"nodes": [0]}, {"nodes": [1]}])");
    document.json["scene"] = 1;
    CHECK(load_document(document).positions[0].x == 10);
    document.json.erase("scene");
    CHECK(load_document(document).positions[0].x == 0);
    document.json.erase("scenes");
    CHECK(load_document(document).positions.size() == 8);
}

TEST_CASE("gltf: primitives that share accessors share vertices, nodes that share a mesh do not") {
    Document document = tetra_with_nodes(
        R"([{"children": [1, 2]}, {"mesh": 0, "name": "left"}, {"mesh": 0, "translation": [5, 0, 0]}])");
    Json second = primitive_of(document);
    second["indices"] = document.shorts({1, 2, 3});
    document.json["meshes"][0]["primitives"].push_back(second);
    const Mesh mesh = load_document(document);
    CHECK(mesh.positions.size() == 8);
    REQUIRE(mesh.parts.size() == 4);
    CHECK(mesh.parts[0].name == "left");
    CHECK(mesh.parts[2].name == "tetra");
    CHECK(mesh.parts[3].first_face == 9);
    CHECK(mesh.corners.back() == 7);
    CHECK(mesh.positions[7] == glm::vec3(5, 0, 3));
}

TEST_CASE("gltf: a primitive has the name of its extras, if that is text, or else its node's") {
    Document document = tetra_with_nodes(R"([{"mesh": 0, "name": "left"}])");
    for (const auto& [extras, name] :
         std::vector<std::pair<const char*, std::string>>{{R"({"name": "own"})", "own"},
                                                          {R"({"name": 3})", "left"},
                                                          {R"({})", "left"},
                                                          {R"(["name"])", "left"}}) {
        primitive_of(document)["extras"] = Json::parse(extras);
        CHECK(load_document(document).parts[0].name == name);
    }
}

TEST_CASE("gltf: primitives may have different sets of texture coordinates") {
    Document document = tetra();
    const std::size_t points = document.floats(tetra_points, "VEC3"),
                      uvs = document.floats({0, 0, 0.5f, 0, 0, 0.25f, 1, 1}, "VEC2"),
                      indices = document.shorts({1, 2, 3});
    const auto uv = [](const Mesh& mesh, std::size_t set, std::size_t corner) {
        const auto& all = mesh.uvs.at(set);
        const std::uint32_t i = all.per_vertex() ? mesh.corners[corner] : all.corners[corner];
        return i == Attribute<glm::vec2>::none ? glm::vec2(-1) : all.values[i];
    };
    for (const bool first : {true, false}) {
        Document both = document;
        Json& primitives = both.json["meshes"][0]["primitives"];
        const Json attributes = {{"POSITION", points}, {"TEXCOORD_0", uvs}, {"TEXCOORD_1", uvs}};
        const Json other = {{"attributes", attributes}, {"indices", indices}};
        primitives.insert(first ? primitives.begin() : primitives.end(), other);
        const Mesh mesh = load_document(both);
        REQUIRE(mesh.uvs.size() == 2);
        const std::size_t own = first ? 3 : 0, others = first ? 0 : 12;
        CHECK(uv(mesh, 0, own + 5) == glm::vec2(0.75f, 0));
        CHECK(uv(mesh, 1, own + 5) == glm::vec2(-1));
        for (const std::size_t set : {0u, 1u}) {
            CHECK(uv(mesh, set, others) == glm::vec2(0.5f, 1));
            CHECK(uv(mesh, set, others + 1) == glm::vec2(0, 0.75f));
        }
    }
}

TEST_CASE("gltf: strips and fans become triangles, points and lines have vertices only") {
    const auto corners = [](int mode) {
        Document document = tetra();
        Json triangle = primitive_of(document);
        triangle["indices"] = document.shorts({3, 2, 1});
        document.json["meshes"][0]["primitives"].push_back(triangle);
        primitive_of(document)["mode"] = mode;
        primitive_of(document)["indices"] = document.shorts({0, 1, 2, 3});
        const Mesh mesh = load_document(document);
        CHECK(mesh.positions.size() == 4);
        CHECK(mesh.parts.size() == 2);
        return mesh.corners;
    };
    using Corners = std::vector<std::uint32_t>;
    CHECK(corners(5) == Corners{0, 1, 2, 1, 3, 2, 3, 2, 1});
    CHECK(corners(6) == Corners{0, 1, 2, 0, 2, 3, 3, 2, 1});
    for (const int mode : {0, 1, 2, 3}) CHECK(corners(mode) == Corners{3, 2, 1});
}

TEST_CASE("gltf: without indices every three vertices are a triangle, a rest is left out with a warning") {
    Document document = tetra();
    primitive_of(document).erase("indices");
    const Mesh mesh = load_document(document);
    CHECK(mesh.corners == std::vector<std::uint32_t>{0, 1, 2});
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].find("incomplete triangle") != std::string::npos);
}

TEST_CASE("gltf: integers of all kinds become numbers, normalized or not, with strides and offsets") {
    struct Kind {
        int component;
        std::string bytes;  // 0, half or so, the most
        float half, most, half_normalized, max_normalized;
    };
    using namespace std;
    const vector<Kind> kinds{
        {5120, raw(vector<int8_t>{0, -64, 127}), -64, 127, -64 / 127.0f, 1},
        {5121, raw(vector<uint8_t>{0, 128, 255}), 128, 255, 128 / 255.0f, 1},
        {5122, raw(vector<int16_t>{0, 16384, -32768}), 16384, -32768, 16384 / 32767.0f, -1},
        {5123, raw(vector<uint16_t>{0, 32768, 65535}), 32768, 65535, 32768 / 65535.0f, 1},
    };
    for (const Kind& kind : kinds) {
        for (const bool normalized : {false, true}) {
            Document document = tetra();
            std::string interleaved = "padd";
            for (int i = 0; i < 4; ++i) interleaved += kind.bytes + std::string(12 - kind.bytes.size(), 'x');
            const std::size_t index =
                document.accessor(document.view(interleaved, 12), kind.component, "VEC3", 4, 4);
            document.json["accessors"][index]["normalized"] = normalized;
            primitive_of(document)["attributes"]["POSITION"] = index;
            const Mesh mesh = load_document(document);
            const glm::vec3 expected = normalized ? glm::vec3(0, kind.half_normalized, kind.max_normalized)
                                                  : glm::vec3(0, kind.half, kind.most);
            for (const glm::vec3& p : mesh.positions) CHECK(p == expected);
        }
    }
}

TEST_CASE("gltf: indices may have 8, 16 or 32 bits") {
    const std::vector<std::pair<int, std::string>> kinds{{5121, raw(std::vector<std::uint8_t>{0, 1, 3})},
                                                         {5123, raw(std::vector<std::uint16_t>{0, 1, 3})},
                                                         {5125, raw(std::vector<std::uint32_t>{0, 1, 3})}};
    for (const auto& [component, bytes] : kinds) {
        Document document = tetra();
        primitive_of(document)["indices"] = document.accessor(document.view(bytes), component, "SCALAR", 3);
        CHECK(load_document(document).corners == std::vector<std::uint32_t>{0, 1, 3});
    }
}

TEST_CASE("gltf: sparse accessors replace elements, of zeros where there is no view") {
    for (const bool based : {true, false}) {
        Document document = tetra();
        Json& accessor = document.json["accessors"][0];
        Json sparse = {{"count", 2}};
        sparse["indices"] = {{"bufferView", document.view(raw(std::vector<std::uint8_t>{1, 3}))},
                             {"componentType", 5121}};
        sparse["values"] = {{"bufferView", document.view(raw(std::vector<float>{9, 8, 7, 6, 5, 4}))}};
        accessor["sparse"] = sparse;
        if (!based) accessor.erase("bufferView");
        const Mesh mesh = load_document(document);
        CHECK(mesh.positions[1] == glm::vec3(9, 8, 7));
        CHECK(mesh.positions[3] == glm::vec3(6, 5, 4));
        CHECK(mesh.positions[2] == glm::vec3(0, based ? 1 : 0, 0));
    }
}

TEST_CASE("gltf: colors of three or four components come in, and white where a primitive has none") {
    Document document = tetra();
    Json second = primitive_of(document);
    primitive_of(document)["attributes"]["COLOR_0"] = document.accessor(
        document.view(raw(std::vector<std::uint8_t>{255, 0, 51, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), 4),
        5121, "VEC3", 4);
    document.json["accessors"].back()["normalized"] = true;
    document.json["meshes"][0]["primitives"].push_back(second);
    Mesh mesh = load_document(document);
    REQUIRE(mesh.colors.size() == 8);
    CHECK(mesh.colors[0] == glm::vec4(1, 0, 0.2f, 1));
    CHECK(mesh.colors[7] == glm::vec4(1));
    document = tetra();
    primitive_of(document)["attributes"]["COLOR_0"] = document.floats(std::vector<float>(16, 0.125f), "VEC4");
    mesh = load_document(document);
    CHECK(mesh.colors == std::vector<glm::vec4>(4, glm::vec4(0.125f)));
}

TEST_CASE("gltf: an attribute that some primitives lack has an index for each corner") {
    Document document = tetra();
    Json second = primitive_of(document);
    primitive_of(document)["attributes"].erase("NORMAL");
    document.json["meshes"][0]["primitives"].push_back(second);
    const Mesh mesh = load_document(document);
    CHECK(mesh.normals.values.size() == 4);
    REQUIRE(mesh.normals.corners.size() == 24);
    CHECK(mesh.normals.corners[0] == Attribute<glm::vec3>::none);
    // Corner 13 is vertex 2 of the second primitive.
    CHECK(mesh.normals.values[mesh.normals.corners[13]] == glm::vec3(0, 1, 0));
    CHECK(mesh.tangents.per_vertex());
}

TEST_CASE("gltf: materials have their names and base colors") {
    Document document = tetra();
    document.json["materials"] =
        Json::parse(R"([{"name": "skin", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 1]}},
        {"extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.75, 0, 1, 0.5]}}}, {},
        {"pbrMetallicRoughness": {"metallicFactor": 0}}])");
    primitive_of(document)["material"] = 1;
    const Mesh mesh = load_document(document);
    REQUIRE(mesh.materials.size() == 4);
    CHECK(mesh.materials[0].name == "skin");
    CHECK(mesh.materials[0].base_color == glm::vec4(0.5f, 0.25f, 0.125f, 1));
    CHECK(mesh.materials[1].base_color == glm::vec4(0.75f, 0, 1, 0.5f));
    CHECK(mesh.materials[2].base_color == glm::vec4(1));
    CHECK(mesh.materials[3].base_color == glm::vec4(1));
    CHECK(mesh.parts[0].material == 1);
}

TEST_CASE("gltf: a skinned mesh stands where its joints place it, a morphed one is at rest, with warnings") {
    Document document = tetra_with_nodes(R"([{"mesh": 0, "skin": 0, "translation": [100, 0, 0]}])");
    document.json["skins"] = Json::parse(R"([{"joints": [0]}])");
    primitive_of(document)["targets"] = Json::parse(R"([{"POSITION": 0}])");
    const Mesh mesh = load_document(document);
    CHECK(mesh.positions[1] == glm::vec3(102, 0, 0));
    REQUIRE(mesh.warnings.size() == 2);
    CHECK(mesh.warnings[0].find("morph") != std::string::npos);
    CHECK(mesh.warnings[1] ==
          "nodes[0] is skinned: it is taken in the shape that the file has, without bones");
}

namespace {

/// A skinned tetrahedron, whose node counts for nothing, and two joints, the second of which is the first
/// one's child. Bound where both stand at the origin, and the mesh is 100 times smaller.
Document bound(const std::string& second) {
    Document document = tetra_with_nodes((R"([{"mesh": 0, "skin": 0, "translation": [9, 9, 9]},
             {"children": [2], "scale": [100, 100, 100], "translation": [5, 0, 0]}, )" +
                                          second + "]")
                                             .c_str());
    document.json["scenes"][0]["nodes"] = {0, 1};
    const std::size_t inverse = document.accessor(
        document.view(raw(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,      0, 0, 1,  //
                                             1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.25f, 0, 0, 1})),
        5126, "MAT4", 2);
    document.json["skins"] = Json::array({{{"joints", {1, 2}}, {"inverseBindMatrices", inverse}}});
    return document;
}

}  // namespace

TEST_CASE("gltf: joints that stand as they were bound place a mesh exactly, others by the first one") {
    const Mesh still = load_document(bound(R"({"translation": [0.25, 0, 0]})"));
    CHECK(still.positions[1] == glm::vec3(205, 0, 0));
    REQUIRE(still.warnings.size() == 1);
    CHECK(still.warnings[0].ends_with("without bones"));
    const Mesh moved = load_document(bound(R"({"translation": [0.25, 0.1, 0]})"));
    CHECK(moved.positions == still.positions);
    REQUIRE(moved.warnings.size() == 1);
    CHECK(moved.warnings[0].ends_with("without bones, where the first one places it"));
    // What is written goes back to where the joints take it from.
    Mesh shifted = moved;
    for (glm::vec3& p : shifted.positions) p.x += 100;
    const Document after = opened(saved(shifted, "out.glb"));
    CHECK(load_document(after).positions == shifted.positions);
    CHECK(after.json["nodes"][0] == bound("{}").json["nodes"][0]);
    Document twice = bound("{}");
    twice.json["nodes"].push_back(twice.json["nodes"][0]);
    twice.json["scenes"][0]["nodes"].push_back(3);
    CHECK(load_document(twice).warnings[0].starts_with("nodes[0] and 1 more are skinned: they are taken"));
    const Mesh far = load_document(bound(R"({"translation": [0.25, 1e308, 0]})"));  // beyond numbers
    CHECK(far.positions == still.positions);
    CHECK(far.warnings[0].ends_with("where the first one places it"));
    Document elsewhere = bound(R"({"translation": [0.25, 0, 0]})");
    elsewhere.json["scenes"][0]["nodes"] = {0};  // joints of another scene count for nothing
    CHECK(load_document(elsewhere).positions[1] == glm::vec3(2, 0, 0));
    elsewhere.json["scenes"][0]["nodes"] = {0, 2};  // one of them, which has another bind matrix
    CHECK(load_document(elsewhere).positions[1] == glm::vec3(2, 0, 0));
    Document few = bound("{}");
    few.json["skins"][0]["joints"] = {1, 2, 0};
    CHECK(load_error("d.glb", few.glb()).find("has 2 elements for 3 joints") != std::string::npos);
    Document no_number = bound("{}");
    no_number.json["skins"][0]["inverseBindMatrices"] = no_number.accessor(
        no_number.view(raw(std::vector<float>(32, std::numeric_limits<float>::quiet_NaN()))), 5126, "MAT4",
        2);
    CHECK(load_error("d.glb", no_number.glb()).find("inverseBindMatrices: has a number that is not finite") !=
          std::string::npos);
    Document dangling = bound("{}");
    dangling.json["nodes"][0]["skin"] = 5;
    CHECK(load_error("d.glb", dangling.glb()).find("nodes[0].skin") != std::string::npos);
}

TEST_CASE("gltf: textures may be missing, which is warned of, and broken, which nobody sees") {
    Document document = tetra();
    document.json["images"] = Json::parse(
        R"([{"uri": "gone.png"}, {"uri": "data:image/png;base64,!!"}, {"bufferView": 0, "mimeType": "image/png"}])");
    document.json["textures"] = Json::parse(R"([{"source": 0}])");
    const Mesh mesh = load_document(document);
    CHECK(mesh.positions.size() == 4);
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].find("images[0].uri names 'gone.png', which is not there") != std::string::npos);
}

TEST_CASE("gltf: fields of the wrong type that nobody reads are warned of, once") {
    const auto warnings = [](const char* materials) {
        Document document = tetra();
        document.json["materials"] = Json::parse(materials);
        return load_document(document).warnings;
    };
    const auto warned = [&](const char* materials, const std::string& text) {
        const std::vector<std::string> said = warnings(materials);
        return said.size() == 1 && said[0].starts_with(text);
    };
    CHECK(warnings(R"([{"doubleSided": true, "normalTexture": {"index": 0, "scale": 2},
                        "extras": {"name": 3}, "extensions": {"A": {"name": 3}}}])")
              .empty());
    CHECK(warned(R"([{"normalTexture": {"scale": "no"}}])",
                 "materials[0].normalTexture.scale is a JSON string, expected a number: kept"));
    CHECK(warned(R"([{}, {"normalTexture": {"index": -1}, "doubleSided": 1}])",
                 "materials[1].normalTexture.index is -1, expected a whole number of 0 or more, and 1 more"));
    CHECK(warned(R"([{"extensions": {"KHR_a": "no"}}])",
                 "materials[0].extensions.KHR_a is a JSON string, expected an object"));
    Document document = tetra();
    document.json["scenes"][0]["name"] = 42;
    CHECK(load_document(document).warnings.size() == 1);
}

TEST_CASE("gltf: numbers of what is not there, where nobody reads it, are warned of") {
    const auto warnings = [](const char* path, const Json& value) {
        Document document = tetra();
        document.json["animations"] = Json::parse(
            R"([{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                 "samplers": [{"input": 0, "output": 0}]}])");
        if (*path != '\0') document.json[Json::json_pointer(path)] = value;
        return load_document(document).warnings;
    };
    const auto warned = [&](const char* path, const char* said) {
        const std::vector<std::string> all = warnings(path, 9);
        return all.size() == 1 && all[0] == std::string(said) +
                                                ": kept as it is, but the file is not valid; "
                                                "export it again";
    };
    CHECK(warnings("", 0).empty());
    CHECK(warned("/animations/0/samplers/0/input",
                 "animations[0].samplers[0].input is 9, but there are 5 accessors"));
    CHECK(warned("/animations/0/samplers/0/output",
                 "animations[0].samplers[0].output is 9, but there are 5 accessors"));
    CHECK(warned("/animations/0/channels/0/sampler",
                 "animations[0].channels[0].sampler is 9, but there are 1 samplers in the animation"));
    CHECK(warned("/animations/0/channels/0/target/node",
                 "animations[0].channels[0].target.node is 9, but there are 1 nodes"));
    CHECK(warned("/nodes/0/camera", "nodes[0].camera is 9, but there are 0 cameras"));
    const std::vector<std::string> text = warnings("/animations/0/channels/0/sampler", "no");
    REQUIRE(text.size() == 1);
    CHECK(text[0].starts_with(
        "animations[0].channels[0].sampler is a JSON string, expected a whole number of 0 or more: kept"));
    CHECK(warnings("/cameras", "no").empty());
}

TEST_CASE("gltf: outer buffers are found beside the document, by their decoded name") {
    const Folder folder;
    Document document = tetra();
    document.json["buffers"] = Json::parse(R"([{"uri": "a%20b.bin", "byteLength": 1}])");
    document.json["buffers"][0]["byteLength"] = document.buffer.size();
    const auto file = folder.write("d.gltf", document.gltf());
    CHECK(tells(error_of([&] { (void)load(file); }),
                "buffers[0].uri: names 'a%20b.bin', which is not there; put it"));
    std::filesystem::create_directory(folder / "a b.bin");
    CHECK(tells(error_of([&] { (void)load(file); }), "'a%20b.bin', which is no regular file; put it"));
    std::filesystem::remove(folder / "a b.bin");
    folder.write("a b.bin", document.buffer + "and more");
    CHECK(load(file).positions[3] == glm::vec3(0, 0, 3));
    for (int i = 0; i < 50; ++i) document.json["images"].push_back({{"uri", "gone.png"}});
    folder.write("d.gltf", document.gltf());
    const std::vector<std::string> warnings = load(file).warnings;
    REQUIRE(warnings.size() == 21);
    CHECK(warnings[19].starts_with("a texture is missing: images[19].uri"));
    CHECK(warnings[20] == "30 more images are missing or are not looked at");
    folder.write("a b.bin", document.buffer.substr(1));
    CHECK(tells(error_of([&] { (void)load(file); }), "copy it again"));
    document.json["buffers"][0]["uri"] = "https://example.com/a.bin";
    CHECK(tells(load_error("d.gltf", document.gltf()), "only paths are read"));
}

TEST_CASE("gltf: wine_bottle.glb comes in whole") {
    check_read_model("wine_bottle.glb", {.vertices = 508, .triangles = 616, .uv_sets = 2});
}

TEST_CASE("gltf: WaterBottle.gltf comes in whole") {
    check_read_model("WaterBottle.gltf", {.vertices = 2549, .triangles = 4510, .tangents = true});
}

TEST_CASE("gltf: log_01.glb comes in whole") {
    check_read_model("log_01.glb", {.vertices = 1227, .triangles = 2190});
}

TEST_CASE("gltf: insect_leg.glb comes in whole") {
    check_read_model("insect_leg.glb", {.vertices = 1605, .triangles = 2528, .parts = 11});
}

TEST_CASE("gltf: cushion_02.glb comes in whole") {
    check_read_model("cushion_02.glb", {.vertices = 1982, .triangles = 3520});
}

TEST_CASE("gltf: log_01.glb stands upright in the world, as its node says") {
    const auto file = model("log_01.glb");
    if (file.empty()) return;
    glm::vec3 least(1e9f), most(-1e9f);
    for (const glm::vec3& p : load(file).positions) {
        least = glm::min(least, p);
        most = glm::max(most, p);
    }
    // the accessor's bounds, turned by -90 degrees about x and scaled by 100
    CHECK(close(least, {-0.166588824f, 0.00921261671f, -0.2519620815f}));
    CHECK(close(most, {0.173462031f, 1.01378383f, 0.188577396f}));
}
