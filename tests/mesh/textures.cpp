// SPDX-License-Identifier: MIT
#include "gltf_files.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <tuple>

/// The base-color textures of materials: found in all the ways that files hold them, and left out where they
/// are broken or missing.

using namespace goffer::mesh;
using namespace goffer::test;

namespace {

const std::string image_bytes = "\x89PNG\r\n what no one decodes here";

/// A tetrahedron whose material has a texture; the image is still to come.
Document textured() {
    Document document = tetra();
    document.json["materials"] = Json::parse(
        R"([{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 1, 1], "baseColorTexture": {"index": 0}}}])");
    document.json["textures"] = Json::parse(R"([{"source": 0, "sampler": 0}])");
    document.json["samplers"] = Json::parse(R"([{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}])");
    primitive_of(document)["material"] = 0;
    return document;
}

Json& info_of(Document& document) {
    return document.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
}

Document with_view() {
    Document document = textured();
    const std::size_t view = document.view(image_bytes);
    document.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
    return document;
}

void check_texture(const Mesh& mesh) {
    CHECK(mesh.warnings.empty());
    REQUIRE(mesh.materials.size() == 1);
    REQUIRE(mesh.materials[0].texture);
    const Texture& texture = *mesh.materials[0].texture;
    CHECK(texture.image->bytes() == image_bytes);
    CHECK(texture.wrap_u == Wrap::clamp);
    CHECK(texture.wrap_v == Wrap::mirror);
    CHECK(texture.nearest);
    CHECK(texture.factor == glm::vec4(0.5f, 1, 1, 1));
    const std::vector<glm::vec2> uvs = texture_uvs(mesh);
    REQUIRE(uvs.size() == mesh.corners.size());
    for (std::size_t c = 0; c < uvs.size(); ++c) CHECK(uvs[c] == mesh.uvs[0].values[mesh.corners[c]]);
}

}  // namespace

TEST_CASE("textures: of a glTF, in its buffer, in its text and beside it") {
    check_texture(load_document(with_view()));
    Document document = textured();
    SUBCASE("in its text") {
        document.json["images"].push_back({{"uri", "data:image/png;base64," + base64(image_bytes)}});
        check_texture(load_text("d.gltf", document.gltf()));
    }
    SUBCASE("beside it, where it is read when it is asked for") {
        const Folder folder;
        document.json["images"].push_back({{"uri", "a%20b.png"}});
        folder.write("a b.png", "not yet");
        const Mesh mesh = load(folder.write("d.gltf", document.gltf()));
        folder.write("a b.png", image_bytes);
        check_texture(mesh);
        std::filesystem::remove(folder / "a b.png");
        CHECK(tells(error_of([&] { (void)mesh.materials[0].texture->image->bytes(); }), "a b.png"));
    }
}

TEST_CASE("textures: outlive the mesh, and change nothing that is written") {
    Document plain = with_view();
    Mesh mesh = load_document(plain);
    const std::string written = saved(mesh, "a.glb");
    const std::shared_ptr<const Image> image = mesh.materials[0].texture->image;
    mesh.materials[0].texture.reset();
    CHECK(saved(mesh, "a.glb") == written);
    mesh = {};
    CHECK(image->bytes() == image_bytes);
}

TEST_CASE("textures: an image outside the folder, or larger than the limit, is not read") {
    const Folder folder;
    std::filesystem::create_directory(folder / "in");
    folder.write("secret.png", image_bytes);
    Document document = textured();
    document.json["images"].push_back({{"uri", "../secret.png"}});
    const std::filesystem::path file = folder.write("in/d.gltf", document.gltf());
    CHECK(!load(file).materials[0].texture);
    check_texture(load(file, {.allow_outside = true}));
    const std::size_t megabyte = std::size_t{1} << 20;
    folder.write("secret.png", std::string(2 * megabyte, 'x'));
    const Mesh mesh = load(file, {.allow_outside = true, .limits = {.memory = megabyte}});
    CHECK(tells(error_of([&] { (void)mesh.materials[0].texture->image->bytes(); }), "secret.png"));
}

