// SPDX-License-Identifier: MIT
#include "gltf_files.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

/// Files with many of one thing: the time grows as the file does, not with its square.

using namespace goffer::mesh;
using namespace goffer::test;

namespace {

/// The shorter of two times, in seconds of the processor: others may keep it busy.
template <class Work>
double seconds_of(const Work& work) {
    double least = std::numeric_limits<double>::infinity();
    for (int turn = 0; turn < 2; ++turn) {
        const std::clock_t begin = std::clock();
        work();
        least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    }
    return least;
}

constexpr double at_most = 24;

/// How much longer work(8 n) takes than work(n): 8 where the time is linear, 64 where it is quadratic. The
/// least of three tries, if it takes so many.
template <class Work>
double growth_of(std::size_t n, const Work& work) {
    double least = std::numeric_limits<double>::infinity();
    for (int turn = 0; turn < 3 && !(least < at_most); ++turn) {
        const double few = seconds_of([&] { work(n); });
        least = std::min(least, seconds_of([&] { work(8 * n); }) / few);
    }
    return least;
}

/// Loads a file, bends what it holds a little, so that nothing of it stays, and saves it as a GLB.
void load_and_save(const std::string& name, const std::string& bytes) {
    const Folder folder;
    Mesh mesh = load(folder.write(name, bytes));
    for (glm::vec3& position : mesh.positions) position.y += 0.25f * position.x * position.x;
    save(mesh, folder / "out.glb");
}

std::string lines(std::size_t count, const std::string& before, const std::string& after) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += before + std::to_string(i) + after;
    return text;
}

}  // namespace

TEST_CASE("many: elements, properties and stray lines of a PLY header") {
    const auto ply = [](const std::string& stray, const std::string& elements,
                        const std::string& properties) {
        return "ply\nformat ascii 1.0\n" + stray + "element vertex 3\nproperty float x\nproperty float y\n" +
               "property float z\nelement face 1\nproperty list uchar int vertex_indices\n" + elements +
               "element last 0\n" + properties + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    };
    CHECK(growth_of(2000, [&](std::size_t n) {
              CHECK(load_text("a.ply", ply("", lines(n, "element e", " 0\n"), "")).faces.size() == 1);
          }) < at_most);
    CHECK(growth_of(2000, [&](std::size_t n) {
              CHECK(load_text("a.ply", ply("", "", lines(n, "property float x", "\n"))).faces.size() == 1);
          }) < at_most);
    CHECK(growth_of(2000, [&](std::size_t n) {
              CHECK(load_text("a.ply", ply(lines(n, "Blender", "\n"), "", "")).warnings.size() == 1);
          }) < at_most);
}

TEST_CASE("many: nodes that show one mesh, each bent in its own way") {
    CHECK(growth_of(200, [](std::size_t n) {
              Document document = tetra();
              document.json["nodes"] = Json::array();
              document.json["scenes"][0]["nodes"] = Json::array();
              for (std::size_t i = 0; i < n; ++i) {
                  document.json["nodes"].push_back(
                      {{"mesh", 0}, {"translation", {0.01 * static_cast<double>(i), 0, 0}}});
                  document.json["scenes"][0]["nodes"].push_back(i);
              }
              load_and_save("a.glb", document.glb());
          }) < at_most);
}

TEST_CASE("many: values below a long name in JSON") {
    CHECK(growth_of(1000, [](std::size_t n) {
              Document document = tetra();
              document.json[std::string(100 * n, 'x')] = std::vector<Json>(n, Json{{"name", "a"}});
              CHECK(load_document(document).warnings.empty());
          }) < at_most);
}

TEST_CASE("many: faces about one vertex, each with a normal of its own") {
    CHECK(growth_of(2000, [](std::size_t n) {
              std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + lines(n, "vn 1 0 ", "\n");
              for (std::size_t i = 1; i <= n; ++i) {
                  const std::string normal = "//" + std::to_string(i);
                  text += "f 1" + normal + " 2" + normal + " 3" + normal + "\n";
              }
              load_and_save("a.obj", text);
          }) < at_most);
}

TEST_CASE("many: material files, the same and others") {
    const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    CHECK(growth_of(4000, [&](std::size_t n) {
              std::string text = mesh;
              for (std::size_t i = 0; i < n; ++i) text += "mtllib a.mtl\n";
              CHECK(load_text("a.obj", text).warnings.size() == 1);
          }) < at_most);
    // Not more than a thousand are looked for.
    const std::vector<std::string> warnings =
        load_text("a.obj", mesh + lines(20000, "mtllib ", ".mtl\n")).warnings;
    CHECK(warnings.size() == 1001);
    CHECK(warnings.back().find("more than 1000 material files") != std::string::npos);
    // Nor where one line names them, whether they may be read or not.
    std::string line = "mtllib";
    for (int i = 0; i < 20000; ++i) line += " ../" + std::to_string(i) + ".mtl";
    CHECK(load_text("a.obj", line + "\n" + mesh).warnings.size() == 1001);
}
