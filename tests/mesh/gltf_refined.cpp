// SPDX-License-Identifier: MIT
#include "gltf_files.hpp"
#include "gltf_valid.hpp"
#include "refined.hpp"
#include "support/models.hpp"
#include "support/worst.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace goffer::mesh;
using namespace goffer::test;

namespace {

/// The values of an accessor: floats, or whole numbers of `width` bytes.
std::vector<double> values(const Document& document, const Json& number) {
    const Json& accessor = document.json["accessors"][number.get<std::size_t>()];
    const Json& view = document.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const int component = accessor["componentType"];
    const std::string type = accessor["type"];
    const std::size_t width = component <= 5121 ? 1 : component <= 5123 ? 2 : 4;
    const std::size_t count = accessor["count"].get<std::size_t>() *
                              (type == "SCALAR" ? 1u : static_cast<std::size_t>(type[3] - '0'));
    const char* at = document.buffer.data() + view.value("byteOffset", std::size_t{0});
    REQUIRE(!accessor.contains("byteOffset"));
    std::vector<double> out;
    for (std::size_t i = 0; i < count; ++i, at += width) {
        float real = 0;
        std::uint32_t whole = 0;
        std::memcpy(component == 5126 ? static_cast<void*>(&real) : &whole, at, width);
        out.push_back(component == 5126 ? static_cast<double>(real) : whole);
    }
    return out;
}

std::vector<double> slice(const std::vector<double>& all, std::size_t first, std::size_t count) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

Document refined_document(const Document& document, int axis = 2) {
    return opened(saved(refined_along(load_document(document), axis), "r.glb"));
}

/// The tetrahedron with bytes as joints, and weights.
Document skinned(const std::vector<float>& weights) {
    Document document = tetra();
    std::string joints("\0\1\0\0\0\1\0\0\0\1\0\0\2\3\4\0", 16);
    Json& attributes = primitive_of(document)["attributes"];
    attributes["JOINTS_0"] = document.accessor(document.view(joints), 5121, "VEC4", 4);
    attributes["WEIGHTS_0"] = document.floats(weights, "VEC4");
    document.json["accessors"].back().erase("min");
    document.json["accessors"].back().erase("max");
    document.json["nodes"] = Json::parse(R"([{"mesh": 0, "skin": 0}, {}, {}, {}, {}, {}])");
    document.json["scenes"][0]["nodes"] = {0, 1, 2, 3, 4, 5};
    document.json["skins"] = Json::parse(R"([{"joints": [1, 2, 3, 4, 5]}])");
    return document;
}

const std::vector<float> weights{0.75f, 0.25f, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0.5f, 0.25f, 0.25f, 0};

void check_refined_files(const char* name, int axis) {
    const auto file = model(name);
    if (file.empty()) return;
    const Folder folder;
    const std::vector<std::filesystem::path> files{folder / "refined.glb", folder / "bent.glb"};
    const Mesh mesh = refined_along(load(file), axis, 12);
    save(mesh, files[0]);
    VertexArrays bent = vertex_arrays(mesh);
    for (auto& p : bent.positions) p += glm::vec3(0.3f * p.y, 0.1f * p.z, 0.0f);
    save(with_vertex_arrays(mesh, bent), files[1]);
    check_valid(files);
}

}  // namespace

TEST_CASE("gltf: refined, every vertex array keeps its vertices and gets new ones behind") {
    const Document before = tetra();
    Document after = refined_document(before);
    const Json &was = before.json["meshes"][0]["primitives"][0]["attributes"],
               &now = primitive_of(after)["attributes"];
    for (const char* name : {"POSITION", "NORMAL", "TANGENT", "TEXCOORD_0"}) {
        CAPTURE(name);
        const auto old = values(before, was[name]), all = values(after, now[name]);
        CHECK(slice(all, 0, old.size()) == old);
        CHECK(all.size() == old.size() / 4 * (4 + 3 * 15));
    }
    CHECK(after.json["accessors"].size() == 5);
    CHECK(after.json["bufferViews"].size() == 5);
    CHECK(after.json["meshes"][0]["name"] == "tetra");
    const Mesh mesh = load_document(after);
    CHECK(open_edges(mesh) == 0);
    CHECK(volume(mesh) == doctest::Approx(volume(load_document(before))));
}

