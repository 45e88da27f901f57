// SPDX-License-Identifier: MIT
#include "rest.hpp"
#include "triangle.hpp"

#include <goffer/fit/patches.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

namespace goffer::fit {
namespace {

using Corners = std::span<const std::uint32_t>;

/// The part that `share` (0..1, or a little beyond) falls into, of `count` equal ones.
std::uint32_t part(double share, int count) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(share * count), 0.0, count - 1.0));
}

void check_positions(const Geometry& geometry, std::span<const glm::vec3> positions) {
    if (positions.size() == geometry.positions.size()) return;
    throw Error("positions: " + std::to_string(positions.size()) + " for " +
                std::to_string(geometry.positions.size()) + " vertices; give one for each");
}

/// An area at rest and what became of it.
struct Areas {
    double before = 0, after = 0;

    [[nodiscard]] double change() const { return before > 0 ? after / before - 1 : 0; }
};

}  // namespace

std::vector<std::uint32_t> patches_of(const Geometry& geometry, const Cylinder& cylinder,
                                      const PatchGrid& grid) {
    check(geometry);
    check(cylinder);
    constexpr int most = 1 << 16;
    if (grid.slices < 1 || grid.slices > most || grid.sides < 1 || grid.sides > most)
        throw Error("patches: " + std::to_string(grid.slices) + " slices of " + std::to_string(grid.sides) +
                    " sides; give numbers within 1.." + std::to_string(most));
    constexpr std::int64_t most_patches = std::int64_t{1} << 20;
    if (std::int64_t{grid.slices} * grid.sides > most_patches)
        throw Error("patches: " + std::to_string(grid.slices) + " slices of " + std::to_string(grid.sides) +
                    " sides are more than " + std::to_string(most_patches) + " patches; give fewer");
    const Straightening straightening(cylinder);
    std::vector<std::uint32_t> patches;
    for (std::size_t t = 0; t < geometry.triangles.size(); t += 3) {
        const paper::Cylindrical at =
            straightening.vertex(Triangle(geometry.positions, geometry.triangles.subspan(t, 3)).centroid());
        const double turn = at.beta / (2 * std::numbers::pi) + 0.5 / grid.sides;
        patches.push_back(part(at.z / cylinder.length, grid.slices) * static_cast<std::uint32_t>(grid.sides) +
                          part(turn - std::floor(turn), grid.sides));
    }
    return patches;
}

PatchChange patch_change(const Geometry& geometry, std::span<const glm::vec3> positions,
                         std::span<const std::uint32_t> patches) {
    check_positions(geometry, positions);
    if (3 * patches.size() != geometry.triangles.size())
        throw Error("patches: " + std::to_string(patches.size()) + " for " +
                    std::to_string(geometry.triangles.size() / 3) + " triangles; give one for each");
    std::vector<Areas> all(patches.empty() ? 0 : *std::ranges::max_element(patches) + std::size_t{1});
    for (std::size_t t = 0; t < patches.size(); ++t) {
        const Corners corners = geometry.triangles.subspan(3 * t, 3);
        all[patches[t]].before += Triangle(geometry.positions, corners).area();
        all[patches[t]].after += Triangle(positions, corners).area();
    }
    PatchChange result;
    double whole = 0, squares = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!(all[i].before > 0)) continue;
        const double change = all[i].change();
        ++result.patches;
        whole += all[i].before;
        squares += all[i].before * change * change;
        if (std::fabs(change) <= std::fabs(result.worst)) continue;
        result.worst = change;
        result.worst_patch = static_cast<std::uint32_t>(i);
    }
    if (whole > 0) result.rms = std::sqrt(squares / whole);
    return result;
}

std::vector<double> vertex_change(const Geometry& geometry, std::span<const glm::vec3> positions) {
    check_positions(geometry, positions);
    std::vector<Areas> all(positions.size());
    for (std::size_t t = 0; t < geometry.triangles.size(); t += 3) {
        const Corners corners = geometry.triangles.subspan(t, 3);
        const double before = Triangle(geometry.positions, corners).area();
        const double after = Triangle(positions, corners).area();
        for (const std::uint32_t corner : corners) {
            all[corner].before += before;
            all[corner].after += after;
        }
    }
    std::vector<double> changes;
    changes.reserve(all.size());
    for (const Areas& areas : all) changes.push_back(areas.change());
    return changes;
}

}  // namespace goffer::fit
