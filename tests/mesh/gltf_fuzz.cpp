// SPDX-License-Identifier: MIT
#include "gltf_files.hpp"
#include "refined.hpp"
#include "support/models.hpp"

#include <algorithm>
#include <functional>
#include <random>
#include <string_view>

using namespace goffer::test;
using goffer::mesh::Error;
using goffer::mesh::Mesh;

namespace {

/// A small document with a bit of everything that the reader looks at.
Document subject() {
    Document document = tetra_with_nodes(
        R"([{"mesh": 0, "children": [1], "scale": [2, 1, -1]}, {"mesh": 0, "translation": [1, 2, 3]}])");
    Json second = primitive_of(document);
    second["mode"] = 5;
    second["attributes"]["COLOR_0"] = document.floats(std::vector<float>(16, 0.5f), "VEC4");
    second["attributes"].erase("NORMAL");
    document.json["meshes"][0]["primitives"].push_back(second);
    Json sparse = {{"count", 1}};
    sparse["indices"] = {{"bufferView", document.view(std::string("\2", 1))}, {"componentType", 5121}};
    sparse["values"] = {{"bufferView", document.view(std::string(12, '\0'))}};
    document.json["accessors"][0]["sparse"] = sparse;
    document.json["images"] = Json::parse(R"([{"bufferView": 5}])");
    document.json["materials"] =
        Json::parse(R"([{"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1]}}])");
    return document;
}

/// Reads what may be broken, and writes it, bent and then refined, where it could be read. Anything but Error
/// or success is a failure.
bool survives(const std::string& name, const std::string& bytes) {
    try {
        Mesh mesh = load_text(name, bytes);
        for (glm::vec3& p : mesh.positions) p.x = 0.5f * p.x + p.y;
        (void)saved(mesh, name);
        const Mesh cut = refined(mesh, halves(mesh).pieces());
        CHECK(reloaded(cut, name).corners == cut.corners);
        return true;
    } catch (const Error& error) {
        CHECK(std::string_view(error.what()).find('\n') == std::string_view::npos);
        return false;
    }
}

/// Swaps, overwrites, inserts or removes a few bytes.
std::string mutated_document(std::string bytes, std::mt19937& random) {
    const auto below = [&](std::size_t n) {
        return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
    };
    const std::string_view likely = "0123456789-.e[]{},:\"\xff\x7f\x80";
    for (std::size_t n = 1 + below(3); n > 0; --n) {
        const std::size_t at = below(bytes.size());
        switch (below(4)) {
            case 0:
                bytes[at] = static_cast<char>(below(256));
                break;
            case 1:
                bytes[at] = likely[below(likely.size())];
                break;
            case 2:
                bytes.insert(at, 1, likely[below(likely.size())]);
                break;
            default:
                bytes.erase(at, 1 + below(std::min<std::size_t>(8, bytes.size() - at)));
        }
    }
    return bytes;
}

/// Changes one value somewhere in a JSON tree.
void mutate_value(Json& json, std::mt19937& random) {
    const auto below = [&](std::size_t n) {
        return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
    };
    Json* at = &json;
    while (at->is_structured() && !at->empty() && below(12) != 0)
        at = &*std::next(at->begin(), static_cast<std::ptrdiff_t>(below(at->size())));
    const char* values[] = {"0",
                            "1",
                            "2",
                            "-1",
                            "3",
                            "4",
                            "5",
                            "6",
                            "100",
                            "5121",
                            "5126",
                            "4294967295",
                            "9007199254740992",
                            "1e300",
                            "0.5",
                            "1e-300",
                            "null",
                            "true",
                            "\"\"",
                            "\"VEC3\"",
                            "[]",
                            "{}",
                            "[0]",
                            "[0, 0, 0]"};
    *at = Json::parse(values[below(std::size(values))]);
}

}  // namespace

TEST_CASE("gltf fuzz: broken bytes of a GLB end in an error or a mesh") {
    std::mt19937 random(1);
    const std::string whole = subject().glb();
    REQUIRE(survives("d.glb", whole));
    std::size_t read = 0;
    for (int i = 0; i < 1200; ++i) read += survives("d.glb", mutated_document(whole, random));
    CHECK(read > 30);
    CHECK(read < 130);
}

TEST_CASE("gltf fuzz: broken bytes of a .gltf end in an error or a mesh") {
    std::mt19937 random(2);
    const std::string whole = subject().gltf();
    REQUIRE(survives("d.gltf", whole));
    std::size_t read = 0;
    for (int i = 0; i < 1200; ++i) read += survives("d.gltf", mutated_document(whole, random));
    CHECK(read > 40);
    CHECK(read < 160);
}

TEST_CASE("gltf fuzz: wrong values in the JSON end in an error or a mesh") {
    std::mt19937 random(3);
    std::size_t read = 0;
    for (int i = 0; i < 2000; ++i) {
        Document document = subject();
        mutate_value(document.json, random);
        if (!document.json.is_object()) continue;
        read += survives("d.glb", document.glb());
    }
    CHECK(read > 200);
    CHECK(read < 1000);
}