TEST_CASE("gltf: refined, joints of both ends are mixed, the largest stay, the sum is kept") {
    Document after = refined_document(skinned(weights));
    const Json& now = primitive_of(after)["attributes"];
    CHECK(after.json["accessors"][now["JOINTS_0"].get<std::size_t>()]["componentType"] == 5121);
    const auto joints = values(after, now["JOINTS_0"]), much = values(after, now["WEIGHTS_0"]),
               points = values(after, now["POSITION"]);
    REQUIRE(joints.size() == 4 * 49);
    REQUIRE(much.size() == 4 * 49);
    CHECK(slice(joints, 0, 16) == std::vector<double>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2, 3, 4, 0});
    CHECK(slice(much, 0, 16) == std::vector<double>(weights.begin(), weights.end()));
    for (std::size_t i = 4; i < 49; ++i) {
        CHECK(much[4 * i] + much[4 * i + 1] + much[4 * i + 2] + much[4 * i + 3] == doctest::Approx(1));
        CHECK(std::ranges::is_sorted(slice(much, 4 * i, 4), std::greater{}));
        // At three quarters of the way from vertex 0, which depends on joints 0 and 1, to the last vertex:
        // the lightest of five joints is dropped.
        const bool there = points[3 * i] == 0 && points[3 * i + 1] == 0 && points[3 * i + 2] == 2.25;
        if (!there) continue;
        const double kept = 0.375 + 0.1875 + 0.1875 + 0.1875;
        CHECK(slice(joints, 4 * i, 4) == std::vector<double>{2, 0, 3, 4});
        CHECK(much[4 * i] == doctest::Approx(0.375 / kept));
        CHECK(much[4 * i + 1] == doctest::Approx(0.1875 / kept));
    }
}

