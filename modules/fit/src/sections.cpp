// SPDX-License-Identifier: MIT
#include "sections.hpp"

#include "least_squares.hpp"

#include <goffer/fit/cylinder.hpp>

#include <Eigen/Geometry>
#include <limits>

namespace goffer::fit {
namespace {

using Row = Eigen::Matrix<double, 5, 1>;

/// Solves rho^2 = c + 2 (a + m z) x + 2 (b + n z) y in least squares for (c, a, b, m, n): the circle of each
/// section (Kasa 1976) with its center on a line. Exact on a cylinder, wherever its vertices are.
Row regress(const Body& body, const Line& line, bool tilt) {
    Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
    Row right = Row::Zero();
    each_sample(body, View(body, line), [&](const Sample& s) {
        const Vector3d& p = s.place;
        const double z = tilt ? p.z() : 0;
        const Row row{1, 2 * p.x(), 2 * p.y(), 2 * p.x() * z, 2 * p.y() * z};
        normal += s.unrolled * row * row.transpose();
        right += s.unrolled * s.rho * s.rho * row;
    });
    return least_squares(normal, right);
}

double sinc(double x) {
    return x == 0 ? 1 : std::sin(x) / x;
}

}  // namespace

int first_largest(const Vector3d& values) {
    constexpr double tie = 1e-4;
    int i = 0;
    while (values[i] < values.maxCoeff() - tie) ++i;
    return i;
}

Line line_through(const Vector3d& point, const Vector3d& axis, const Vector3d& bow) {
    const Vector3d world = Vector3d::Unit(first_largest(-axis.cwiseAbs()));
    Line line{point, Matrix3d{}, bow - axis.dot(bow) * axis};
    line.frame.col(2) = axis;
    line.frame.col(0) = (world - axis.dot(world) * axis).normalized();
    line.frame.col(1) = line.frame.col(2).cross(line.frame.col(0));
    return line;
}

Line moved_along(const Line& line, double distance) {
    if (line.bow.isZero(0)) return {line.point + distance * line.axis(), line.frame};
    const double phi = line.bow.norm() * distance;
    const Vector3d axis = line.axis();
    const Vector3d sagitta = distance * distance / 2 * std::pow(sinc(phi / 2), 2) * line.bow;
    const Vector3d turned = std::cos(phi) * axis + distance * sinc(phi) * line.bow;
    const Vector3d bow = std::cos(phi) * line.bow - line.bow.norm() * std::sin(phi) * axis;
    return line_through(line.point + distance * sinc(phi) * axis + sagitta, turned.normalized(), bow);
}

Straightened::Straightened(const Line& line)
    : turn_(line.frame.transpose()), point_(line.point), curvature_(line.bow.norm()) {
    if (curvature_ == 0) return;
    const Vector3d bow = turn_ * line.bow / curvature_;
    c_ = bow.x();
    s_ = bow.y();
}

// The same as paper::to_cylindrical, but about a point in the middle of the line.
Vector3d Straightened::unbent(const Vector3d& local) const {
    const double x = c_ * local.x() + s_ * local.y();
    const double inward = 1 - curvature_ * x, along = curvature_ * local.z();
    const double squared = x * x + local.z() * local.z();
    const double far = 1 + std::sqrt(inward * inward + along * along);
    const double d = (2 * x - curvature_ * squared) / far;
    const double shift = curvature_ * (x * d - squared) / far;
    return {local.x() + c_ * shift, local.y() + s_ * shift, std::atan2(along, inward) / curvature_};
}

std::pair<double, double> extent(const Body& body, const View& view) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const std::uint32_t i : body.triangles) {
        low = std::min(low, view.local[i].z());
        high = std::max(high, view.local[i].z());
    }
    return {low, high};
}

double roughness(const Body& body, const View& view) {
    struct Sums {
        double weight = 0, rho = 0, square = 0;
    };
    const Slices slices(body, view);
    std::vector<Sums> sums(slices.count());
    slices.each([&](const Sample& s, std::size_t slice, double weight) {
        sums[slice].weight += weight;
        sums[slice].rho += weight * s.rho;
        sums[slice].square += weight * s.rho * s.rho;
    });
    double weight = 0, variance = 0;
    for (const Sums& own : sums) {
        if (own.weight == 0) continue;
        weight += own.weight;
        variance += own.square - own.rho * own.rho / own.weight;
    }
    return std::sqrt(std::max(0.0, variance) / weight);
}

std::optional<Section> section_around(const Body& body, const View& view) {
    double flux = 0, unrolled = 0, area = 0;
    double moment = 0;  // integral of rho^2 over the lateral area; that of rho is the flux
    each_sample(body, view, [&](const Sample& s) {
        flux += s.flux;
        unrolled += s.unrolled;
        area += s.lateral();
        moment += s.flux * s.rho;
    });
    constexpr double no_flux = 1e-14;
    if (flux < no_flux) return std::nullopt;
    const double r = std::sqrt(flux / unrolled);
    return Section{r, std::sqrt(std::max(0.0, (moment - 2 * r * flux) / area + r * r)) / r};
}

Section section(const Body& body, const Line& line) {
    if (const std::optional<Section> around = section_around(body, View(body, line))) return *around;
    throw AxisError("the mesh has no surface around the axis " + text(line.axis()) + "; give another axis");
}

Fitted measured(const Body& body, const Line& line) {
    const auto [low, high] = extent(body, View(body, line));
    return {line, low, high, section(body, line)};
}

Settled settle(const Body& body, const Line& start, bool tilt) {
    constexpr int max_steps = 20;
    constexpr double settled = 1e-7;
    Settled now{start, 0};
    for (int step = 0; step < max_steps; ++step) {
        const Row by = regress(body, now.line, tilt);
        const Vector3d shift = now.line.frame.leftCols<2>() * by.segment<2>(1);
        const Vector3d turn = now.line.frame.leftCols<2>() * by.segment<2>(3);
        now.line = line_through(now.line.point + shift, (now.line.axis() + turn).normalized());
        now.radius = std::sqrt(by[0]);
        if (by.tail<4>().norm() < settled) break;
    }
    return now;
}

}  // namespace goffer::fit
