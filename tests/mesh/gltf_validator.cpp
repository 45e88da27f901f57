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

TEST_CASE("gltf: what is written of the real models has no errors in Khronos' validator") {
    const Folder folder;
    std::vector<std::filesystem::path> files;
    for (const char* name :
         {"WaterBottle.gltf", "insect_leg.glb", "log_01.glb", "cushion_02.glb", "wine_bottle.glb",
          "banana.obj", "blub_open.obj", "koala.obj", "softball.obj", "fuze.ply", "lh_trochanterfemur.stl"}) {
        const auto file = model(name);
        if (file.empty()) continue;
        Mesh mesh = load(file);
        files.push_back(folder / (std::string(name) + ".same.glb"));
        save(mesh, files.back());
        files.push_back(folder / (std::string(name) + ".bent.glb"));
        save(sheared(mesh), files.back());
        mesh.source = nullptr;
        files.push_back(folder / (std::string(name) + ".made.glb"));
        save(mesh, files.back());
    }
    check_valid(files);
}