TEST_CASE("gltf: refined, a joint without weight leaves its place") {
    Document after = refined_document(skinned({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
    const auto joints = values(after, primitive_of(after)["attributes"]["JOINTS_0"]);
    REQUIRE(joints.size() == 4 * 49);
    for (std::size_t i = 4; i < 49; ++i) {
        CHECK(joints[4 * i] + joints[4 * i + 1] == 2);
        CHECK(joints[4 * i + 2] + joints[4 * i + 3] == 0);
    }
}

TEST_CASE("gltf: refined, places are those between places of the scene, whatever a node's transform rounds") {
    Mesh mesh = load_document(tetra_with_nodes(
        R"([{"mesh": 0, "scale": [3.3, 1.7, 1.1], "rotation": [0.1, 0.2, 0.3, 0.92736185], "translation": [0.7, 0.3, 0.1]}])"));
    const Mesh out = refined_along(mesh, 2);
    CHECK(out.source != nullptr);
    mesh.source = nullptr;
    CHECK(out.positions == refined_along(mesh, 2).positions);
}

TEST_CASE("gltf: refined, colors, names of vertices and morph targets go along") {
    Document before = tetra();
    Json& attributes = primitive_of(before)["attributes"];
    attributes["COLOR_0"] = before.accessor(
        before.view(std::string("\0\0\0\xff\0\0\0\xff\0\0\0\xff\xff\0\0\xff", 16)), 5121, "VEC4", 4);
    before.json["accessors"].back()["normalized"] = true;
    attributes["_ID"] = before.floats({3, 3, 3, 8}, "SCALAR");
    attributes["_KIND"] = before.accessor(
        before.view(raw(std::vector<std::uint16_t>{3, 0, 3, 0, 3, 0, 8, 0}), 4), 5123, "SCALAR", 4);
    const std::size_t moves = before.floats({0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0}, "VEC3");
    primitive_of(before)["targets"] = Json::array({{{"POSITION", moves}}});
    Document after = refined_document(before);
    const Json& now = primitive_of(after);
    const auto points = values(after, now["attributes"]["POSITION"]),
               colors = values(after, now["attributes"]["COLOR_0"]),
               ids = values(after, now["attributes"]["_ID"]),
               kinds = values(after, now["attributes"]["_KIND"]),
               target = values(after, now["targets"][0]["POSITION"]);
    REQUIRE(ids.size() == 49);
    for (std::size_t i = 0; i < 49; ++i) {
        const double t = points[3 * i + 2] / 3;
        CHECK(colors[4 * i] == doctest::Approx(t));
        CHECK(colors[4 * i + 3] == doctest::Approx(1));
        CHECK(ids[i] == doctest::Approx(3 + 5 * t));
        CHECK(kinds[i] == (t < 0.5 ? 3 : 8));
        CHECK(target[3 * i] == doctest::Approx(3 * t));
    }
    const Json& bounded = after.json["accessors"][now["targets"][0]["POSITION"].get<std::size_t>()];
    CHECK(bounded["max"][0] == 3.0);
}

TEST_CASE("gltf: refined, a mesh shown twice is cut twice where the nodes stand differently") {
    // Lying, its z is along x: the second is cut along another edge than the first.
    const Document before = tetra_with_nodes(
        R"([{"children": [1, 2]}, {"mesh": 0}, {"mesh": 0, "rotation": [0, 0.70710678, 0, 0.70710678],
             "scale": [-4, 4, 4]}])");
    const Mesh mesh = load_document(before), out = refined_along(mesh, 2);
    const Document after = opened(saved(out, "r.glb"));
    CHECK(after.json["meshes"].size() == 2);
    CHECK(after.json["nodes"][1]["mesh"] != after.json["nodes"][2]["mesh"]);
    CHECK(open_edges(out) == 0);
    CHECK(volume(out) == doctest::Approx(volume(mesh)).epsilon(1e-5));
    const Mesh back = reloaded(out, "r.gltf");
    CHECK(back.corners == out.corners);
    CHECK(open_edges(back) == 0);
    // and the first alone, where the second has its rows
    Document same = tetra_with_nodes(R"([{"mesh": 0}, {"mesh": 0, "scale": [1, 1, 0.001]}])");
    same.json["scenes"][0]["nodes"] = {0, 1};
    const Mesh part = refined_along(load_document(same), 2);
    CHECK(part.positions.size() == 49 + 4);
    const Document kept = opened(saved(part, "r.glb"));
    CHECK(kept.json["meshes"].size() == 2);
    CHECK(kept.json["accessors"].size() == 10);
}

TEST_CASE("gltf: refined, strips become triangles, points stay the points that they were") {
    Document before = tetra();
    primitive_of(before)["mode"] = 5;
    primitive_of(before)["indices"] = before.shorts({0, 1, 2, 3, 0, 1});
    Json points = primitive_of(before);
    points["mode"] = 0;
    points.erase("indices");
    before.json["meshes"][0]["primitives"].push_back(points);
    Document after = refined_document(before);
    const Json& now = after.json["meshes"][0]["primitives"];
    CHECK(!now[0].contains("mode"));
    CHECK(now[0]["attributes"] == now[1]["attributes"]);
    CHECK(now[1]["mode"] == 0);
    CHECK(values(after, now[1]["indices"]) == std::vector<double>{0, 1, 2, 3});
    const Mesh mesh = load_document(after);
    CHECK(open_edges(mesh) == 0);
    CHECK(mesh.parts.size() == 2);
}

TEST_CASE("gltf: refined, indices become wider where they must") {
    const Mesh mesh = load_document(tetra());
    for (const int folds : {1300, 1400}) {
        const int type = folds == 1300 ? 5123 : 5125;
        const Mesh out = refined_along(mesh, 2, folds);
        const Document after = opened(saved(out, "r.glb"));
        const std::size_t indices = after.json["meshes"][0]["primitives"][0]["indices"];
        CHECK(after.json["accessors"][indices]["componentType"] == type);
        CHECK(reloaded(out, "r.glb").corners == out.corners);
    }
}

TEST_CASE("gltf: refined and bent, only the refined document is changed") {
    const Mesh mesh =
        refined_along(load_document(tetra_with_nodes(R"([{"mesh": 0, "scale": [2, 3, 1]}])")), 2);
    VertexArrays bent = vertex_arrays(mesh);
    for (auto& p : bent.positions) p.x += p.z * p.z;
    const Mesh out = with_vertex_arrays(mesh, bent);
    const Document before = opened(saved(mesh, "r.glb")), after = opened(saved(out, "r.glb"));
    CHECK(after.json["meshes"] == before.json["meshes"]);
    CHECK(after.json["accessors"].size() == before.json["accessors"].size());
    const Mesh back = reloaded(out, "r.glb");
    REQUIRE(back.positions.size() == out.positions.size());
    float worst = 0;
    for (std::size_t i = 0; i < out.positions.size(); ++i)
        take_worst(worst, glm::length(back.positions[i] - out.positions[i]));
    CHECK(worst < 1e-6f);
    CHECK(back.uvs == mesh.uvs);
}

TEST_CASE("gltf: refined after a bend, what was bent is cut") {
    const Mesh rest = load_document(tetra());
    VertexArrays bent = vertex_arrays(rest);
    for (auto& p : bent.positions) p.z *= 2;
    const Mesh mesh = with_vertex_arrays(rest, bent), out = refined_along(mesh, 2);
    CHECK(out.source != nullptr);
    CHECK(std::equal(mesh.positions.begin(), mesh.positions.end(), out.positions.begin()));
    CHECK(reloaded(out, "r.glb").positions == out.positions);
    Mesh other = mesh;
    other.parts[0].name = "else";  // not its document's any more
    CHECK(refined_along(other, 2).source == nullptr);
    CHECK(refined_along(other, 2).positions == out.positions);
}

TEST_CASE("gltf: refined, numbers that are not finite do not spread to new vertices") {
    const float nan = std::numeric_limits<float>::quiet_NaN(), most = std::numeric_limits<float>::max();
    const auto broken = [](const std::vector<double>& all) {
        return std::ranges::count_if(all, [](double value) { return !std::isfinite(value); });
    };
    std::vector<float> own = weights;
    own[4] = nan;
    own[0] = own[1] = own[2] = own[3] = most;
    Document skin = refined_document(skinned(own));
    CHECK(broken(values(skin, primitive_of(skin)["attributes"]["WEIGHTS_0"])) == 1);
    Document document = tetra();
    const std::size_t shifts = document.floats({0, 0, 0, 0, 0, 0, 0, 0, 0, nan, 0, 2}, "VEC3"),
                      uvs = document.floats({0, 0, nan, 1, 0, 1, 1, 1}, "VEC2");
    primitive_of(document)["targets"].push_back({{"POSITION", shifts}});
    primitive_of(document)["attributes"]["TEXCOORD_0"] = uvs;
    Document after = refined_document(document);
    CHECK(broken(values(after, primitive_of(after)["attributes"]["TEXCOORD_0"])) == 1);
    const Json& target = primitive_of(after)["targets"][0]["POSITION"];
    CHECK(broken(values(after, target)) == 1);
    const Json& accessor = after.json["accessors"][target.get<std::size_t>()];
    CHECK(accessor["min"] == Json({0, 0, 0}));
    CHECK(accessor["max"] == Json({0, 0, 2}));
}

TEST_CASE("gltf: what cannot be refined is named") {
    const auto told = [](const Document& document) {
        const Mesh mesh = load_document(document);
        return error_of([&] { (void)refined_along(mesh, 2); });
    };
    Document lone = skinned(weights);
    primitive_of(lone)["attributes"].erase("WEIGHTS_0");
    CHECK(told(lone).find("attributes.JOINTS_0: has no WEIGHTS_0 beside it") != std::string::npos);
    Document other = skinned(weights);
    primitive_of(other)["attributes"].erase("JOINTS_0");
    CHECK(told(other).find("attributes.WEIGHTS_0: is not one of JOINTS_0, WEIGHTS_0") != std::string::npos);
    Document later = skinned(weights);
    for (const char* name : {"JOINTS_", "WEIGHTS_"}) {
        Json& attributes = primitive_of(later)["attributes"];
        attributes[std::string(name) + "1"] = attributes[std::string(name) + "0"];
        attributes.erase(std::string(name) + "0");
    }
    CHECK(told(later).find("attributes.JOINTS_1: is not one of") != std::string::npos);
    Document many = skinned(weights);
    primitive_of(many)["attributes"]["JOINTS_0"] = many.floats(std::vector<float>(16, 65536.0f), "VEC4");
    CHECK(told(many).find("JOINTS_0: has a joint whose number is not 0..65535, for vertex 0") !=
          std::string::npos);
    Document matrix = tetra();
    primitive_of(matrix)["attributes"]["_M"] =
        matrix.accessor(matrix.view(std::string(4 * 64, '\0')), 5126, "MAT4", 4);
    CHECK(told(matrix).find("_M -> accessors[5].type: is a matrix") != std::string::npos);
    Document few = tetra();
    primitive_of(few)["attributes"]["_F"] = few.floats({1, 2, 3}, "SCALAR");
    CHECK(told(few).find("attributes._F: has 3 elements, but POSITION has 4") != std::string::npos);
}

TEST_CASE("gltf: what is refined has no errors in Khronos' validator") {
    const Folder folder;
    std::vector<std::filesystem::path> files;
    const auto add = [&](const std::string& name, const Mesh& mesh) {
        files.push_back(folder / name);
        save(mesh, files.back());
    };
    Document morphed = skinned(weights);
    primitive_of(morphed)["targets"] =
        Json::array({{{"POSITION", morphed.floats({0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0}, "VEC3")}}});
    add("skinned.glb", refined_along(load_document(morphed), 2));
    add("twice.gltf",
        refined_along(load_document(tetra_with_nodes(
                          R"([{"children": [1, 2]}, {"mesh": 0}, {"mesh": 0, "scale": [-1, 3, 9]}])")),
                      2));
    check_valid(files);
}

TEST_CASE("gltf: insect_leg.glb, refined, has no errors in Khronos' validator") {
    check_refined_files("insect_leg.glb", 0);
}

TEST_CASE("gltf: log_01.glb, refined, has no errors in Khronos' validator") {
    check_refined_files("log_01.glb", 1);
}

TEST_CASE("gltf: cushion_02.glb, refined, has no errors in Khronos' validator") {
    check_refined_files("cushion_02.glb", 0);
}

TEST_CASE("gltf: wine_bottle.glb, refined, has no errors in Khronos' validator") {
    check_refined_files("wine_bottle.glb", 1);
}

TEST_CASE("gltf: WaterBottle.gltf, refined, has no errors in Khronos' validator") {
    check_refined_files("WaterBottle.gltf", 1);
}

TEST_CASE("gltf: refined, vertices between new vertices are those of two refinements, joints and all") {
    const Document document = skinned(weights);
    const Mesh mesh = load_document(document), half = refined(mesh, halves(mesh).pieces());
    const Document twice = opened(saved(refined(half, halves(half).pieces()), "twice.glb"));
    const Document once = opened(saved(refined(mesh, quarters(mesh).pieces()), "once.glb"));
    for (const std::string name : {"POSITION", "JOINTS_0", "WEIGHTS_0"}) {
        CAPTURE(name);
        const auto of = [&](Document made) { return values(made, primitive_of(made)["attributes"][name]); };
        const std::vector<double> a = of(once), b = of(twice);
        REQUIRE(a.size() == 34 * (name == "POSITION" ? 3u : 4u));
        REQUIRE(a.size() == b.size());
        double off = 0;
        for (std::size_t i = 0; i < a.size(); ++i) take_worst(off, std::abs(a[i] - b[i]));
        CHECK(off <= (name == "WEIGHTS_0" ? 1e-7 : 0));  // rounded to floats between the two
    }
    const auto corners = [](Document made) { return values(made, primitive_of(made)["indices"]); };
    CHECK(corners(once) == corners(twice));
}
