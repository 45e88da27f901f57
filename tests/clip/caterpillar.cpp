// SPDX-License-Identifier: MIT
#include "clips.hpp"
#include "support/files.hpp"

#include <goffer/clip/gltf.hpp>
#include <goffer/io/atomic_file.hpp>

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstdio>

using namespace goffer;
using namespace goffer::test;

TEST_CASE("measure") {
    const Folder folder;
    const std::string command = "\"" GOFFER_CATERPILLAR "\" \"" + (folder / "c.glb").string() + "\"";
    REQUIRE(std::system(command.c_str()) == 0);
    const mesh::Mesh mesh = mesh::load(folder / "c.glb");
    for (const std::size_t regions : {1u, 3u, 6u, 12u}) {
        WalkingFrames frames(mesh, 300, regions);
        for (const std::size_t targets : {0u, 8u, 16u, 32u}) {
            clip::GltfOptions options;
            if (targets) options.targets = targets;
            io::AtomicFiles files;
            const auto r = clip::save_gltf(mesh, frames, options, folder / "a.glb", files);
            std::printf("regions %zu: targets %zu bytes %.3f MB size %.3f max %.2e rms %.2e angle %.2f rms %.2f within %d base %zu\n", regions, r.targets,
                        double(r.bytes) / 1e6, r.size, r.max_error/r.size, r.rms_error/r.size, r.max_angle*57.3, r.rms_angle*57.3, r.within, std::filesystem::file_size(folder / "c.glb"));
            std::fflush(stdout);
        }
    }
}
