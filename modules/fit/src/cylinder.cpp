// SPDX-License-Identifier: MIT
#include "text.hpp"

#include <goffer/fit/cylinder.hpp>

#include <glm/geometric.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace goffer::fit {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Row = Eigen::Matrix<double, 5, 1>;

/// A body is long where its surface spreads (in standard deviations) this much farther along one direction
/// than along the next: an open cylinder of L = 3 r does by 1.22, a sphere, a cube and a disc by 1.00.
constexpr double long_enough = 1.1;

/// Least squares speak about bodies that are cylinders but for a relief. Others keep their principal axis.
constexpr double nearly_round = 0.1;

Vector3d eigen(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
glm::dvec3 from_eigen(const Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

using fit::text;

using fit::text;
std::string text(const Vector3d& v) {
    return text(v.x()) + "," + text(v.y()) + "," + text(v.z());
}

/// The mesh in double, about its middle and in units of its size: nothing cancels, nothing overflows.
struct Body {
    std::vector<Vector3d> points;  // one per vertex
    std::span<const std::uint32_t> triangles;
    Vector3d middle;  // model space
    double size;      // model units: the largest side of the box
};

Body body_of(const Geometry& geometry) {
    Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
    Vector3d high = -low;
    for (const std::uint32_t i : geometry.triangles) {
        const Vector3d p = eigen(geometry.positions[i]);
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    Body body{{}, geometry.triangles, (low + high) / 2, (high - low).maxCoeff()};
    body.points.reserve(geometry.positions.size());
    for (const glm::vec3& p : geometry.positions) {
        body.points.emplace_back((eigen(p) - body.middle) / body.size);
    }
    return body;
}

/// Centroid and long direction of the surface.
struct Principal {
    Vector3d centroid;
    Vector3d axis;
    double distinct;  // spread along the axis over the spread along the next
};

/// From the exact integrals of 1, x and x x^T over the triangles.
Principal principal_axis(const Body& body) {
    double area = 0;
    Vector3d first = Vector3d::Zero();
    Matrix3d second = Matrix3d::Zero();
    for (std::size_t t = 0; t < body.triangles.size(); t += 3) {
        const Vector3d& a = body.points[body.triangles[t]];
        const Vector3d& b = body.points[body.triangles[t + 1]];
        const Vector3d& c = body.points[body.triangles[t + 2]];
        const double own = (b - a).cross(c - a).norm() / 2;
        const Vector3d sum = a + b + c;
        area += own;
        first += own / 3 * sum;
        second +=
            own / 12 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    }
    constexpr double no_area = 1e-10;
    if (area < no_area) throw Error("all triangles are without area; give a mesh with a surface");
    const Vector3d centroid = first / area;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(second / area - centroid * centroid.transpose());
    const Vector3d spread = solver.eigenvalues().cwiseMax(1e-30).cwiseSqrt();
    return {centroid, solver.eigenvectors().col(2), spread[2] / spread[1]};
}

/// The first of x, y, z whose value is the largest. What differs by less than a fit can tell is a tie, so
/// that no choice turns on a rounding.
int first_largest(const Vector3d& values) {
    constexpr double tie = 1e-4;
    int i = 0;
    while (values[i] < values.maxCoeff() - tie) ++i;
    return i;
}

/// The long axis, signed so that its largest component is positive.
Vector3d long_axis(const Principal& principal) {
    if (principal.distinct < long_enough) {
        throw Error("the mesh has no long axis: its surface spreads " + text(principal.distinct) +
                    " times as far along its longest direction as along the next, " + text(long_enough) +
                    " is needed; name the axis with --axis x|y|z|X,Y,Z");
    }
    return principal.axis;
}

Vector3d given_axis(const glm::dvec3& axis) {
    const Vector3d direction = eigen(axis);
    if (!direction.allFinite() || direction.isZero(0)) {
        throw Error("axis " + text(direction) + " has no direction; give three finite numbers, not all 0");
    }
    return direction.stableNormalized();
}

/// An axis line; the columns of `frame` are e1, e2, e3.
struct Line {
    Vector3d point;
    Matrix3d frame;

    Vector3d axis() const { return frame.col(2); }
};

Line line_through(const Vector3d& point, const Vector3d& axis) {
    const Vector3d world = Vector3d::Unit(first_largest(-axis.cwiseAbs()));
    Line line{point, Matrix3d{}};
    line.frame.col(2) = axis;
    line.frame.col(0) = (world - axis.dot(world) * axis).normalized();
    line.frame.col(1) = line.frame.col(2).cross(line.frame.col(0));
    return line;
}

/// The middle of a triangle's edge. Three of them integrate what is quadratic over the triangle exactly.
struct Sample {
    Vector3d place;   // x, y, z in the line's frame
    double rho;       // the mean of the edge's ends, not shortened by the chord
    double flux;      // its share of the integral of rho^2 over the unrolled (beta, z) plane; none for caps
    double unrolled;  // its share of that plane's area

    double lateral() const { return flux / rho; }  // its share of the lateral area
};

/// The body in the line's frame.
struct View {
    std::vector<Vector3d> local;  // x, y, z of each vertex
    std::vector<double> rho;

    View(const Body& body, const Line& line) {
        const Matrix3d turn = line.frame.transpose();
        local.reserve(body.points.size());
        rho.reserve(body.points.size());
        for (const Vector3d& p : body.points) {
            local.emplace_back(turn * (p - line.point));
            rho.push_back(local.back().head<2>().norm());
        }
    }
};

/// The flux of the field (x, y, 0) through the triangles is the integral of rho^2 over their images in the
/// unrolled plane. Taken without its sign, so that the winding does not matter.
template <class Visit>
void each_sample(const Body& body, const Line& line, Visit visit) {
    constexpr double least = 0.05;  // of rho^2: no sample on the axis outweighs all others
    const View view(body, line);
    for (std::size_t t = 0; t < body.triangles.size(); t += 3) {
        const std::array corner{body.triangles[t], body.triangles[t + 1], body.triangles[t + 2]};
        const Vector3d& p = view.local[corner[0]];
        const Vector3d normal = (view.local[corner[1]] - p).cross(view.local[corner[2]] - p) / 2;
        const double far = std::max({view.rho[corner[0]], view.rho[corner[1]], view.rho[corner[2]]});
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = corner[i], b = corner[(i + 1) % 3];
            Sample s{(view.local[a] + view.local[b]) / 2, (view.rho[a] + view.rho[b]) / 2, 0, 0};
            s.flux = std::abs(normal.head<2>().dot(s.place.head<2>())) / 3;
            if (s.flux == 0) continue;
            s.unrolled = s.flux / std::max(s.rho * s.rho, least * far * far);
            visit(s);
        }
    }
}

/// Solves rho^2 = c + 2 (a + m z) x + 2 (b + n z) y in least squares for (c, a, b, m, n): the circle of each
/// section (Kasa 1976) with its centre on a line. Exact on a cylinder, wherever its vertices are.
Row regress(const Body& body, const Line& line, bool tilt) {
    Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
    Row right = Row::Zero();
    each_sample(body, line, [&](const Sample& s) {
        const Vector3d& p = s.place;
        const double z = tilt ? p.z() : 0;
        const Row row{1, 2 * p.x(), 2 * p.y(), 2 * p.x() * z, 2 * p.y() * z};
        normal.selfadjointView<Eigen::Lower>().rankUpdate(row, s.unrolled);
        right += s.unrolled * s.rho * s.rho * row;
    });
    normal = normal.selfadjointView<Eigen::Lower>();
    return normal.completeOrthogonalDecomposition().solve(right);
}

/// Moves the line, and tilts it if it may, until it is the axis of the sections' circles. Keeps the start
/// where that comes to nothing, or to a line as far away as the middle of a shallow trough's circle.
Line settle(const Body& body, const Line& start, bool tilt) {
    constexpr int most_steps = 20;
    constexpr double settled = 1e-7;
    constexpr double far = 0.8;  // of the circle's radius: an arc of less than 130 degrees
    Line line = start;
    Row by = Row::Zero();
    for (int step = 0; step < most_steps; ++step) {
        by = regress(body, line, tilt);
        const Vector3d shift = line.frame.leftCols<2>() * by.segment<2>(1);
        const Vector3d turn = line.frame.leftCols<2>() * by.segment<2>(3);
        line = line_through(line.point + shift, (line.axis() + turn).normalized());
        if (by.tail<4>().norm() < settled) break;
    }
    const bool within = (line.point - start.point).norm() < far * std::sqrt(by[0]);  // false for NaN, too
    return within ? line : start;
}

/// Radius and residual about a line, in units of the body's size and of the radius.
struct Section {
    double radius;
    double residual;
};

/// r^2 is the mean of rho^2 over the unrolled surface: pi r^2 is the mean area of the sections.
Section section(const Body& body, const Line& line) {
    double flux = 0, unrolled = 0, area = 0;
    double moment = 0;  // of rho^2 over the lateral area; that of rho is the flux
    each_sample(body, line, [&](const Sample& s) {
        flux += s.flux;
        unrolled += s.unrolled;
        area += s.lateral();
        moment += s.flux * s.rho;
    });
    constexpr double no_flux = 1e-14;
    if (flux < no_flux) {
        throw Error("the mesh has no surface around the axis " + text(line.axis()) +
                    "; name another with --axis");
    }
    const double r = std::sqrt(flux / unrolled);
    return {r, std::sqrt(std::max(0.0, (moment - 2 * r * flux) / area + r * r)) / r};
}

/// Tilts a long axis where the body is so round that this makes it more exact.
Line straighten(const Body& body, const Line& start) {
    constexpr double hopeless = 3 * nearly_round;  // saves the time
    if (section(body, start).residual > hopeless) return start;
    const Line tilted = settle(body, start, true);
    return section(body, tilted).residual < nearly_round ? tilted : start;
}

/// Largest component positive.
Line with_sign(const Line& line) {
    const Vector3d axis = line.axis();
    return axis[first_largest(axis.cwiseAbs())] < 0 ? line_through(line.point, -axis) : line;
}

Line axis_line(const Body& body, const std::optional<glm::dvec3>& axis) {
    const Principal principal = principal_axis(body);
    const Vector3d direction = axis ? given_axis(*axis) : long_axis(principal);
    const Line line = settle(body, line_through(principal.centroid, direction), false);
    return axis ? line : with_sign(straighten(body, line));
}

/// Lowest and highest z of the vertices that triangles use.
std::pair<double, double> extent(const Body& body, const Line& line) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const std::uint32_t i : body.triangles) {
        const double z = line.axis().dot(body.points[i] - line.point);
        low = std::min(low, z);
        high = std::max(high, z);
    }
    return {low, high};
}

