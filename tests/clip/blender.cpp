// SPDX-License-Identifier: MIT
#include "moving.hpp"
#include "support/files.hpp"
#include "support/models.hpp"

#include <goffer/clip/point_cache.hpp>
#include <goffer/io/atomic_file.hpp>
#include <goffer/io/bytes.hpp>

#include <doctest/doctest.h>
#include <sys/wait.h>

#include <bit>
#include <cstdlib>
#include <string>

/// Point caches on the meshes that Blender makes of the models' files.

using namespace goffer;
using namespace goffer::test;

namespace {

constexpr std::size_t frames_of_clip = 11;

/// Writes the clip of a model, and where its vertices are in three frames; Blender is to land there, with the
/// model imported from its own file or, with `by_ply`, from a PLY of it.
void check_cache_in_blender(const std::filesystem::path& file, clip::CacheAxes axes, bool by_ply = false) {
    if (std::system("blender --version > /dev/null 2>&1") != 0) {
        MESSAGE("skipped: Blender is not installed: bash .ci/setup hosts installs it");
        return;
    }
    const Folder folder;
    BendingModel clip(file, frames_of_clip);
    if (by_ply) mesh::save(clip.model, folder / "still.ply");
    const std::filesystem::path imported = by_ply ? folder / "still.ply" : file;
    const std::size_t vertices = clip.model.positions.size();
    io::AtomicFiles files;
    clip::save_mdd(clip, vertices, folder / "clip.mdd", files, axes);
    clip::save_pc2(clip, vertices, folder / "clip.pc2", files, axes);
    files.commit();
    std::string bytes;
    for (const std::size_t frame : {std::size_t{0}, std::size_t{4}, frames_of_clip - 1}) {
        const std::vector<glm::dvec3> positions = carried(clip, frame);
        for (std::size_t i = 0; i < vertices; ++i)
            io::append_bytes(bytes, std::endian::little, positions[i].x, positions[i].y, positions[i].z);
    }
    folder.write("expected", bytes);
    const std::string command =
        "blender -b --factory-startup --python-exit-code 1 --python '" GOFFER_SOURCE_DIR
        "/tests/clip/blender_mdd.py' -- '" +
        imported.string() + "' '" + (folder / "").string() + "' 0 4 " + std::to_string(frames_of_clip - 1);
    CHECK(WEXITSTATUS(std::system(command.c_str())) == 0);
}

}  // namespace

TEST_CASE("blender: point caches of an OBJ land on its vertices") {
    check_cache_in_blender(model("blub_open.obj"), clip::CacheAxes::as_model);
}

TEST_CASE("blender: point caches of a PLY land on its vertices") {
    check_cache_in_blender(model("fuze.ply"), clip::CacheAxes::as_model);
}

TEST_CASE("blender: point caches of a GLB land on its vertices, with z up") {
    check_cache_in_blender(model("log_01.glb"), clip::CacheAxes::z_up);
}

TEST_CASE("blender: point caches of a GLB of several objects land on the vertices of a PLY of it") {
    check_cache_in_blender(model("insect_leg.glb"), clip::CacheAxes::as_model, true);
}
