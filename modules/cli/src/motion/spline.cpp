// SPDX-License-Identifier: MIT
#include "motion/spline.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace goffer::cli {
namespace {

using glm::dvec3;

/// About as many points in all, but not too few on a piece, nor more than are of use.
std::size_t steps_for(std::size_t pieces) {
    constexpr std::size_t all = 8192, least = 8, most = 256;
    return std::clamp(all / pieces, least, most);
}

dvec3 on_bezier(const dvec3* p, double t) {
    const double s = 1 - t;
    return s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3];
}

/// Between the second and the third of four points, none of which repeats the one before it (Barry and
/// Goldman 1988, knots by the square roots of distances).
dvec3 on_catmull_rom(const std::array<dvec3, 4>& p, double t) {
    std::array<double, 4> knot{};
    for (std::size_t i = 1; i < 4; ++i) knot[i] = knot[i - 1] + std::sqrt(glm::distance(p[i - 1], p[i]));
    const double at = knot[1] + t * (knot[2] - knot[1]);
    const auto between = [&](const dvec3& a, const dvec3& b, std::size_t from, std::size_t to) {
        return ((knot[to] - at) * a + (at - knot[from]) * b) / (knot[to] - knot[from]);
    };
    const dvec3 a = between(p[0], p[1], 0, 1), b = between(p[1], p[2], 1, 2), c = between(p[2], p[3], 2, 3);
    return between(between(a, b, 0, 2), between(b, c, 1, 3), 1, 2);
}

std::vector<dvec3> beziers(const std::vector<dvec3>& control) {
    std::vector<dvec3> points{control.front()};
    const std::size_t curves = control.size() / 4, steps = steps_for(curves);
    points.reserve(1 + curves * (steps + 1));
    for (std::size_t curve = 0; curve < curves; ++curve) {
        const dvec3* const p = &control[4 * curve];
        for (std::size_t i = 0; i < steps; ++i)
            points.push_back(on_bezier(p, static_cast<double>(i) / static_cast<double>(steps)));
        points.push_back(p[3]);
    }
    return points;
}

std::vector<dvec3> catmull_rom(const std::vector<dvec3>& given, bool closed) {
    std::vector<dvec3> through;
    through.reserve(given.size());
    for (const dvec3& point : given) {
        if (through.empty() || through.back() != point) through.push_back(point);
    }
    const bool ring = closed || (through.size() > 1 && through.front() == through.back());
    if (ring && through.front() == through.back()) through.pop_back();
    const std::size_t count = through.size();
    if (count < 3) return given;
    const auto point = [&](std::ptrdiff_t i) {
        const auto last = static_cast<std::ptrdiff_t>(count) - 1;
        if (ring) return through[static_cast<std::size_t>((i + last + 1) % (last + 1))];
        if (i < 0) return 2.0 * through[0] - through[1];
        return i > last ? 2.0 * through[count - 1] - through[count - 2]
                        : through[static_cast<std::size_t>(i)];
    };
    const std::size_t pieces = ring ? count : count - 1, steps = steps_for(pieces);
    std::vector<dvec3> points;
    points.reserve(pieces * steps + 1);
    for (std::size_t piece = 0; piece < pieces; ++piece) {
        const auto i = static_cast<std::ptrdiff_t>(piece);
        const std::array<dvec3, 4> p{point(i - 1), point(i), point(i + 1), point(i + 2)};
        points.push_back(p[1]);
        for (std::size_t k = 1; k < steps; ++k)
            points.push_back(on_catmull_rom(p, static_cast<double>(k) / static_cast<double>(steps)));
    }
    points.push_back(point(static_cast<std::ptrdiff_t>(pieces)));
    return points;
}

}  // namespace

std::vector<dvec3> sampled(const PathWords& words) {
    if (words.bezier) return beziers(words.points);
    return words.smooth ? catmull_rom(words.points, words.closed) : words.points;
}

}  // namespace goffer::cli
