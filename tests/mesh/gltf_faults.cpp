// SPDX-License-Identifier: MIT
#include "gltf_files.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <limits>
#include <utility>
#include <vector>

/// glTF that is broken, or more than goffer reads: what is said of it.

using namespace goffer::test;

namespace {

/// The message for a tetrahedron that `spoil` has changed.
std::string error_when(const std::function<void(Document&)>& spoil) {
    Document document = tetra();
    spoil(document);
    return load_error("d.glb", document.glb());
}

}  // namespace

TEST_CASE("gltf: the way out of a compression is a tool that knows it") {
    Document document = tetra();
    document.json["extensionsRequired"] = {"KHR_meshopt_compression"};
    CHECK(tells(load_error("d.glb", document.glb()), "decompress it: gltfpack -noq -i IN -o OUT"));
    document.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    CHECK(tells(load_error("d.glb", document.glb()), "decompress it: gltf-transform copy IN OUT"));
}

TEST_CASE("gltf: an extension that is required and unknown is warned of") {
    Document document = tetra();
    document.json["extensionsRequired"] = {"KHR_materials_unlit", "KHR_texture_transform",
                                           "KHR_mesh_quantization"};
    CHECK(load_document(document).warnings.empty());
    document.json["extensionsRequired"].push_back("FOO_bar");
    const goffer::mesh::Mesh mesh = load_document(document);
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].starts_with("extensionsRequired names 'FOO_bar', which goffer does not know"));
}

TEST_CASE("gltf: of data that are compressed and plain, the plain ones are read, and kept alone") {
    Document document = tetra();
    const goffer::mesh::Mesh plain = load_document(document);
    const std::string uri = "data:application/octet-stream;base64," + base64(document.buffer);
    const Json fallback = {{"EXT_meshopt_compression", {{"fallback", true}}}};
    document.json["buffers"] = {
        {{"byteLength", document.buffer.size()}, {"uri", uri}, {"extensions", fallback}}};
    document.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                                                {"byteLength", 9}};
    document.json["extensionsUsed"] = {"EXT_meshopt_compression", "KHR_draco_mesh_compression"};
    primitive_of(document)["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0},
                                                                          {"attributes", {{"POSITION", 0}}}};
    goffer::mesh::Mesh read = load_text("d.gltf", document.gltf());
    CHECK(read.positions == plain.positions);
    CHECK(read.corners == plain.corners);
    read.positions[0].x -= 1;
    const std::string out = saved(read, "d.gltf");
    CHECK(out.find("ompression") == std::string::npos);
    CHECK(out.find("extensions") == std::string::npos);

    Document without = document;
    without.json["buffers"][0].erase("uri");
    CHECK(tells(load_error("d.gltf", without.gltf()),
                "extensionsUsed[0]: the mesh is compressed with EXT_meshopt"));
    without = document;
    without.json["accessors"][0].erase("bufferView");
    CHECK(tells(load_error("d.gltf", without.gltf()),
                "extensionsUsed[1]: the mesh is compressed with KHR_draco"));
}

