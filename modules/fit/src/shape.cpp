// SPDX-License-Identifier: MIT
#include "rest.hpp"
#include "triangle.hpp"

#include <goffer/bend/rest_vertex.hpp>
#include <goffer/fit/cylinder.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace goffer::fit {
namespace {

constexpr double least_deviation = 0.05;  // rms, of the mean radius: below it the body is a cylinder
constexpr double floor_share = 0.2;       // least radius, of the mean
constexpr double window = 0.5;            // mean radii over which the profile is smoothed
constexpr double max_knots = 128;

/// Sums of weighted distances from the axis about equally spaced heights.
class Profiler {
public:
    Profiler(double length, double width, std::size_t knots)
        : step_(length / static_cast<double>(knots - 1)), width_(width), sums_(knots), weights_(knots) {}

    void add(double z, double rho, double weight) {
        const double low = std::ceil((z - width_) / step_), high = std::floor((z + width_) / step_);
        const double last = static_cast<double>(sums_.size()) - 1;
        for (double at = std::max(low, 0.0); at <= std::min(high, last); ++at) {
            const double away = (at * step_ - z) / width_;
            const double share = weight * (1 - away * away);
            sums_[static_cast<std::size_t>(at)] += share * rho;
            weights_[static_cast<std::size_t>(at)] += share;
        }
    }

    /// The means; where there is no surface, that of the nearest height with some. Empty: nowhere is any.
    [[nodiscard]] std::vector<double> means() const {
        std::vector<double> means(sums_.size(), 0);
        std::vector<std::size_t> filled;
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            if (weights_[i] > 0) filled.push_back(i), means[i] = sums_[i] / weights_[i];
        }
        if (filled.empty()) return {};
        for (std::size_t i = 0; i < means.size(); ++i) {
            const auto distance = [i](std::size_t j) { return j > i ? j - i : i - j; };
            means[i] = means[*std::ranges::min_element(filled, {}, distance)];  // its own where it has one
        }
        return means;
    }

private:
    double step_, width_;
    std::vector<double> sums_, weights_;
};

/// Adds a triangle, cut into pieces that are short along the body, by the area of its lateral part.
void add_triangle(Profiler& profiler, const Straightening& straightening, const Triangle& triangle,
                  double longest) {
    const auto& corner = triangle.corner;
    double z[3];
    for (std::size_t i = 0; i < 3; ++i) z[i] = straightening.height(corner[i]);
    const auto [low, high] = std::minmax({z[0], z[1], z[2]});
    const int pieces = static_cast<int>(std::clamp(std::ceil((high - low) / longest), 1.0, 32.0));
    const glm::dvec3 face = triangle.normal();
    const double area = glm::length(face) / (2.0 * pieces * pieces);
    // How steep the triangle is against the axis: 0 on a cap.
    const paper::Cylindrical center = straightening.vertex(triangle.centroid());
    if (!(glm::length(face) > 0)) return;
    const bend::RestVector normal = straightening.normal(glm::normalize(face), center);
    const double upright = 1 - normal.z * normal.z;
    for (int i = 0; i < pieces; ++i) {
        for (int j = 0; j < 2 * (pieces - i) - 1; ++j) {  // of the row, pointing one way and the other
            const double a = (i + (j % 2 == 0 ? 1.0 : 2.0) / 3) / pieces;
            const int before = j / 2;  // that point the same way
            const double b = (before + (j % 2 == 0 ? 1.0 : 2.0) / 3) / pieces;
            const glm::dvec3 point = corner[0] + a * (corner[1] - corner[0]) + b * (corner[2] - corner[0]);
            const paper::Cylindrical at = straightening.vertex(point);
            profiler.add(at.z, at.rho, area * upright);
        }
    }
}

