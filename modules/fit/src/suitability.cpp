// SPDX-License-Identifier: MIT
#include "disjoint_sets.hpp"
#include "places.hpp"
#include "rest.hpp"
#include "surface.hpp"
#include "triangle.hpp"

#include <goffer/fit/refine.hpp>
#include <goffer/fit/suitability.hpp>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

namespace goffer::fit {
namespace {

glm::dvec2 across(const paper::Cylindrical& at) {
    return at.rho * glm::dvec2(std::cos(at.beta), std::sin(at.beta));
}

/// A shell in the straightened body: sums over its triangles, weighted by area.
struct Shell {
    double area = 0, low = std::numeric_limits<double>::infinity(), high = -low, square = 0;
    glm::dvec2 sum{0};

    void add(double own, const paper::Cylindrical& at) {
        area += own;
        low = std::min(low, at.z);
        high = std::max(high, at.z);
        square += own * at.rho * at.rho;
        sum += own * across(at);
    }

    [[nodiscard]] glm::dvec2 middle() const { return sum / area; }
    /// The root mean square distance from the shell's own middle, which is the radius of a tube.
    [[nodiscard]] double radius() const {
        return std::sqrt(std::max(square / area - glm::dot(middle(), middle()), 0.0));
    }
};

/// Whether the axis runs through a shell: the others are then parts of a body.
bool is_body(const Shell& shell) {
    return glm::length(shell.middle()) < shell.radius() / 2;
}

bool beside(const Shell& a, const Shell& b) {
    const double shared = std::min(a.high, b.high) - std::max(a.low, b.low);
    const double shorter = std::min(a.high - a.low, b.high - b.low);
    return shared > shorter / 2 && glm::distance(a.middle(), b.middle()) > a.radius() + b.radius();
}

/// The middles of a triangle's edges: a third of its area at each of them gives it its second moments.
std::array<glm::dvec3, 3> edge_middles(const Geometry& geometry, std::size_t triangle) {
    const auto p = Triangle(geometry.positions, geometry.triangles.subspan(3 * triangle, 3)).corner;
    return {(p[0] + p[1]) / 2.0, (p[1] + p[2]) / 2.0, (p[2] + p[0]) / 2.0};
}

std::vector<Shell> shells_of(const Geometry& geometry, const Straightening& straightening) {
    // Vertices of one triangle are joined, and so are those in one place.
    const std::vector<std::uint32_t> place = places(geometry.positions);
    DisjointSets sets(place.size());
    for (std::size_t t = 0; t < geometry.triangles.size(); t += 3) {
        sets.join(place[geometry.triangles[t]], place[geometry.triangles[t + 1]]);
        sets.join(place[geometry.triangles[t]], place[geometry.triangles[t + 2]]);
    }
    std::map<std::uint32_t, Shell> shells;
    double whole = 0;
    for (std::size_t t = 0; 3 * t < geometry.triangles.size(); ++t) {
        const std::array<glm::dvec3, 3> middle = edge_middles(geometry, t);
        // The triangle of the middles has a quarter of the area.
        const double area = 2 * glm::length(glm::cross(middle[1] - middle[0], middle[2] - middle[0]));
        Shell& shell = shells[sets.set_of(place[geometry.triangles[3 * t]])];
        for (const glm::dvec3& p : middle) shell.add(area / 3, straightening.vertex(p));
        whole += area;
    }
    constexpr double counts = 0.02;  // of the area, so that there are at most 50 to compare
    std::vector<Shell> result;
    for (const auto& [set, shell] : shells)
        if (shell.area >= counts * whole) result.push_back(shell);
    return result;
}

/// The spread of the sections, each about its own middle.
struct Spread {
    double larger_over_smaller, smaller_direction;
};

Spread spread_of(const Geometry& geometry, const Cylinder& cylinder, const Straightening& straightening) {
    constexpr std::size_t samples = 8192, slices = 24;
    std::vector<std::uint32_t> triangles;
    const Body body = sampled_surface(body_of(geometry), samples, triangles);
    struct Section {
        double count = 0;
        glm::dvec2 sum{0};
        glm::dmat2 squares{0};
    };
    std::array<Section, slices> sections;
    for (std::size_t i = 0; i < body.points.size(); i += 3) {
        const paper::Cylindrical at =
            straightening.vertex(from_eigen(body.middle + body.size * body.points[i]));
        const double share = at.z / cylinder.length;
        const double slice = share > 0 ? std::min(share * slices, slices - 1.0) : 0;  // for NaN, too
        Section& section = sections[static_cast<std::size_t>(slice)];
        const glm::dvec2 p = across(at) / cylinder.radius;
        section.count += 1;
        section.sum += p;
        section.squares += glm::outerProduct(p, p);
    }
    glm::dmat2 spread(0);
    for (const Section& section : sections) {
        if (section.count == 0) continue;
        spread += section.squares - glm::outerProduct(section.sum, section.sum) / section.count;
    }
    const double middle = (spread[0][0] + spread[1][1]) / 2;
    const double x = (spread[0][0] - spread[1][1]) / 2, y = spread[0][1], off = std::hypot(x, y);
    return {std::sqrt((middle + off) / std::max(middle - off, 1e-6 * middle)),
            (std::atan2(y, x) + std::numbers::pi) / 2};
}

FoldShortage shortage_of(const Binding& binding, std::size_t region, const BindOptions& options, bool asked,
                         int suitable) {
    using enum FoldShortage;
    const RegionBinding& found = binding.regions[region];
    if (binding.amplitude == Amplitude::none) return none;
    if (asked) {
        // Rows that were made for a number of folds may be counted as carrying a few less.
        const int few = found.folds < 8 ? 0 : std::max(found.folds / 10, 1);
        return found.folds > found.folds_capacity + few ? rows : none;
    }
    if (suitable == 0) return none;
    if (!options.wrinkle_range.whole()) return found.folds == 0 ? range : none;
    if (binding.profile.kind != Profile::Kind::even) return found.folds == 0 ? rows : none;
    if (found.folds == 0 && found.folds_capacity >= suitable) return length;
    return 2 * found.folds < suitable ? rows : none;
}

}  // namespace

Suitability suitability_of(const Geometry& geometry, const Cylinder& cylinder) {
    check(geometry);
    check(cylinder);
    const Straightening straightening(cylinder);
    const std::vector<Shell> shells = shells_of(geometry, straightening);
    Suitability found;
    found.shells = shells.size();
    double whole = 0, side_by_side = 0;
    for (const Shell& shell : shells) {
        whole += shell.area;
        const auto beside_it = [&](const Shell& other) { return beside(shell, other); };
        if (is_body(shell) || !std::ranges::any_of(shells, beside_it)) continue;
        side_by_side += shell.area;
        ++found.side_by_side;
    }
    if (whole > 0) found.side_by_side_share = side_by_side / whole;
    const Spread spread = spread_of(geometry, cylinder, straightening);
    found.flatness = spread.larger_over_smaller;
    found.thin_direction = spread.smaller_direction;
    return found;
}

std::vector<FoldShortage> fold_shortages(const Binding& binding, const BindOptions& options) {
    const std::vector<RegionOptions> asked = regions_of(with_regions_of(binding.cylinder, options));
    const std::vector<int> suitable = suitable_folds(binding.cylinder, options);
    std::vector<FoldShortage> shortages;
    for (std::size_t r = 0; r < binding.regions.size(); ++r)
        shortages.push_back(shortage_of(binding, r, options, asked[r].folds.has_value(), suitable[r]));
    return shortages;
}

}  // namespace goffer::fit