TEST_CASE("gltf: what is broken is named with its place and the way out") {
    const auto set = [](const char* pointer, const char* value) {
        return [=](Document& d) { d.json[Json::json_pointer(pointer)] = Json::parse(value); };
    };
    const std::vector<std::pair<std::function<void(Document&)>, const char*>> cases{
        {set("/scene", "3"), "scene: names scenes[3], but there are 1; export"},
        {set("/scenes/0/nodes", "[0, 9]"), "scenes[0].nodes[1]: names nodes[9]"},
        {set("/nodes/0/mesh", "7"), "nodes[0].mesh: names meshes[7]"},
        {set("/nodes/0/mesh", "-1"), "nodes[0].mesh: is -1, expected a whole number"},
        {set("/nodes/0/mesh", "0.5"), "nodes[0].mesh: is 0.5"},
        {set("/nodes/0/mesh", "\"zero\""), "nodes[0].mesh: is a JSON string, expected a number"},
        {set("/nodes", "[{\"mesh\": 0, \"children\": [0]}]"), "nodes[0]: is reached twice: a cycle"},
        {set("/nodes/0/rotation", "[0, 0, 0, 0]"), "nodes[0].rotation: is not a unit quaternion"},
        {set("/nodes/0/matrix", "[1, 2]"), "nodes[0].matrix: has 2 elements, expected 16 numbers"},
        {set("/nodes/0/scale", "[1, 1, 1e300]"),
         "meshes[0].primitives[0].attributes.POSITION: vertex 3 is not finite"},
        {set("/nodes", "[{}]"), "no node of the scene carries a mesh"},
        {set("/meshes/0/primitives/0/attributes/POSITION", "50"),
         "meshes[0].primitives[0].attributes.POSITION: names accessors[50]"},
        {set("/meshes/0/primitives/0/attributes/NORMAL", "3"),
         "attributes.NORMAL -> accessors[3].type: is the wrong one here, expected VEC3"},
        {set("/meshes/0/primitives/0/attributes", "{\"NORMAL\": 1}"),
         "meshes[0].primitives[0].attributes: has no \"POSITION\""},
        {set("/meshes/0/primitives/0/indices", "12"), "meshes[0].primitives[0].indices: names accessors[12]"},
        {set("/meshes/0/primitives/0/indices", "0"),
         "accessors[0].type: is the wrong one here, expected SCALAR"},
        {set("/meshes/0/primitives/0/mode", "7"), "meshes[0].primitives[0].mode: is 7"},
        {set("/meshes/0/primitives/0/material", "0"),
         "primitives[0].material: names materials[0], but there are 0"},
        {set("/accessors/0/count", "5"),
         "accessors[0]: 5 elements from byte 0 on, 12 bytes apart, do not fit into the 48 bytes of "
         "bufferViews[0]"},
        {set("/accessors/0/count", "9007199254740000"), "do not fit"},
        {set("/accessors/0/count", "0"), "accessors[0].count: is 0"},
        {set("/accessors/1/count", "3"), "attributes.NORMAL: has 3 elements, but POSITION has 4"},
        {set("/accessors/0/byteOffset", "4"), "from byte 4 on"},
        {set("/accessors/0/componentType", "5124"), "accessors[0].componentType: is 5124"},
        {set("/accessors/4/componentType", "5126"),
         "accessors[4].componentType: is 5126, expected 5121, 5123 or 5125"},
        {set("/accessors/0/bufferView", "99"), "accessors[0].bufferView: names bufferViews[99]"},
        {set("/accessors/0", "{\"componentType\": 5126, \"count\": 4000000000, \"type\": \"VEC3\"}"),
         "accessors[0].count: is 4000000000 without a bufferView"},
        {set("/bufferViews/0/byteStride", "8"), "byteStride is 8, expected 12 to 252"},
        {set("/bufferViews/0/buffer", "1"), "bufferViews[0].buffer: names buffers[1]"},
        {set("/bufferViews/3/byteLength", "100000"), "bufferViews[3]: spans bytes"},
        {set("/bufferViews/3/byteOffset", "18446744073709551615"),
         "bufferViews[3].byteOffset: is 18446744073709551615"},
        {set("/buffers", "[{\"byteLength\": 100000}]"), "that byteLength promises"},
        {set("/buffers", "[{\"byteLength\": 4}, {\"byteLength\": 4}]"),
         "buffers[1]: has neither a \"uri\" nor a GLB's BIN chunk"},
        {set("/asset/version", "\"1.0\""), "asset.version: is '1.0'; only glTF 2 can be read"},
        {set("/asset", "{}"), "asset: has no \"version\""},
        {set("/extensionsRequired", "[\"KHR_draco_mesh_compression\"]"),
         "extensionsRequired[0]: the mesh is compressed with KHR_draco_mesh_compression, which cannot be "
         "read; decompress it: gltf-transform"},
        {set("/meshes", "3"), "meshes: is a JSON number, expected an array"},
    };
    for (const auto& known : cases) {
        const std::string message = error_when(known.first);
        CHECK_MESSAGE(tells(message, known.second), "expected: ", known.second, "\nbut got: ", message);
    }
}

TEST_CASE("gltf: a vertex index out of range and a position that is not a number are named") {
    Document document = tetra();
    document.buffer.replace(document.buffer.size() - 24, 2, raw(std::vector<std::uint16_t>{77}));
    CHECK(tells(load_error("d.glb", document.glb()),
                "primitives[0].indices: entry 0 is vertex 77, but there are 4"));
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        document = tetra();
        document.buffer.replace(16, 4, raw(std::vector<float>{bad}));
        CHECK(tells(load_error("d.glb", document.glb()), "attributes.POSITION: vertex 1 is not finite"));
    }
}

