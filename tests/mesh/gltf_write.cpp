// SPDX-License-Identifier: MIT
#include "gltf_files.hpp"
#include "support/models.hpp"

using namespace goffer::test;
using goffer::mesh::load;
using goffer::mesh::Mesh;
using goffer::mesh::save;

namespace {

/// Nodes with scale, mirror and shear (a rotated child of an unevenly scaled parent), and all fields that a
/// document may have.
Document rich_document() {
    Document document = tetra_with_nodes(R"([
        {"name": "root", "children": [1, 2], "scale": [2, 1, 0.5], "translation": [1, 2, 3], "extras": {"tag": [1, 2.5, "x"]}},
        {"mesh": 0, "rotation": [0.1, 0.2, 0.3, 0.9], "translation": [5, 0, 0]},
        {"mesh": 0, "scale": [-1, 1, 1], "rotation": [0, 0.6, 0, 0.8]}, {"camera": 0}])");
    document.json["cameras"] = Json::parse(
        R"([{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.01}, "name": "eye"}])");
    document.json["materials"] =
        Json::parse(R"([{"name": "skin", "extensions": {"VENDOR_unheard_of": {"deep": [{"k": 1e-5}]}}}])");
    document.json["extensionsUsed"] = {"VENDOR_unheard_of"};
    document.json["zeta"] = {{"b", 1}, {"a", 0.1}};
    const std::size_t times = document.floats({0, 1}, "SCALAR"),
                      turns = document.floats({0, 0, 0, 1, 0, 1, 0, 0}, "VEC4");
    Json animation =
        Json::parse(R"({"channels": [{"sampler": 0, "target": {"node": 3, "path": "rotation"}}]})");
    animation["samplers"].push_back({{"input", times}, {"output", turns}});
    document.json["animations"].push_back(animation);
    document.json["meshes"][0]["extras"] = {{"weight", 7}};
    document.json["accessors"][0]["name"] = "the points";
    primitive_of(document)["material"] = 0;
    return document;
}

/// The same with one user of the mesh.
Document rich_alone() {
    Document document = rich_document();
    document.json["nodes"][0]["children"] = {1};
    document.json["nodes"][2].erase("mesh");
    return document;
}

/// A change of shape that changes every vertex, normal and tangent.
Mesh bent_all_over(Mesh mesh) {
    for (glm::vec3& p : mesh.positions)
        p = {p.x + 0.3f * p.y + 1.0f, p.y - 0.2f * p.z * p.z, p.z * 1.1f - 0.25f};
    for (glm::vec3& n : mesh.normals.values) n = glm::normalize(glm::vec3(n.y + 0.1f, n.z, n.x));
    for (glm::vec4& t : mesh.tangents.values) t = glm::vec4(glm::normalize(glm::vec3(t.z, t.x, t.y)), t.w);
    return mesh;
}

void check_same_streams(const Mesh& a, const Mesh& b, float within) {
    REQUIRE(a.positions.size() == b.positions.size());
    REQUIRE(a.normals.values.size() == b.normals.values.size());
    REQUIRE(a.tangents.values.size() == b.tangents.values.size());
    for (std::size_t i = 0; i < a.positions.size(); ++i) CHECK(close(a.positions[i], b.positions[i], within));
    for (std::size_t i = 0; i < a.normals.values.size(); ++i)
        CHECK(close(a.normals.values[i], b.normals.values[i], within));
    for (std::size_t i = 0; i < a.tangents.values.size(); ++i) {
        CHECK(close(glm::vec3(a.tangents.values[i]), glm::vec3(b.tangents.values[i]), within));
        CHECK(a.tangents.values[i].w == b.tangents.values[i].w);
    }
}

Json without(Json json, const std::vector<const char*>& keys) {
    for (const char* key : keys) json.erase(key);
    return json;
}

std::string view_bytes(const Document& document, std::size_t view) {
    const Json& entry = document.json["bufferViews"][view];
    return document.buffer.substr(entry.value("byteOffset", 0), entry["byteLength"]);
}

Document saved_document(const Mesh& mesh) {
    return opened(saved(mesh, "out.glb"));
}

/// A GLB that is not changed comes out as it came in, but for spaces. Bent, any is found again in the world.
void check_written_model(const char* name) {
    const auto file = model(name);
    if (file.empty()) return;
    const Mesh mesh = load(file);
    if (file.extension() == ".glb") {
        const Document in = opened(bytes_of(file)), out = saved_document(mesh);
        CHECK(in.json.dump() == out.json.dump());
        CHECK(in.buffer == out.buffer);
    }
    const Mesh moved = bent_all_over(mesh);
    check_same_streams(reloaded(moved, "out.glb"), moved, 2e-6f);
}

}  // namespace