TEST_CASE("textures: what is broken is a warning, and a mesh without it") {
    const auto check = [](const Document& document, const std::string& what) {
        CAPTURE(what);
        const Mesh mesh = load_document(document);
        CHECK(mesh.positions.size() == 4);
        CHECK(!mesh.materials[0].texture);
        CHECK(texture_uvs(mesh).empty());
        const auto says = [&](const std::string& warning) { return warning.find(what) != warning.npos; };
        CHECK(std::ranges::any_of(mesh.warnings, says));
        CHECK(!saved(mesh, "a.glb").empty());
    };
    const std::string where =
        "a texture is not looked at: materials[0].pbrMetallicRoughness.baseColorTexture";
    for (const auto& [pointer, value, what] :
         {std::tuple{"/materials/0/pbrMetallicRoughness/baseColorTexture/index", "7",
                     "textures[7], but there are 1"},
          std::tuple{"/materials/0/pbrMetallicRoughness/baseColorTexture/index", "-1",
                     "expected a whole number"},
          std::tuple{"/materials/0/pbrMetallicRoughness/baseColorTexture/texCoord", "\"x\"",
                     "is a JSON string"},
          std::tuple{"/textures/0/source", "1", "images[1], but there are 1"},
          std::tuple{"/textures/0/source", "{}", "is a JSON object"},
          std::tuple{"/textures/0/sampler", "1e9", "but there are 1"},
          std::tuple{"/samplers/0/wrapS", "[]", "is a JSON array"},
          std::tuple{"/images/0/bufferView", "99", "bufferViews[99]"}}) {
        Document document = with_view();
        document.json[Json::json_pointer(pointer)] = Json::parse(value);
        check(document, what);
    }
    Document document = with_view();
    document.json["textures"][0].erase("source");
    check(document, "has no image that all programs read");
    document.json["textures"] = 5;
    check(document, "is a JSON number");
    document = with_view();
    info_of(document) = 3;
    check(document, where + ": is a JSON number");
    document = textured();
    document.json["images"].push_back({{"uri", "http://a/b.png"}});
    check(document, "only paths are read");
    document.json["images"][0]["uri"] = "gone.png";
    check(document, "a texture is missing");
}

TEST_CASE("textures: a data URI that is none is found out when it is asked for") {
    Document document = textured();
    document.json["images"].push_back({{"uri", "data:image/png;base64,?"}});
    const Mesh mesh = load_document(document);
    REQUIRE(mesh.materials[0].texture);
    const std::string error = error_of([&] { (void)mesh.materials[0].texture->image->bytes(); });
    CHECK(error.find("not a well-formed data URI") != error.npos);
}

TEST_CASE("textures: KHR_texture_transform, as its example has it: the lower left quadrant") {
    Document document = with_view();
    info_of(document)["extensions"]["KHR_texture_transform"] =
        Json::parse(R"({"offset": [0, 1], "rotation": 1.57079632679, "scale": [0.5, 0.5], "texCoord": 0})");
    const Mesh mesh = load_document(document);
    const std::vector<glm::vec2> uvs = texture_uvs(mesh);
    for (std::size_t c = 0; c < uvs.size(); ++c) {
        const glm::vec2 was = mesh.uvs[0].values[mesh.corners[c]];
        // Where v points down, u' = v / 2 and v' = 1 - u / 2.
        CHECK(glm::distance(uvs[c], glm::vec2((1 - was.y) / 2, was.x / 2)) < 1e-6f);
    }
    info_of(document)["texCoord"] = 3;
    info_of(document).erase("extensions");
    CHECK(texture_uvs(load_document(document)).empty());  // there is no such set
}

TEST_CASE("textures: of an OBJ, with its options, and for every corner on a seam its own place") {
    const Folder folder;
    folder.write("sub.png", image_bytes);
    folder.write("a.mtl",
                 "newmtl red\nKd 0.1 0.1 0.1\nmap_Kd -s 2 3 1 -o 0.5 0.25 0 -clamp on sub.png\n"
                 "newmtl blue\nmap_Kd gone.png\nnewmtl far\nmap_Kd ../far.png\n");
    // Two squares side by side over six vertices, with a seam between them; and one without a texture.
    const Mesh mesh =
        load(folder.write("a.obj",
                          "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n"
                          "vt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\nusemtl red\nf 1/1 2/2 5/4 4/3\nf 2/1 3/2 6/4 5/3\n"
                          "usemtl blue\nf 1/1 2/2 5/4\nusemtl far\nf 1/1 2/2 5/4\n"));
    REQUIRE(mesh.materials.size() == 3);
    REQUIRE(mesh.materials[0].texture);
    CHECK(!mesh.materials[1].texture);
    CHECK(!mesh.materials[2].texture);
    const Texture& texture = *mesh.materials[0].texture;
    CHECK(texture.image->bytes() == image_bytes);
    CHECK(texture.wrap_u == Wrap::clamp);
    CHECK(texture.factor == glm::vec4(1));
    const VertexArrays arrays = vertex_arrays_with_uvs(mesh);
    const std::vector<glm::vec2> uvs = texture_uvs(mesh);
    REQUIRE(uvs.size() == arrays.triangles.size());
    for (std::size_t c = 0; c < uvs.size(); ++c) {
        const glm::vec2 own = arrays.uvs[arrays.triangles[c]];
        CHECK(uvs[c] == (c < 12 ? glm::vec2(2 * own.x + 0.5f, 3 * own.y + 0.25f) : glm::vec2(0)));
    }
}