/// A float at these coordinates has to tell the axis from the skin, and base from tip.
void check_size(const Cylinder& cylinder, const Body& body) {
    using Float = std::numeric_limits<float>;
    const double reach = body.middle.cwiseAbs().maxCoeff() + body.size;
    const double least = std::max<double>(4 * double{Float::epsilon()} * reach, Float::min());
    const bool thin = cylinder.radius < least;
    if (!thin && cylinder.length >= least) return;
    throw Error("the mesh's " + std::string(thin ? "radius " : "length ") +
                text(thin ? cylinder.radius : cylinder.length) + " about the axis " +
                text(eigen(cylinder.axis)) + " is too small for floats at coordinates up to " + text(reach) +
                "; move the mesh to the origin, scale it up or name another axis with --axis");
}

void check_unit(const glm::dvec3& v, std::string_view name) {
    constexpr double tolerance = 1e-3;
    if (std::abs(glm::length(v) - 1) <= tolerance) return;
    throw Error("cylinder: " + std::string(name) + " " + text(eigen(v)) +
                " is not of length 1; normalise it");
}

void check_positive(double value, std::string_view name) {
    if (std::isfinite(value) && value > 0) return;
    throw Error("cylinder: " + std::string(name) + " is " + text(value) + "; give a finite number above 0");
}