TEST_CASE("gltf: what only another scene shows stays as it is, whatever it is") {
    for (const Json& other : {Json::object(), Json(3), Json{{"primitives", 7}}}) {
        CAPTURE(other.dump());
        Document document = tetra();
        document.json["meshes"].push_back(other);
        document.json["nodes"].push_back({{"mesh", 1}});
        document.json["scenes"].push_back({{"nodes", {1}}});
        auto mesh = load_document(document);
        mesh.positions[0].x -= 1;
        const std::string out = saved(mesh, "d.gltf");
        CHECK(Json::parse(out)["meshes"][1] == other);
    }
}

TEST_CASE("gltf: an unchanged document comes out as it came in, to the last bit and in its order") {
    const Document document = rich_document();
    const Mesh mesh = load_document(document);
    const Document out = saved_document(mesh);
    CHECK(without(out.json, {"buffers"}).dump() == document.json.dump());
    CHECK(out.buffer == document.buffer);
    CHECK(saved(mesh, "a.glb") == document.glb());
}

TEST_CASE("gltf: a bent mesh is found again in the world, from GLB and from .gltf") {
    const Mesh mesh = bent_all_over(load_document(rich_document()));
    for (const char* name : {"out.glb", "out.gltf"}) check_same_streams(reloaded(mesh, name), mesh, 2e-6f);
}

TEST_CASE("gltf: wine_bottle.glb is written as it was, and bent, found again in the world") {
    check_written_model("wine_bottle.glb");
}

TEST_CASE("gltf: log_01.glb is written as it was, and bent, found again in the world") {
    check_written_model("log_01.glb");
}

TEST_CASE("gltf: insect_leg.glb is written as it was, and bent, found again in the world") {
    check_written_model("insect_leg.glb");
}

TEST_CASE("gltf: cushion_02.glb is written as it was, and bent, found again in the world") {
    check_written_model("cushion_02.glb");
}

TEST_CASE("gltf: WaterBottle.gltf is written as it was, and bent, found again in the world") {
    check_written_model("WaterBottle.gltf");
}

TEST_CASE("gltf: bending changes accessors of positions, normals and tangents, and nothing else") {
    const Document document = rich_alone();
    const Document out = saved_document(bent_all_over(load_document(document)));
    const std::vector<const char*> touched{"buffers", "bufferViews", "accessors"};
    CHECK(without(out.json, touched).dump() == without(document.json, touched).dump());
    REQUIRE(out.json["accessors"].size() == document.json["accessors"].size());
    CHECK(out.buffer.size() == document.buffer.size());
    CHECK(out.json["accessors"][0]["name"] == "the points");
    for (std::size_t i = 3; i < out.json["accessors"].size(); ++i) {
        CHECK(out.json["accessors"][i] == document.json["accessors"][i]);
        CHECK(view_bytes(out, i) == view_bytes(document, i));
    }
    for (std::size_t i = 0; i < 3; ++i) CHECK(view_bytes(out, i) != view_bytes(document, i));
}

