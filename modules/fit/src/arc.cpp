// SPDX-License-Identifier: MIT
#include "arc.hpp"

#include "least_squares.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace goffer::fit {
namespace {

/// Where the centers of sections lie across the line: constant, linear and square terms, of x and y each.
using CenterParabola = Eigen::Matrix<double, 6, 1>;

/// A cloud of vertices, seen along a direction through its centroid.
struct Chord {
    Line line;
    double spread;                // variance along it
    std::array<Vector3d, 5> bow;  // directions in which the body may bow off it, unit
};

/// Most arcs bow in the direction of n in (x, y) = a + m z + n z^2, in least squares. Where the caps of a
/// stout body hide that, they bow in one of the main directions of the surface across the chord.
Chord chord_of(const Body& cloud, const Vector3d& axis) {
    Vector3d centroid = Vector3d::Zero();
    for (const Vector3d& p : cloud.points) centroid += p / static_cast<double>(cloud.points.size());
    const Line line = line_through(centroid, axis);
    Matrix3d normal = Matrix3d::Zero();
    Matrix3d spread = Matrix3d::Zero();
    Eigen::Matrix<double, 3, 2> right = decltype(right)::Zero();
    for (const Vector3d& place : cloud.points) {
        const Vector3d p = line.frame.transpose() * (place - centroid);
        const Vector3d row{1, p.z(), p.z() * p.z()};
        normal += row * row.transpose();
        spread += p * p.transpose();
        right += row * p.head<2>().transpose();
    }
    const Eigen::Matrix<double, 3, 2> by = least_squares(normal, right);
    const auto across = [&line](const Eigen::Vector2d& v) -> Vector3d {
        return (line.frame.leftCols<2>() * v).stableNormalized();
    };
    const double widest = std::atan2(2 * spread(0, 1), spread(0, 0) - spread(1, 1)) / 2;
    const double c = std::cos(widest), s = std::sin(widest);
    const Vector3d p = across({-s, c}), q = across({c, s});
    return {line, normal(1, 1) / normal(0, 0), {across(by.row(2)), p, -p, q, -q}};
}

/// The arc of `angle` that bows toward `bow`, with the centroid and the spread of the chord.
Line arc_of(double angle, const Chord& chord, const Vector3d& bow) {
    const double half = angle / 2;
    const double radius = std::sqrt(2 * chord.spread / (1 - std::sin(angle) / angle));
    const double inward = radius * (1 - std::sin(half) / half);
    return line_through(chord.line.point - inward * bow, chord.line.axis(), bow / radius);
}

/// The arc of the circle through a cloud's plane that lies nearest to its points (Kasa 1976): about that of a
/// slender body, however far it is bent. It runs the same way along the body as its chord.
Line circle_through(const Body& cloud, const Line& chord) {
    const Vector3d& mean = chord.point;
    Matrix3d spread = Matrix3d::Zero();
    for (const Vector3d& p : cloud.points) spread += (p - mean) * (p - mean).transpose();
    const Matrix3d main = Eigen::SelfAdjointEigenSolver<Matrix3d>(spread).eigenvectors();
    Matrix3d normal = Matrix3d::Zero();
    Vector3d right = Vector3d::Zero();
    for (const Vector3d& p : cloud.points) {
        const Vector3d at = main.transpose() * (p - mean);
        const Vector3d row{1, 2 * at.y(), 2 * at.z()};  // x is across the plane
        normal += row * row.transpose();
        right += (at.y() * at.y() + at.z() * at.z()) * row;
    }
    const Vector3d by = least_squares(normal, right);
    const Vector3d center{0, by[1], by[2]};
    const double radius = std::sqrt(by[0] + center.squaredNorm());
    const Vector3d inward = center.stableNormalized();  // from the middle of the arc
    const Vector3d along{0, -inward.z(), inward.y()};
    const Vector3d tangent = main * along;
    return line_through(mean + main * (center - radius * inward),
                        std::copysign(1.0, tangent.dot(chord.axis())) * tangent, main * inward / radius);
}

/// Sums over a slice, or over all.
template <int size>
struct Sums {
    double weight = 0;
    Eigen::Matrix<double, size, 1> first = decltype(first)::Zero();
};

/// Solves rho^2 = c + 2 (a + m z + n z^2) x + 2 (b + ..) y in least squares for (a, b, m, .., n, ..), with a
/// c of its own in each slice: the circle of each section (Kasa 1976) with its center on a parabola. Exact on
/// a cylinder.
CenterParabola regress(const Body& body, const Line& line) {
    const View view(body, line);
    Eigen::Matrix<double, 7, 7> products = decltype(products)::Zero();
    const Slices of_line(body, view);
    std::vector<Sums<7>> slices(of_line.count());
    of_line.each([&](const Sample& s, std::size_t slice, double weight) {
        const double x = 2 * s.place.x(), y = 2 * s.place.y(), z = s.place.z();
        Eigen::Matrix<double, 7, 1> row;
        row << x, y, z * x, z * y, z * z * x, z * z * y, s.rho * s.rho;
        products += weight * row * row.transpose();
        slices[slice].weight += weight;
        slices[slice].first += weight * row;
    });
    for (const Sums<7>& own : slices) {
        if (own.weight == 0) continue;
        products -= own.first * own.first.transpose() / own.weight;
    }
    return least_squares(products.topLeftCorner<6, 6>(), products.topRightCorner<6, 1>());
}

/// Moves, tilts and bows the line until the centers of the sections' circles lie on it, in `steps` at most.
Line settle(const Body& body, const Line& start, int steps) {
    constexpr double settled = 1e-6;
    Line line = start;
    for (int step = 0; step < steps; ++step) {
        const CenterParabola by = regress(body, line);
        const Matrix3d change = line.frame.leftCols<2>() * by.reshaped(2, 3);
        line = line_through(line.point + change.col(0), (line.axis() + change.col(1)).normalized(),
                            line.bow + 2 * change.col(2));
        if (!(by.norm() >= settled)) break;  // for NaN, too
    }
    return line;
}

/// Whether a body can have this arc: below a full turn, with a length left on its inner side. False for NaN.
bool possible(const Fitted& arc) {
    const double angle = arc.angle(), radius = arc.section.radius;
    const double length = arc.high - arc.low + angle * radius;  // of the outer line
    return angle < 2 * std::numbers::pi && has_inner_line(length, angle, radius);
}

std::optional<Fitted> arc_from(const Body& body, const Line& start, int steps) {
    const Line line = settle(body, start, steps);
    if (!line.point.allFinite() || !line.frame.allFinite() || !line.bow.allFinite()) return std::nullopt;
    const View view(body, line);
    const std::optional<Section> around = section_around(body, view);
    if (!around) return std::nullopt;
    const auto [low, high] = extent(body, view);
    const Fitted arc{line, low, high, *around};
    return possible(arc) ? std::optional(arc) : std::nullopt;
}

/// Whether the body is a tube about the arc, and that by more than noise or a relief would make it better
/// than one about the straight line. `slack`: 1, or more where both lines are known only roughly.
bool convincing(const Body& body, const Fitted& arc, const Line& straight, double slack) {
    constexpr double better = 0.8;    // share of the straight line's roughness
    constexpr double min_sag = 0.05;  // share of the radius: what bends less is straight
    // As a share of the radius: rougher bodies are no tubes. Beyond a half turn less is allowed, since few
    // bodies are bent so far, but such an arc fits many others a little.
    const double roughest = arc.angle() < std::numbers::pi ? 0.3 : 0.2;
    const double rough = roughness(body, View(body, arc.line));
    const double sag = (arc.high - arc.low) * arc.angle() / 8;
    return rough < slack * roughest * arc.section.radius && slack * sag > min_sag * arc.section.radius &&
           rough < slack * better * roughness(body, View(body, straight));
}

/// The best of arcs that begin with the points' circle, and with several angles and directions.
std::optional<Fitted> rough_arc(const Body& cloud, const Vector3d& axis) {
    constexpr double degree = std::numbers::pi / 180;
    constexpr int few_steps = 5;
    const Chord chord = chord_of(cloud, axis);
    std::optional<Fitted> best;
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](const Line& start) {
        const std::optional<Fitted> arc = arc_from(cloud, start, few_steps);
        const double own = arc ? roughness(cloud, View(cloud, arc->line)) : least;
        if (!(own < least)) return;
        least = own;
        best = arc;
    };
    consider(circle_through(cloud, chord.line));
    for (const double angle : {30., 90., 150.})
        for (const Vector3d& bow : chord.bow) consider(arc_of(angle * degree, chord, bow));
    return best;
}

}  // namespace

std::optional<Fitted> fit_arc(const Body& body, const Vector3d& axis, const Line& straight) {
    constexpr std::size_t enough = 800;
    constexpr int max_steps = 20;
    constexpr double slack = 1.1;
    std::vector<std::uint32_t> triangles;
    const Body cloud = sampled_surface(body, enough, triangles);
    const std::optional<Fitted> rough = rough_arc(cloud, axis);
    if (!rough) return std::nullopt;
    if (!convincing(cloud, *rough, straight, slack)) return std::nullopt;
    const std::optional<Fitted> arc = arc_from(body, rough->line, max_steps);
    return arc && convincing(body, *arc, straight, 1) ? arc : std::nullopt;
}

}  // namespace goffer::fit
