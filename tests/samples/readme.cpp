// SPDX-License-Identifier: MIT
#include <goffer/mesh/mesh.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

/// The samples do what the README says, and the README shows the program that is compiled.

namespace goffer::test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    REQUIRE(stream);
    return (std::ostringstream() << stream.rdbuf()).str();
}

/// A folder of this test's own, gone with it.
struct Folder {
    fs::path path;

    explicit Folder(const std::string& name)
        : path(fs::temp_directory_path() / ("goffer samples " + name + std::to_string(std::rand()))) {
        fs::create_directories(path);
    }
    ~Folder() { fs::remove_all(path); }
};

int run(const std::string& program, const fs::path& first, const fs::path& second) {
    return std::system(
        ("'" + program + "' '" + first.string() + "' '" + second.string() + "' >/dev/null 2>&1").c_str());
}

}  // namespace

TEST_CASE("the README's program is samples/hello.cpp") {
    const fs::path root = GOFFER_SOURCE_DIR;
    const std::string readme = text_of(root / "README.md");
    const std::size_t begin = readme.find("```cpp\n") + 7;
    const std::string shown = readme.substr(begin, readme.find("```", begin) - begin);
    const std::string program = text_of(root / "samples" / "hello.cpp");
    CHECK(program.substr(program.find('\n') + 1) == shown);
}

TEST_CASE("the README's program bends the bundled model") {
    const Folder folder("hello");
    const fs::path model = folder.path / "worm.glb";
    const fs::path bent = folder.path / "bent.glb";
    REQUIRE(std::system(("'" GOFFER_CATERPILLAR "' '" + model.string() + "' >/dev/null").c_str()) == 0);
    REQUIRE(std::system(("cd '" + folder.path.string() + "' && '" GOFFER_HELLO "'").c_str()) == 0);
    const mesh::Mesh before = mesh::load(model);
    const mesh::Mesh after = mesh::load(bent);
    REQUIRE(after.positions.size() == before.positions.size());
    CHECK(after.corners == before.corners);
    CHECK(after.materials.size() == before.materials.size());
    float farthest = 0;
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        farthest = std::max(farthest, glm::length(after.positions[i] - before.positions[i]));
        REQUIRE(glm::length(after.normals.values[i]) == doctest::Approx(1));
    }
    CHECK(farthest > 0.3f);  // the model is 1 long and its tip turns by 86 degrees
}

TEST_CASE("the crowd sample leaves its picture and its model") {
    const Folder folder("crowd");
    const fs::path model = folder.path / "caterpillar.glb";
    REQUIRE(std::system(("'" GOFFER_CATERPILLAR "' '" + model.string() + "' >/dev/null").c_str()) == 0);
    REQUIRE(run(GOFFER_CROWD, model, folder.path) == 0);
    CHECK(mesh::load(folder.path / "crowd.glb").positions.size() == 24 * mesh::load(model).positions.size());
    CHECK(fs::file_size(folder.path / "crowd.png") > 100000);
    CHECK(run(GOFFER_CROWD, folder.path / "none.glb", folder.path) != 0);
}

}  // namespace goffer::test