TEST_CASE("gltf: the bounds of bent positions are exact") {
    const Document out = saved_document(bent_all_over(load_document(rich_document())));
    std::size_t checked = 0;
    for (const Json& mesh : out.json["meshes"]) {
        const Json& accessor =
            out.json["accessors"][mesh["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
        const std::string bytes = view_bytes(out, accessor["bufferView"]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            float least = 1e30f, most = -1e30f;
            for (std::size_t i = 0; i < 4; ++i) {
                float value = 0;
                std::memcpy(&value, bytes.data() + 12 * i + 4 * axis, 4);
                least = std::min(least, value);
                most = std::max(most, value);
            }
            CHECK(accessor["min"][axis].get<double>() == static_cast<double>(least));
            CHECK(accessor["max"][axis].get<double>() == static_cast<double>(most));
            ++checked;
        }
    }
    CHECK(checked == 6);
}

TEST_CASE("gltf: vertices that bending leaves alone keep their stored bits") {
    const Document document = rich_alone();
    Mesh mesh = load_document(document);
    mesh.positions[1] += glm::vec3(0.1f);
    const Document out = saved_document(mesh);
    const std::string before = view_bytes(document, 0), after = view_bytes(out, 0);
    CHECK(after.substr(0, 12) == before.substr(0, 12));
    CHECK(after.substr(12, 12) != before.substr(12, 12));
    CHECK(after.substr(24) == before.substr(24));
    CHECK(view_bytes(out, 1) == view_bytes(document, 1));  // the normals' accessor stays altogether
}

TEST_CASE("gltf: nodes that share a mesh get their own where shapes differ, and keep sharing where not") {
    const Document document = tetra_with_nodes(
        R"([{"mesh": 0}, {"mesh": 0, "translation": [8, 0, 0]}, {"mesh": 0, "translation": [16, 0, 0]}])");
    Document all = document;
    all.json["scenes"][0]["nodes"] = {0, 1, 2};
    Mesh mesh = load_document(all);
    for (glm::vec3& p : mesh.positions) p.y *= 2.0f;  // exact, and the same for all in their own space
    CHECK(saved_document(mesh).json["meshes"].size() == 1);
    for (std::size_t i = 8; i < 12; ++i) mesh.positions[i].z += 1.0f;
    const Document out = saved_document(mesh);
    REQUIRE(out.json["meshes"].size() == 2);
    CHECK(out.json["nodes"][1]["mesh"] == 0);
    CHECK(out.json["nodes"][2]["mesh"] == 1);
    CHECK(out.json["meshes"][1]["name"] == "tetra");
    check_same_streams(reloaded(mesh, "o.glb"), mesh, 1e-6f);

    Document outsider = document;  // nodes 1 and 2 are in no scene: their mesh must not change
    mesh = bent_all_over(load_document(outsider));
    const Json json = saved_document(mesh).json;
    CHECK(json["nodes"][0]["mesh"] == 1);
    CHECK(json["meshes"][0] == document.json["meshes"][0]);
}

TEST_CASE("gltf: primitives that share positions but not normals keep sharing positions") {
    Document document = tetra();
    Json second = primitive_of(document);
    second["attributes"].erase("NORMAL");
    document.json["meshes"][0]["primitives"].push_back(second);
    const Mesh mesh = load_document(document);
    CHECK(mesh.positions.size() == 8);
    const Document out = saved_document(bent_all_over(mesh));
    const Json& primitives = out.json["meshes"][0]["primitives"];
    CHECK(primitives[0]["attributes"]["POSITION"] == primitives[1]["attributes"]["POSITION"]);
    check_same_streams(reloaded(bent_all_over(mesh), "o.glb"), bent_all_over(mesh), 1e-6f);
}

TEST_CASE("gltf: an accessor that something else still uses stays beside its replacement") {
    Document document = tetra();
    primitive_of(document)["targets"] = Json::parse(R"([{"POSITION": 0}])");
    const Mesh mesh = bent_all_over(load_document(document));
    const Document out = saved_document(mesh);
    CHECK(out.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] == 0);
    CHECK(out.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] ==
          document.json["accessors"].size());
    CHECK(view_bytes(out, 0) == view_bytes(document, 0));
}

TEST_CASE("gltf: quantized, sparse and interleaved positions become plain floats, their neighbors stay") {
    Document document = tetra();
    std::string interleaved;
    for (std::uint16_t i = 0; i < 4; ++i) {
        interleaved += raw(std::vector<std::uint16_t>{i, static_cast<std::uint16_t>(i * i),
                                                      static_cast<std::uint16_t>(i == 2), 0});
        interleaved += raw(std::vector<float>{0.5f * static_cast<float>(i), 0.25f});
    }
    const std::size_t view = document.view(interleaved, 16);
    Json& attributes = primitive_of(document)["attributes"];
    attributes["POSITION"] = document.accessor(view, 5123, "VEC3", 4);
    attributes["TEXCOORD_0"] = document.accessor(view, 5126, "VEC2", 4, 8);
    document.json["extensionsRequired"] = document.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    const Mesh mesh = bent_all_over(load_document(document)), again = reloaded(mesh, "o.glb");
    check_same_streams(again, mesh, 1e-6f);
    CHECK(again.uvs[0].values == mesh.uvs[0].values);
    CHECK(again.uvs[0].values[3] == glm::vec2(1.5f, 0.75f));
    CHECK(view_bytes(saved_document(mesh), view) == interleaved);
}

TEST_CASE("gltf: a node that is flat cannot be written back: it stays, with a warning") {
    const Document document = tetra_with_nodes(R"([{"mesh": 0, "scale": [1, 0, 1]}])");
    const Mesh mesh = load_document(document);
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].find("nodes[0] is scaled to nothing or flat") != std::string::npos);
    CHECK(saved_document(bent_all_over(mesh)).buffer == document.buffer);
}

TEST_CASE("gltf: very uneven and very small scales are no flat ones") {
    for (const char* scale : {"[1e-6, 1, 1e6]", "[1e-12, 1e-12, 1e-12]"}) {
        const Mesh mesh = load_document(
            tetra_with_nodes((std::string(R"([{"mesh": 0, "scale": )") + scale + "}]").c_str()));
        CHECK(mesh.warnings.empty());
        Mesh moved = mesh;
        for (glm::vec3& p : moved.positions) p *= 1.5f;
        const Mesh again = reloaded(moved, "o.glb");
        for (std::size_t i = 0; i < 4; ++i) {
            for (int axis = 0; axis < 3; ++axis)
                CHECK(again.positions[i][axis] == doctest::Approx(moved.positions[i][axis]));
        }
    }
}

