// SPDX-License-Identifier: MIT
#include "files.hpp"
#include "same.hpp"

#include <goffer/mesh/refined.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

/// How far load() and refined() say that they are.

using namespace goffer;
using namespace goffer::test;

namespace {

/// A sheet of 2 * side^2 triangles.
mesh::Mesh sheet(std::uint32_t side) {
    mesh::Mesh mesh;
    const std::uint32_t across = side + 1;
    for (std::uint32_t y = 0; y <= side; ++y)
        for (std::uint32_t x = 0; x <= side; ++x)
            mesh.positions.emplace_back(x, y, std::sin(0.1f * static_cast<float>(x)));
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint32_t a = y * across + x, b = a + 1, c = b + across, d = a + across;
            mesh.corners.insert(mesh.corners.end(), {a, b, c, a, c, d});
            mesh.faces.insert(mesh.faces.end(), {3, 3});
        }
    }
    return mesh;
}

std::string ply_text(const mesh::Mesh& mesh) {
    std::ostringstream out;
    out << "ply\nformat ascii 1.0\nelement vertex " << mesh.positions.size()
        << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.faces.size()
        << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const glm::vec3& p : mesh.positions) out << p.x << ' ' << p.y << ' ' << p.z << '\n';
    for (std::size_t c = 0; c < mesh.corners.size(); c += 3)
        out << "3 " << mesh.corners[c] << ' ' << mesh.corners[c + 1] << ' ' << mesh.corners[c + 2] << '\n';
    return out.str();
}

std::string stl_text(const mesh::Mesh& mesh) {
    std::ostringstream out;
    out << "solid sheet\n";
    for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
        if (c % 3 == 0) out << "facet normal 0 0 1\nouter loop\n";
        const glm::vec3& p = mesh.positions[mesh.corners[c]];
        out << "vertex " << p.x << ' ' << p.y << ' ' << p.z << '\n';
        if (c % 3 == 2) out << "endloop\nendfacet\n";
    }
    out << "endsolid sheet\n";
    return out.str();
}

/// The shares of one work, in the order in which they were said.
struct Said {
    std::vector<double> shares;
    [[nodiscard]] std::function<void(double)> listener() {
        return [this](double share) { shares.push_back(share); };
    }
};

/// They ascend from less than a half to exactly 1, in `least` steps or more and not too many.
void check_shares(const std::vector<double>& shares, std::size_t least) {
    REQUIRE(shares.size() >= least);
    CHECK(shares.size() <= 300);
    CHECK(shares.front() >= 0);
    CHECK(shares.front() < 0.5);
    CHECK(shares.back() == 1);
    CHECK(std::ranges::adjacent_find(shares, std::greater_equal<>()) == shares.end());
}

void check_same_read(const mesh::Mesh& a, const mesh::Mesh& b) {
    check_same(a, b);
    CHECK(a.warnings == b.warnings);
}

/// `mesh` with a new vertex in the middle of each triangle's first edge that is a row's.
struct Cuts {
    std::vector<mesh::EdgeVertex> vertices;
    std::vector<std::uint32_t> triangles, parents;

    explicit Cuts(const mesh::Mesh& mesh) {
        const std::vector<std::uint32_t> whole = mesh::triangles(mesh);
        for (std::uint32_t t = 0; t < whole.size() / 3; ++t) {
            const std::uint32_t a = whole[3 * t], b = whole[3 * t + 1], c = whole[3 * t + 2];
            const auto middle = static_cast<std::uint32_t>(mesh.positions.size() + vertices.size());
            vertices.push_back({a, b, 0.5});
            triangles.insert(triangles.end(), {a, middle, c, middle, b, c});
            parents.insert(parents.end(), {t, t});
        }
    }
    [[nodiscard]] mesh::Subdivision pieces() const { return {vertices, triangles, parents}; }
};

}  // namespace

TEST_CASE("progress: shares of a file that is read ascend to 1, whatever its format") {
    const Folder folder;
    const mesh::Mesh mesh = sheet(220);
    folder.write("text.ply", ply_text(mesh));
    folder.write("text.stl", stl_text(mesh));
    for (const char* name : {"binary.ply", "binary.stl", "sheet.obj", "sheet.glb", "sheet.gltf"})
        mesh::save(mesh, folder / name);
    for (const char* name :
         {"text.ply", "text.stl", "binary.ply", "binary.stl", "sheet.obj", "sheet.glb", "sheet.gltf"}) {
        CAPTURE(std::string(name));
        Said said;
        mesh::LoadOptions options;
        options.progress = said.listener();
        const mesh::Mesh loaded = mesh::load(folder / name, options);
        check_shares(said.shares, 60);
        check_same_read(loaded, mesh::load(folder / name));
    }
}

TEST_CASE("progress: a tiny file ends at 1, too, and a broken one does not") {
    const Folder folder;
    const mesh::Mesh mesh = sheet(1);
    for (const char* name : {"sheet.ply", "sheet.stl", "sheet.obj", "sheet.glb", "sheet.gltf"}) {
        CAPTURE(std::string(name));
        mesh::save(mesh, folder / name);
        Said said;
        mesh::LoadOptions options;
        options.progress = said.listener();
        (void)mesh::load(folder / name, options);
        check_shares(said.shares, 1);
        const std::string bytes = bytes_of(folder / name);
        folder.write("broken", bytes.substr(0, bytes.size() / 2));
        said.shares.clear();
        CHECK(error_of([&] { (void)mesh::load(folder / "broken", options); }) != "");
        CHECK(std::ranges::count(said.shares, 1.0) == 0);
    }
}

TEST_CASE("progress: shares of a refinement ascend to 1, and nobody is told of it later") {
    const Folder folder;
    for (const char* name : {"sheet.ply", "sheet.stl", "sheet.obj", "sheet.glb"}) {
        CAPTURE(std::string(name));
        mesh::save(sheet(150), folder / name);
        Said reading, refining;
        mesh::LoadOptions options;
        options.progress = reading.listener();
        const mesh::Mesh loaded = mesh::load(folder / name, options);
        const std::size_t before = reading.shares.size();
        const Cuts cuts(loaded);
        const mesh::Mesh refined = mesh::refined(loaded, cuts.pieces(), {}, refining.listener());
        CHECK(reading.shares.size() == before);
        check_shares(refining.shares, 40);
        check_same_read(refined, mesh::refined(loaded, cuts.pieces()));
    }
}
