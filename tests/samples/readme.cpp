// SPDX-License-Identifier: MIT
#include "support/files.hpp"
#include "support/worst.hpp"

#include <goffer/mesh/mesh.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <cstdlib>
#include <filesystem>
#include <string>

/// The samples do what the README says, and the README shows the program that is compiled.

namespace goffer::test {
namespace {

namespace fs = std::filesystem;

int run(const std::string& program, const fs::path& first, const fs::path& second) {
    return std::system(
        ("'" + program + "' '" + first.string() + "' '" + second.string() + "' >/dev/null 2>&1").c_str());
}

}  // namespace

TEST_CASE("the README's program is samples/hello.cpp") {
    const fs::path root = GOFFER_SOURCE_DIR;
    const std::string readme = bytes_of(root / "README.md");
    const std::size_t begin = readme.find("```cpp\n") + 7;
    const std::string shown = readme.substr(begin, readme.find("```", begin) - begin);
    const std::string program = bytes_of(root / "samples" / "hello.cpp");
    CHECK(program.substr(program.find('\n') + 1) == shown);
}

TEST_CASE("the README's program bends the bundled model") {
    const Folder folder;
    const fs::path model = folder / "worm.glb";
    const fs::path bent = folder / "bent.glb";
    REQUIRE(std::system(("'" GOFFER_CATERPILLAR "' '" + model.string() + "' >/dev/null").c_str()) == 0);
    REQUIRE(std::system(("cd '" + (folder / ".").string() + "' && '" GOFFER_HELLO "'").c_str()) == 0);
    const mesh::Mesh before = mesh::load(model);
    const mesh::Mesh after = mesh::load(bent);
    REQUIRE(after.positions.size() == before.positions.size());
    CHECK(after.corners == before.corners);
    CHECK(after.materials.size() == before.materials.size());
    float farthest = 0;
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        test::take_worst(farthest, glm::length(after.positions[i] - before.positions[i]));
        REQUIRE(glm::length(after.normals.values[i]) == doctest::Approx(1));
    }
    CHECK(farthest > 0.3f);  // the model is 1 long and its tip turns by 86 degrees
}

TEST_CASE("the crowd sample leaves its picture and its model") {
    const Folder folder;
    const fs::path model = folder / "caterpillar.glb";
    REQUIRE(std::system(("'" GOFFER_CATERPILLAR "' '" + model.string() + "' >/dev/null").c_str()) == 0);
    REQUIRE(run(GOFFER_CROWD, model, folder / ".") == 0);
    CHECK(mesh::load(folder / "crowd.glb").positions.size() == 24 * mesh::load(model).positions.size());
    CHECK(fs::file_size(folder / "crowd.png") > 100000);
    CHECK(run(GOFFER_CROWD, folder / "none.glb", folder / ".") != 0);
}

}  // namespace goffer::test
