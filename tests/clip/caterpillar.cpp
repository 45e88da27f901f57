// SPDX-License-Identifier: MIT
#include "blender.hpp"
#include "follow.hpp"
#include "mesh/gltf_valid.hpp"

#include <cstdlib>

using namespace goffer;
using namespace goffer::test;

namespace {

constexpr double megabyte = 1e6;

mesh::Mesh caterpillar(const Folder& folder, const char* name) {
    const std::string command = "\"" GOFFER_CATERPILLAR "\" \"" + (folder / name).string() + "\"";
    REQUIRE(std::system(command.c_str()) == 0);
    return mesh::load(folder / name);
}

}  // namespace

TEST_CASE("clip: 300 frames of the caterpillar on its way take less than 5 MB, here and in Blender") {
    const Folder folder;
    const mesh::Mesh mesh = caterpillar(folder, "c.glb");
    WalkingFrames frames(mesh, 300, 6);
    const clip::GltfReport report = saved_clip(mesh, frames, folder / "clip.glb");
    MESSAGE(report.targets, " targets, ", report.bytes, " bytes, off by ", report.max_error / report.size,
            " of the length, on average by ", report.rms_error / report.size, ", normals by ",
            report.max_angle, " and ", report.rms_angle);
    CHECK(static_cast<double>(report.bytes) < 5 * megabyte);
    CHECK(report.within());
    CHECK(report.max_error <= clip::GltfOptions{}.max_error * report.size);
    CHECK(report.rms_error <= 8e-4 * report.size);
    check_valid({folder / "clip.glb"}, true);
    const Player player(bytes_of(folder / "clip.glb"));
    for (const std::size_t f : {0u, 17u, 150u, 299u}) {
        const Off off = off_at(player, mesh, frames, f);
        CHECK(off.distance <= report.max_error + 1e-6 * report.size);
        CHECK(off.angle <= report.max_angle + 1e-5);
    }
    check_in_blender(folder / "clip.glb", mesh, frames, report, {0, 150, 299});
}

TEST_CASE("clip: Blender shows an OBJ's vertices where goffer has them") {
    const Folder folder;
    const mesh::Mesh mesh = caterpillar(folder, "c.obj");
    WalkingFrames frames(mesh, 60, 2);
    const clip::GltfReport report = saved_clip(mesh, frames, folder / "clip.gltf", {.max_error = 1e-3});
    (void)saved_clip(mesh, frames, folder / "clip.glb", {.max_error = 1e-3});
    check_in_blender(folder / "clip.glb", mesh, frames, report, {3, 30, 59});
}