TEST_CASE("gltf: sparse indices and counts are checked") {
    Document document = tetra();
    Json sparse = {{"count", 1}};
    sparse["indices"] = {{"bufferView", document.view(std::string("\x04", 1))}, {"componentType", 5121}};
    sparse["values"] = {{"bufferView", document.view(std::string(12, '\0'))}};
    document.json["accessors"][0]["sparse"] = sparse;
    CHECK(tells(load_error("d.glb", document.glb()),
                "accessors[0].sparse.indices: entry 0 is 4, but the accessor has 4 elements"));
    document.json["accessors"][0]["sparse"]["count"] = 2;
    CHECK(tells(load_error("d.glb", document.glb()), "do not fit"));
    document.json["accessors"][0]["sparse"]["count"] = 5;
    CHECK(tells(load_error("d.glb", document.glb()),
                "accessors[0].sparse.count: is 5, but the accessor has 4 elements"));
    // Of no element none can be missing.
    Json& none = document.json["accessors"][0]["sparse"];
    none["count"] = 0;
    none["indices"]["byteOffset"] = 1;
    CHECK(load_error("d.glb", document.glb()).empty());
}

TEST_CASE("gltf: a node that is drawn many times is bent once, and that is said") {
    const Document document =
        tetra_with_nodes(R"([{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {}}}}])");
    const goffer::mesh::Mesh mesh = load_text("d.glb", document.glb());
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0] == "nodes[0] is drawn many times: it is bent once, at the node's own place");
}

TEST_CASE("gltf: a cycle without a scene, and a node with two parents, are named") {
    Document document = tetra_with_nodes(R"([{"mesh": 0, "children": [1]}, {"children": [0]}])");
    document.json.erase("scenes");
    document.json.erase("scene");
    CHECK(tells(load_error("d.glb", document.glb()), "a cycle"));
    document = tetra_with_nodes(R"([{"children": [1, 1]}, {"mesh": 0}])");
    CHECK(tells(load_error("d.glb", document.glb()), "nodes[1]: is reached twice"));
}

TEST_CASE("gltf: a mesh repeated without end is refused, deep nodes and deep extras are no danger") {
    Document document = tetra();
    const std::size_t many = 200000;
    document.json["accessors"][0] = {{"componentType", 5126}, {"count", 1000000}, {"type", "VEC3"}};
    primitive_of(document) = {{"attributes", {{"POSITION", 0}}}};
    for (std::size_t i = 1; i < 40; ++i) {
        document.json["nodes"].push_back({{"mesh", 0}});
        document.json["scenes"][0]["nodes"].push_back(i);
    }
    CHECK(tells(load_error("d.glb", document.glb()), "more than 1048576 elements without a bufferView"));

    document = tetra();
    for (std::size_t i = 1; i < many; ++i) document.json["nodes"].push_back({{"children", {i - 1}}});
    document.json["scenes"][0]["nodes"][0] = many - 1;
    CHECK(load_document(document).positions[1] == glm::vec3(2, 0, 0));

    const auto with_extras = [text = tetra().gltf()](std::size_t depth) {
        return "{\"extras\": " + std::string(depth, '[') + std::string(depth, ']') + "," + text.substr(1);
    };
    CHECK(tells(load_error("d.gltf", with_extras(many)), "nested more than 200 deep"));
    CHECK(tells(load_error("d.gltf", with_extras(200)), "nested more than 200 deep"));
    CHECK(load_error("d.gltf", with_extras(199)).empty());
}

TEST_CASE("gltf: a GLB cut off anywhere is refused, and so are other versions") {
    const std::string whole = tetra().glb();
    for (std::size_t length = 4; length < whole.size(); ++length) {
        CHECK_MESSAGE(!load_error("d.glb", whole.substr(0, length)).empty(), "cut to ", length);
    }
    CHECK(tells(load_error("d.glb", whole.substr(0, 1000)), "the GLB is cut off"));
    // A second chunk of another type is no buffer, and a third one neither.
    const std::size_t binary = whole.find(std::string("BIN\0", 4));
    REQUIRE(binary != whole.npos);
    std::string unknown = whole;
    unknown.replace(binary, 4, "ODD!");
    CHECK(tells(load_error("d.glb", unknown), "buffers[0]"));
    std::string late = whole;
    late.insert(binary - 4, std::string("\0\0\0\0ODD!", 8));
    late[8] = static_cast<char>(static_cast<unsigned char>(late[8]) + 8);
    CHECK(tells(load_error("d.glb", late), "buffers[0]"));
    std::string other = whole;
    other[4] = 1;
    CHECK(tells(load_error("d.glb", other), "is GLB version 1; only 2 can be read"));
    CHECK(tells(load_error("d.gltf", "{\"asset\": {\"version\": \"2.0\"},}"), "not valid JSON at byte"));
    CHECK(tells(load_error("d.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"x\": 1e999}"),
                "number that no double can hold"));
}
