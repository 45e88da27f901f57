// SPDX-License-Identifier: MIT
#include "surface.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace goffer::fit {
namespace {

double area(const Matrix3d& corners) {
    return (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm() / 2;
}

/// Barycentric coordinates of the n-th of points that fill a triangle evenly (an additive recurrence).
Vector3d spread_evenly(double n) {
    constexpr double g = 1.32471795724474602596;  // g^3 = g + 1
    double u = std::fmod(n / g, 1), v = std::fmod(n / (g * g), 1);
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    return {1 - u - v, u, v};
}

}  // namespace

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

double area_of(const Body& body) {
    double area = 0;
    for (std::size_t t = 0; t < body.triangles.size(); t += 3) {
        const Vector3d& a = body.points[body.triangles[t]];
        area += (body.points[body.triangles[t + 1]] - a).cross(body.points[body.triangles[t + 2]] - a).norm();
    }
    return area / 2;
}

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

Body sampled_surface(const Body& body, std::size_t count, std::vector<std::uint32_t>& triangles) {
    const auto triangle = [&body](std::size_t t) {
        Matrix3d corners;
        for (int i = 0; i < 3; ++i)
            corners.col(i) = body.points[body.triangles[t + static_cast<std::size_t>(i)]];
        return corners;
    };
    std::vector<double> areas;  // up to and with each triangle
    double all = 0;
    for (std::size_t t = 0; t < body.triangles.size(); t += 3) areas.push_back(all += area(triangle(t)));

    Body result{{}, {}, body.middle, body.size};
    constexpr double small = 0.01;  // of the size at which they would cover the surface
    const double each = all / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double place = static_cast<double>(i);
        const auto at = std::ranges::upper_bound(areas, (place + 0.5) * each);
        const Matrix3d corners = triangle(3 * std::min<std::size_t>(at - areas.begin(), areas.size() - 1));
        const Vector3d middle = corners * spread_evenly(place);
        const double scale = small * std::sqrt(each / area(corners));
        for (int corner = 0; corner < 3; ++corner) {
            triangles.push_back(static_cast<std::uint32_t>(result.points.size()));
            result.points.push_back(middle + scale * (corners.col(corner) - corners.rowwise().mean()));
        }
    }
    result.triangles = triangles;
    return result;
}

}  // namespace goffer::fit
