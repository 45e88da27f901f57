// SPDX-License-Identifier: MIT
#include "places.hpp"

#include <goffer/fit/normals.hpp>
#include <goffer/fit/refine.hpp>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>

namespace goffer::fit {
namespace {

/// One triangle: its normal, of unit length or 0, and its angle at each corner.
struct Facet {
    glm::dvec3 normal{0};
    std::array<double, 3> angles{};

    Facet(std::span<const glm::vec3> positions, const std::uint32_t* corners) {
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 at = positions[corners[i]];
            const glm::dvec3 u = glm::dvec3(positions[corners[(i + 1) % 3]]) - at;
            const glm::dvec3 v = glm::dvec3(positions[corners[(i + 2) % 3]]) - at;
            const glm::dvec3 cross = glm::cross(u, v);
            const double twice_area = glm::length(cross);
            if (twice_area == 0) continue;
            normal = cross / twice_area;
            angles[i] = std::atan2(twice_area, glm::dot(u, v));
        }
    }
};

std::vector<Facet> facets_of(std::span<const glm::vec3> positions, std::span<const std::uint32_t> triangles) {
    std::vector<Facet> facets;
    facets.reserve(triangles.size() / 3);
    for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) facets.emplace_back(positions, &triangles[t]);
    return facets;
}

/// Makes unit normals of the sum of all around each vertex. `places`: see places().
std::vector<glm::vec3> unit_normals(const std::vector<glm::dvec3>& own,
                                    const std::vector<std::uint32_t>& places) {
    std::vector<glm::dvec3> shared(own.size(), glm::dvec3(0));
    for (std::size_t i = 0; i < own.size(); ++i) shared[places[i]] += own[i];

    // Where the sides of a sheet meet, back to back, they cancel: then each keeps its own.
    constexpr double canceled = 1e-6;
    std::vector<glm::vec3> normals;
    normals.reserve(own.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
        const glm::dvec3& sum = glm::length(shared[places[i]]) > canceled ? shared[places[i]] : own[i];
        const double length = glm::length(sum);
        normals.emplace_back(length > canceled ? sum / length : glm::dvec3(0, 0, 1));
    }
    return normals;
}

/// The normal at each corner of each triangle, of any length: of those at its place that are within a crease
/// of the triangle.
std::vector<glm::dvec3> corner_normals(std::span<const std::uint32_t> triangles,
                                       const std::vector<Facet>& facets,
                                       const std::vector<std::uint32_t>& places) {
    constexpr double crease = 0.42262;  // cosine of 65 degrees
    constexpr std::size_t most = 1000;  // triangles at a place that are compared with each other
    std::vector<std::vector<std::uint32_t>> corners(places.size());
    for (std::uint32_t c = 0; c < 3 * facets.size(); ++c) corners[places[triangles[c]]].push_back(c);
    std::vector<glm::dvec3> normals(triangles.size(), glm::dvec3(0));
    for (const std::vector<std::uint32_t>& here : corners) {
        for (const std::uint32_t c : here) {
            if (here.size() > most) {
                normals[c] = facets[c / 3].normal;
                continue;
            }
            for (const std::uint32_t other : here) {
                const Facet& facet = facets[other / 3];
                if (glm::dot(facets[c / 3].normal, facet.normal) > crease)
                    normals[c] += facet.angles[other % 3] * facet.normal;
            }
        }
    }
    return normals;
}

/// A triangle with a normal at each corner.
class Shading {
public:
    Shading(std::span<const glm::vec3> positions, const std::uint32_t* corners, const Facet& facet,
            const glm::dvec3* normals)
        : normals_(normals) {
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 from = positions[corners[(i + 1) % 3]], to = positions[corners[(i + 2) % 3]];
            inward_[i] = glm::cross(facet.normal, to - from);
            from_[i] = from;
        }
    }

    /// The normal at a place in the triangle, of unit length or 0.
    [[nodiscard]] glm::dvec3 at(const glm::dvec3& place) const {
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < 3; ++i) {
            const double length = glm::length(normals_[i]);  // below, the area beyond corner i
            if (length > 0) sum += glm::dot(inward_[i], place - from_[i]) / length * normals_[i];
        }
        const double length = glm::length(sum);
        return length > 0 ? sum / length : sum;
    }

private:
    const glm::dvec3* normals_;
    std::array<glm::dvec3, 3> inward_, from_;
};

}  // namespace

std::vector<glm::vec3> make_normals(std::span<const glm::vec3> positions,
                                    std::span<const std::uint32_t> triangles) {
    const std::vector<Facet> facets = facets_of(positions, triangles);
    std::vector<glm::dvec3> sums(positions.size(), glm::dvec3(0));
    for (std::size_t c = 0; c < 3 * facets.size(); ++c)
        sums[triangles[c]] += facets[c / 3].angles[c % 3] * facets[c / 3].normal;
    return unit_normals(sums, places(positions));
}

std::vector<glm::vec3> make_refined_normals(std::span<const glm::vec3> positions,
                                            std::span<const std::uint32_t> triangles,
                                            const Refinement& refinement) {
    const std::vector<Facet> facets = facets_of(positions, triangles);
    const std::vector<glm::dvec3> corners = corner_normals(triangles, facets, places(positions));
    const std::vector<glm::vec3> refined = refined_positions(positions, refinement);
    std::vector<glm::dvec3> sums(refined.size(), glm::dvec3(0));
    for (std::size_t piece = 0; piece < refinement.parents.size(); ++piece) {
        const std::size_t parent = refinement.parents[piece];
        const Shading shading(positions, &triangles[3 * parent], facets[parent], &corners[3 * parent]);
        const std::uint32_t* const vertices = &refinement.triangles[3 * piece];
        const Facet facet(refined, vertices);
        for (std::size_t i = 0; i < 3; ++i)
            sums[vertices[i]] += facet.angles[i] * shading.at(glm::dvec3(refined[vertices[i]]));
    }
    return unit_normals(sums, places(refined));
}

}  // namespace goffer::fit
