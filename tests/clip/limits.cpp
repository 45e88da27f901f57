// SPDX-License-Identifier: MIT
#include "bars.hpp"
#include "follow.hpp"
#include "mesh/files.hpp"

using namespace goffer;
using namespace goffer::test;
using clip::GltfLimit;

namespace {

clip::GltfReport report_of_saved(const mesh::Mesh& mesh, clip::Frames& frames,
                                 const clip::GltfOptions& options) {
    const Folder folder;
    return saved_clip(mesh, frames, folder / "clip.glb", options);
}

/// One large shape, and in each frame a small one of its own.
glm::vec3 one_shape_and_more(std::size_t frame, const glm::vec3& position, bool is_normal,
                             const glm::vec3& value) {
    if (is_normal) return value;
    const auto t = static_cast<float>(frame + 1);
    return value + glm::vec3(0.08f * std::sin(t * position.z), 0.3f * std::sin(t) * position.z, 0);
}

/// No two frames are alike.
glm::vec3 unlike(std::size_t frame, const glm::vec3& position, bool is_normal, const glm::vec3& value) {
    return is_normal ? value : value + glm::vec3(0, std::sin(position.z * static_cast<float>(frame + 1)), 0);
}

}  // namespace

TEST_CASE("clip: no more targets are taken of a short clip than its error asks for") {
    const mesh::Mesh mesh = bar(31);
    MadeFrames frames(mesh, 7, one_shape_and_more);
    std::size_t before = 7;
    for (const double max_error : {1e-6, 1e-3, 6e-3, 1e-2, 2e-2, 0.5}) {
        CAPTURE(max_error);
        const clip::GltfReport report = report_of_saved(mesh, frames, {.max_error = max_error});
        CHECK(report.within());
        CHECK(report.exact == (report.targets == 7));
        CHECK(report.targets <= before);
        before = report.targets;
        if (report.targets < 2) continue;
        const clip::GltfReport fewer =
            report_of_saved(mesh, frames, {.max_error = max_error, .targets = report.targets - 1});
        CHECK(fewer.max_error > 0.97 * max_error * report.size);
        CHECK(fewer.limit == (fewer.within() ? GltfLimit::none : GltfLimit::targets));
    }
    CHECK(before == 1);
    CHECK(report_of_saved(mesh, frames, {.max_error = 2e-2}).targets == 2);
}

TEST_CASE("clip: the report says what keeps frames from being as near as they were to be") {
    const mesh::Mesh mesh = bar(201);
    MadeFrames frames(mesh, 120, unlike), short_clip(mesh, 20, unlike);
    CHECK(report_of_saved(mesh, frames, {.max_error = 1e-4}).limit == GltfLimit::none);
    CHECK(report_of_saved(mesh, frames, {.max_error = 1e-4, .targets = 9}).limit == GltfLimit::targets);
    CHECK(report_of_saved(mesh, frames, {.max_error = 1e-4, .memory = 1u << 20}).limit == GltfLimit::memory);
    CHECK(report_of_saved(mesh, frames, {.max_error = 1e-4, .targets = 9, .memory = 1u << 20}).limit ==
          GltfLimit::targets);
    CHECK(report_of_saved(mesh, short_clip, {.max_error = 0, .targets = 19}).limit == GltfLimit::targets);
}

TEST_CASE("clip: frames that are not sampled are what memory, or the number of samples, leaves out") {
    const mesh::Mesh mesh = bar();
    MadeFrames frames(mesh, 3000, [](std::size_t f, const glm::vec3& p, bool n, const glm::vec3& v) {
        return n ? v : bending(f, p, n, v) + (f == 2501 ? glm::vec3(0, std::sin(5 * p.z), 0) : glm::vec3(0));
    });
    CHECK(report_of_saved(mesh, frames, {}).limit == GltfLimit::samples);
    CHECK(report_of_saved(mesh, frames, {.memory = 1u << 22}).limit == GltfLimit::memory);
}

TEST_CASE("clip: components that rounding hides are made up for by the frames, where there may be so many") {
    // Far from the origin one vertex moves by more than rounding, but the mesh by less than all of it.
    const mesh::Mesh mesh = bar(2001);
    const auto move = [](std::size_t f, const glm::vec3& p, bool n, const glm::vec3& v) {
        return n || p.z < 9.999f || p.x < 0 || p.y < 0
                   ? v
                   : v + glm::vec3(0, 0, 1e-4f * static_cast<float>(f % 3));
    };
    MadeFrames frames(mesh, 6, move);
    const clip::GltfReport all = report_of_saved(mesh, frames, {.max_error = 0}),
                           few = report_of_saved(mesh, frames, {.max_error = 0, .targets = 5});
    CHECK(all.within());
    CHECK(all.exact);
    CHECK(few.limit == GltfLimit::rounding);
}

TEST_CASE("clip: a mesh without vertices is refused") {
    const mesh::Mesh none;
    MadeFrames frames(none, 3, unlike);
    CHECK(error_of([&] { (void)report_of_saved(none, frames, {}); }).find("the mesh has no vertices") !=
          std::string::npos);
}