std::vector<double> mean_radii(const Geometry& geometry, const Cylinder& cylinder) {
    const double steps = std::ceil(2 * cylinder.length / cylinder.radius);
    const auto knots = static_cast<std::size_t>(std::clamp(steps, 4.0, max_knots)) + 1;
    const double step = cylinder.length / static_cast<double>(knots - 1);
    const double width = std::max(window * cylinder.radius, step);
    Profiler profiler(cylinder.length, width, knots);
    const Straightening straightening(cylinder);
    for (std::size_t t = 0; t + 2 < geometry.triangles.size(); t += 3) {
        const Triangle triangle(geometry.positions, geometry.triangles.subspan(t, 3));
        add_triangle(profiler, straightening, triangle, width / 2);
    }
    return profiler.means();
}

/// The radii of `plain`, at equal steps of it, at as many equal steps of a chain whose arcs have other
/// lengths.
std::vector<double> radii_along(const Cylinder& plain, const paper::Spline& radius, const Cylinder& chain,
                                std::size_t count) {
    std::vector<double> radii;
    std::size_t arc = 0;
    double start = 0, plain_start = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double z = chain.length * static_cast<double>(i) / static_cast<double>(count - 1);
        while (arc + 1 < chain.arcs.size() && z > start + chain.arcs[arc].length) {
            start += chain.arcs[arc].length;
            plain_start += plain.arcs[arc++].length;
        }
        const double share = (z - start) / chain.arcs[arc].length;
        radii.push_back(radius(plain_start + share * plain.arcs[arc].length));
    }
    return radii;
}

/// `plain`, a chain, with the radii that are at equal steps of it. The outer lines of arcs go with their own
/// radii, and each center line stays where it is. `plain` itself where an arc has no room.
Cylinder along_chain(const Cylinder& plain, const std::vector<double>& radii) {
    constexpr int steps = 8;  // lengths and radii depend a little on each other
    const paper::Spline radius(plain.length, radii);
    Cylinder shaped = plain;
    for (int step = 0; step < steps; ++step) {
        shaped.radii = radii_along(plain, radius, shaped, radii.size());
        shaped.radius = paper::Spline(shaped.length, shaped.radii).mean();
        double start = 0, length = 0;
        for (std::size_t i = 0; i < shaped.arcs.size(); ++i) {
            RestArc& arc = shaped.arcs[i];
            const double mean = radius_of(shaped, start, arc.length);
            const double thickest = thickest_of(shaped, start, arc.length);
            start += arc.length;
            arc.length = plain.arcs[i].length + arc.angle * (mean - plain.radius);
            if (!(arc.length > 0 && arc.angle < 0.98 * arc.length / (2 * thickest))) return plain;
            length += arc.length;
        }
        shaped.length = length;
    }
    return shaped;
}

}  // namespace

Cylinder fit_shape(const Geometry& geometry, const Cylinder& cylinder) {
    check(geometry);
    check(cylinder);
    Cylinder plain = with_one_radius(cylinder);
    check(plain);
    std::vector<double> radii = mean_radii(geometry, plain);
    if (radii.empty()) return plain;
    const double raw_mean = paper::Spline(plain.length, radii).mean();
    for (double& radius : radii) radius = std::max(radius, floor_share * raw_mean);
    const double mean = paper::Spline(plain.length, radii).mean();
    double square = 0;
    for (const double radius : radii) square += (radius / mean - 1) * (radius / mean - 1);
    if (std::sqrt(square / static_cast<double>(radii.size())) < least_deviation) return plain;
    if (!plain.arcs.empty()) return along_chain(plain, radii);
    Cylinder shaped = plain;
    shaped.radii = std::move(radii);
    shaped.radius = mean;
    // The center line stays where it is.
    if (plain.rest_angle != 0) shaped.length = plain.rest_angle * (rest_radius(plain) + mean);
    const double thickest = *std::ranges::max_element(shaped.radii);
    if (!(shaped.rest_angle < 0.98 * shaped.length / (2 * thickest))) return plain;
    return shaped;
}

}  // namespace goffer::fit