TEST_CASE("gltf: normals do not ask how small their node is, mirrored or not") {
    const auto normals = [](const std::string& scale) {
        const std::string nodes = R"([{"mesh": 0, "scale": [)" + scale + ", " + scale + ", " + scale + "]}]";
        return load_document(tetra_with_nodes(nodes.c_str())).normals.values;
    };
    CHECK(normals("1e-200") == normals("2"));
    CHECK(normals("-1e-200") == normals("-2"));
    const Mesh thin = load_document(tetra_with_nodes(R"([{"mesh": 0, "scale": [1, 1, 1e-160]}])"));
    for (const glm::vec3& n : thin.normals.values) CHECK(glm::length(n) == doctest::Approx(1));
}

TEST_CASE("gltf: images beside the source are taken into a GLB, and named from the new place by a .gltf") {
    const std::string png = "\x89PNG\r\n\x1a\n and so on";
    const Folder folder;
    folder.write("a b.png", png);
    Document document = tetra();
    document.json["images"] =
        Json::parse(R"([{"uri": "a%20b.png", "name": "one"}, {"uri": "gone.png"}, {"uri": "./a b.png"}])");
    const Mesh mesh = load(folder.write("d.gltf", document.gltf()));
    const Document glb = saved_document(mesh);
    CHECK(glb.json["images"][0].dump() == R"({"name":"one","mimeType":"image/png","bufferView":5})");
    CHECK(view_bytes(glb, 5) == png);
    CHECK(glb.json["images"][1]["uri"] == "gone.png");
    CHECK(glb.json["images"][2]["bufferView"] == 5);  // one file is taken in once

    // Those that are more than the memory allowed stay names.
    const Mesh frugal = load(folder / "d.gltf", {.limits = {.memory = 1 << 20}});
    folder.write("a b.png", png + std::string(2 << 20, 'x'));
    CHECK(saved_document(frugal).json["images"][0]["uri"].get<std::string>().ends_with("a%20b.png"));
    folder.write("a b.png", png);

    std::filesystem::create_directory(folder / "sub");
    save(mesh, folder / "sub/out.gltf");
    save(mesh, folder / "out.gltf");
    CHECK(Json::parse(bytes_of(folder / "sub/out.gltf"))["images"][0]["uri"] == "../a%20b.png");
    CHECK(Json::parse(bytes_of(folder / "out.gltf"))["images"][0]["uri"] == "a%20b.png");
}

TEST_CASE("gltf: several buffers become one") {
    const Folder folder;
    Document document = tetra();
    const std::string head = document.buffer.substr(0, 48), tail = document.buffer.substr(48);
    folder.write("head.bin", head);
    folder.write("tail.bin", "xx" + tail);
    for (std::size_t i = 1; i < 5; ++i) {
        document.json["bufferViews"][i]["buffer"] = 1;
        document.json["bufferViews"][i]["byteOffset"] =
            document.json["bufferViews"][i]["byteOffset"].get<std::size_t>() - 46;
    }
    document.json["buffers"] = {{{"uri", "head.bin"}, {"byteLength", 48}},
                                {{"uri", "tail.bin"}, {"byteLength", tail.size() + 2}}};
    const Mesh mesh = load(folder.write("d.gltf", document.gltf()));
    check_same_streams(mesh, load_document(tetra()), 0.0f);
    check_same_streams(reloaded(mesh, "o.glb"), mesh, 0.0f);
    check_same_streams(reloaded(bent_all_over(mesh), "o.gltf"), bent_all_over(mesh), 1e-6f);
    CHECK(saved_document(mesh).json["buffers"].size() == 1);
}

TEST_CASE("gltf: a mesh with other faces than its source is a new document") {
    Mesh mesh = load_document(rich_document());
    std::swap(mesh.corners[0], mesh.corners[1]);
    const Document out = saved_document(mesh);
    CHECK(out.json["asset"]["generator"] == "goffer");
    CHECK_FALSE(out.json.contains("cameras"));
}

TEST_CASE("gltf: normals that bending made unusable keep their old place") {
    const Document document = tetra();
    Mesh mesh = load_document(document);
    mesh.normals.values[1] = glm::vec3(0);
    mesh.tangents.values[2].x = std::nanf("");
    CHECK(saved_document(mesh).buffer == document.buffer);
}

TEST_CASE("gltf: a vertex that no float of its node's space can hold is refused") {
    Mesh mesh = load_document(tetra_with_nodes(R"([{"mesh": 0, "scale": [1e-30, 1e-30, 1e-30]}])"));
    mesh.positions[2].y = 1e20f;
    CHECK(tells(error_of([&] { (void)saved(mesh, "o.glb"); }),
                "vertex 2 is too far away for its node's scale"));
}
