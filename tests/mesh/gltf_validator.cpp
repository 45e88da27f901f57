// SPDX-License-Identifier: MIT
#include "gltf_files.hpp"
#include "gltf_valid.hpp"
#include "support/models.hpp"

using namespace goffer::test;
using goffer::mesh::load;
using goffer::mesh::Mesh;
using goffer::mesh::save;

namespace {

Mesh sheared(Mesh mesh) {
    for (glm::vec3& p : mesh.positions) p += glm::vec3(0.3f * p.y, 0.1f * p.z, 0.0f);
    for (glm::vec3& n : mesh.normals.values) n = glm::vec3(n.y, n.z, n.x);
    return mesh;
}

void save_all(const Folder& folder, const std::string& stem, const Mesh& mesh,
              std::vector<std::filesystem::path>& files) {
    for (const char* ending : {".glb", ".gltf"}) {
        files.push_back(folder / (stem + ending));
        save(mesh, files.back());
    }
}

void check_valid_model(const char* name) {
    const auto file = model(name);
    if (file.empty()) return;
    const Folder folder;
    const std::vector<std::filesystem::path> files{folder / "same.glb", folder / "bent.glb",
                                                   folder / "made.glb"};
    Mesh mesh = load(file);
    save(mesh, files[0]);
    save(sheared(mesh), files[1]);
    mesh.source = nullptr;
    save(mesh, files[2]);
    check_valid(files);
}

}  // namespace

TEST_CASE("gltf: what is written of small documents has no errors in Khronos' validator") {
    const Folder folder;
    std::vector<std::filesystem::path> files;
    Document document = tetra_with_nodes(
        R"([{"children": [1, 2], "scale": [2, 1, 0.5]}, {"mesh": 0, "rotation": [0.5, 0.5, 0.5, 0.5]},
                                             {"mesh": 0, "scale": [-1, 1, 1]}])");
    save_all(folder, "same", load_document(document), files);
    save_all(folder, "bent", sheared(load_document(document)), files);
    Json second = primitive_of(document);
    second["attributes"].erase("NORMAL");
    second["attributes"].erase("TANGENT");
    document.json["meshes"][0]["primitives"].push_back(second);
    Mesh mesh = sheared(load_document(document));
    save_all(folder, "mixed", mesh, files);
    mesh.source = nullptr;
    mesh.normals.values[0] = glm::vec3(0.0f);
    mesh.colors.assign(mesh.positions.size(), glm::vec4(0.5f, 2.0f, -1.0f, 1.0f));
    mesh.materials = {{"clear", {0.5f, 0.5f, 3.0f, 0.5f}}};
    mesh.parts[0].material = 0;
    save_all(folder, "made", mesh, files);
    check_valid(files);
}

TEST_CASE("gltf: what is written of WaterBottle.gltf has no errors in Khronos' validator") {
    check_valid_model("WaterBottle.gltf");
}

TEST_CASE("gltf: what is written of insect_leg.glb has no errors in Khronos' validator") {
    check_valid_model("insect_leg.glb");
}

TEST_CASE("gltf: what is written of log_01.glb has no errors in Khronos' validator") {
    check_valid_model("log_01.glb");
}

TEST_CASE("gltf: what is written of cushion_02.glb has no errors in Khronos' validator") {
    check_valid_model("cushion_02.glb");
}

TEST_CASE("gltf: what is written of wine_bottle.glb has no errors in Khronos' validator") {
    check_valid_model("wine_bottle.glb");
}

TEST_CASE("gltf: what is written of banana.obj has no errors in Khronos' validator") {
    check_valid_model("banana.obj");
}

TEST_CASE("gltf: what is written of blub_open.obj has no errors in Khronos' validator") {
    check_valid_model("blub_open.obj");
}

TEST_CASE("gltf: what is written of koala.obj has no errors in Khronos' validator") {
    check_valid_model("koala.obj");
}

TEST_CASE("gltf: what is written of softball.obj has no errors in Khronos' validator") {
    check_valid_model("softball.obj");
}

TEST_CASE("gltf: what is written of fuze.ply has no errors in Khronos' validator") {
    check_valid_model("fuze.ply");
}

TEST_CASE("gltf: what is written of lh_trochanterfemur.stl has no errors in Khronos' validator") {
    check_valid_model("lh_trochanterfemur.stl");
}
