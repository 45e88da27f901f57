// SPDX-License-Identifier: MIT
#include "bars.hpp"
#include "follow.hpp"
#include "support/sanitized.hpp"

#include <fstream>

using namespace goffer;
using namespace goffer::test;

namespace {

/// The most memory that the process has had since the last call, in bytes; 0 where that cannot be told.
std::uint64_t peak() {
    std::ifstream status("/proc/self/status");
    std::uint64_t kilobytes = 0;
    for (std::string word; status >> word;)
        if (word == "VmHWM:") status >> kilobytes;
    std::ofstream("/proc/self/clear_refs") << "5";
    return 1024 * kilobytes;
}

}  // namespace

TEST_CASE("clip: within little memory frames are read more often, and what is found is the same") {
    const mesh::Mesh mesh = bar(201);
    MadeFrames much(mesh, 120, bending), little(mesh, 120, bending);
    const Folder folder;
    const clip::GltfReport wide = saved_clip(mesh, much, folder / "wide.glb"),
                           narrow = saved_clip(mesh, little, folder / "narrow.glb", {.memory = 1u << 20});
    CHECK(little.reads > 2 * much.reads);
    CHECK(narrow.targets == wide.targets);
    CHECK(narrow.max_error == doctest::Approx(wide.max_error).epsilon(0.05));
    check_follows(folder / "narrow.glb", mesh, little, narrow);
}

TEST_CASE("clip: targets that do not fit into memory are fewer, and the report says so") {
    const mesh::Mesh mesh = bar(201);
    MadeFrames frames(mesh, 120, [](std::size_t f, const glm::vec3& p, bool n, const glm::vec3& v) {
        return n ? v : v + glm::vec3(0, std::sin(p.z * static_cast<float>(f + 1)), 0);
    });
    const Folder folder;
    const clip::GltfReport report = saved_clip(mesh, frames, folder / "a.glb", {.memory = 1u << 20});
    CHECK_FALSE(report.within());
    CHECK(report.targets * mesh::vertex_arrays(mesh).positions.size() * 24 <= (1u << 19));
    check_follows(folder / "a.glb", mesh, frames, report);
}

TEST_CASE("clip: more frames than are sampled are all measured") {
    const mesh::Mesh mesh = bar();
    const auto move = [](std::size_t f, const glm::vec3& p, bool n, const glm::vec3& v) {
        return n ? v : bending(f, p, n, v) + (f == 2500 ? glm::vec3(0, 1, 0) : glm::vec3(0));
    };
    MadeFrames frames(mesh, 3000, move);
    const Folder folder;
    const clip::GltfReport report = saved_clip(mesh, frames, folder / "a.glb");
    check_follows(folder / "a.glb", mesh, frames, report);
}

TEST_CASE("clip: the bound of memory is kept") {
    if (sanitized || peak() == 0) {
        MESSAGE("skipped: what the process takes cannot be told here");
        return;
    }
    constexpr std::uint64_t bound = 32u << 20;
    const mesh::Mesh mesh = bar(2501);
    const Folder folder;
    MadeFrames few(mesh, 2, bending), many(mesh, 400, bending);  // which are 192 MB as floats
    (void)peak();
    const clip::GltfReport small = saved_clip(mesh, few, folder / "few.glb", {.memory = bound});
    const std::uint64_t before = peak();
    const clip::GltfReport large = saved_clip(mesh, many, folder / "many.glb", {.memory = bound});
    const std::uint64_t after = peak();
    CHECK(large.targets > small.targets);
    MESSAGE(before, " bytes for 2 frames, ", after, " for 400, in files of ", small.bytes, " and ",
            large.bytes);
    CHECK(after <= before + bound + 5 * (large.bytes - small.bytes));
}
