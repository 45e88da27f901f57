// SPDX-License-Identifier: MIT
#pragma once

#include "surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

/// A surface about a center line, straight or a circular arc: what its cross-sections are.

namespace goffer::fit {

/// A center line. The columns of `frame` are e1, e2, e3; e3 is the tangent at `point`.
struct Line {
    Vector3d point;
    Matrix3d frame;
    Vector3d bow = Vector3d::Zero();  // toward the arc's center, of length 1 / its radius; 0: straight

    Vector3d axis() const { return frame.col(2); }
};

/// e1 is the world axis most nearly orthogonal to `axis` (unit), made orthogonal. Of `bow` the part across
/// the axis is kept.
[[nodiscard]] Line line_through(const Vector3d& point, const Vector3d& axis,
                                const Vector3d& bow = Vector3d::Zero());

/// The first of x, y, z whose value is the largest. What differs by less than a fit can tell is a tie, so
/// that no choice turns on a rounding.
[[nodiscard]] int first_largest(const Vector3d& values);

/// The same line, from the point and the tangent that lie `distance` along it.
[[nodiscard]] Line moved_along(const Line& line, double distance);

/// Places about a line: (x, y) along e1 and e2 as carried along it, z the line's own length from its point.
/// About a straight line these are the coordinates in its frame; about an arc, what unbending it leaves.
class Straightened {
public:
    explicit Straightened(const Line& line);

    [[nodiscard]] Vector3d operator()(const Vector3d& place) const {
        const Vector3d local = turn_ * (place - point_);
        return curvature_ == 0 ? local : unbent(local);
    }

private:
    [[nodiscard]] Vector3d unbent(const Vector3d& local) const;

    Matrix3d turn_;
    Vector3d point_;
    double curvature_;
    double c_ = 1, s_ = 0;  // of the bow's direction, in e1 and e2
};

/// The middle of a triangle's edge. Three of them integrate what is quadratic over the triangle exactly.
struct Sample {
    Vector3d place;   // straightened
    double rho;       // the mean of the edge's ends, not shortened by the chord
    double flux;      // its share of the integral of rho^2 over the unrolled (beta, z) plane; none for caps
    double unrolled;  // its share of that plane's area
    double upright;   // squared cosine of the surface's slope against the line: 1 on a tube, 0 on a cap

    double lateral() const { return flux / rho; }  // its share of the lateral area
};

/// The body, straightened.
struct View {
    std::vector<Vector3d> local;  // of each vertex
    std::vector<double> rho;

    View(const Body& body, const Line& line);
};

/// The flux of the field (x, y, 0) through the triangles is the integral of rho^2 over their images in the
/// unrolled plane. Taken without its sign, so that the winding does not matter.
template <class Visit>
void each_sample(const Body& body, const View& view, Visit visit) {
    constexpr double least = 0.05;  // of rho^2: no sample on the axis outweighs all others
    for (std::size_t t = 0; t < body.triangles.size(); t += 3) {
        const std::array corner{body.triangles[t], body.triangles[t + 1], body.triangles[t + 2]};
        const Vector3d& p = view.local[corner[0]];
        const Vector3d normal = (view.local[corner[1]] - p).cross(view.local[corner[2]] - p) / 2;
        const double upright = normal.head<2>().squaredNorm() / normal.squaredNorm();
        const double far = std::max({view.rho[corner[0]], view.rho[corner[1]], view.rho[corner[2]]});
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = corner[i], b = corner[(i + 1) % 3];
            Sample s{(view.local[a] + view.local[b]) / 2, (view.rho[a] + view.rho[b]) / 2, 0, 0, upright};
            s.flux = std::abs(normal.head<2>().dot(s.place.head<2>())) / 3;
            if (s.flux == 0) continue;
            s.unrolled = s.flux / std::max(s.rho * s.rho, least * far * far);
            visit(s);
        }
    }
}

/// Lowest and highest z of the vertices that triangles use.
[[nodiscard]] std::pair<double, double> extent(const Body& body, const Line& line);

/// Radius and residual about a line, in units of the body's size and of the radius.
struct Section {
    double radius;
    double residual;
};

/// r^2 is the mean of rho^2 over the unrolled surface: pi r^2 is the mean area of the sections. Throws Error
/// where there is no surface around the line.
[[nodiscard]] Section section(const Body& body, const Line& line);

/// A center line with what is about it, in units of the body's size.
struct Fitted {
    Line line;
    double low, high;  // from the line's point to base and tip, along the line
    Section section;

    [[nodiscard]] double angle() const { return line.bow.norm() * (high - low); }
};

/// Throws Error where there is no surface around the line.
[[nodiscard]] Fitted measured(const Body& body, const Line& line);

/// Moves a straight line, and tilts it if it may, until it is the axis of the sections' circles. What comes
/// may be nonsense where the body has no such axis.
struct Settled {
    Line line;
    double radius;  // of the circles; NaN where that came to nothing
};
[[nodiscard]] Settled settle(const Body& body, const Line& start, bool tilt);

}  // namespace goffer::fit