void check_finite(const Vector3d& value, std::string_view name) {
    if (value.allFinite()) return;
    throw Error("cylinder: " + std::string(name) + " " + text(value) + " is not finite; give finite numbers");
}

}  // namespace

Cylinder fit_cylinder(const Geometry& geometry, std::optional<glm::dvec3> axis) {
    check(geometry);
    const Body body = body_of(geometry);
    const Line line = axis_line(body, axis);
    const auto [low, high] = extent(body, line);
    const Section measured = section(body, line);

    Cylinder cylinder;
    cylinder.origin = from_eigen(body.middle + body.size * (line.point + low * line.axis()));
    cylinder.axis = from_eigen(line.axis());
    cylinder.zero = from_eigen(line.frame.col(0));
    cylinder.length = body.size * (high - low);
    cylinder.radius = body.size * measured.radius;
    cylinder.residual = measured.residual;
    check_size(cylinder, body);
    return cylinder;
}

void check(const Cylinder& cylinder) {
    check_finite(eigen(cylinder.origin), "origin");
    check_finite(eigen(cylinder.axis), "axis");
    check_finite(eigen(cylinder.zero), "zero");
    check_positive(cylinder.length, "length");
    check_positive(cylinder.radius, "radius");
    check_finite(Vector3d::Constant(cylinder.rest_angle), "rest_angle");
    check_finite(Vector3d::Constant(cylinder.rest_direction), "rest_direction");
    check_finite(Vector3d::Constant(cylinder.residual), "residual");
    check_unit(cylinder.axis, "axis");
    check_unit(cylinder.zero, "zero");
    constexpr double tolerance = 1e-3;
    if (std::abs(glm::dot(cylinder.axis, cylinder.zero)) > tolerance) {
        throw Error("cylinder: zero " + text(eigen(cylinder.zero)) + " is not orthogonal to axis " +
                    text(eigen(cylinder.axis)) + "; take its part along the axis away");
    }
}

}  // namespace goffer::fit
