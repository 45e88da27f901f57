// SPDX-License-Identifier: MIT
#pragma once

#include "surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

/// The cross-sections of a surface about a center line, which is straight or a circular arc.

namespace goffer::fit {

/// A center line. The columns of `frame` are e1, e2, e3; e3 is the tangent at `point`.
struct Line {
    Vector3d point;
    Matrix3d frame;
    Vector3d bow = Vector3d::Zero();  // toward the arc's center, of length 1 / its radius; 0: straight

    Vector3d axis() const { return frame.col(2); }
};

/// Makes a line. e1 is the world axis most nearly orthogonal to `axis` (unit length), made orthogonal. The
/// part of `bow` along the axis is dropped.
[[nodiscard]] Line line_through(const Vector3d& point, const Vector3d& axis,
                                const Vector3d& bow = Vector3d::Zero());

/// Which of x, y, z has the largest value. Values that differ by less than a fit can tell are a tie, which
/// the first wins, so that no choice depends on a rounding.
[[nodiscard]] int first_largest(const Vector3d& values);

/// The same line, from the point and the tangent that lie `distance` along it.
[[nodiscard]] Line moved_along(const Line& line, double distance);

/// Whether a body whose ends lie apart in the direction `chord` lies along `axis`, one way or the other:
/// within about 45 degrees. Both have unit length.
[[nodiscard]] inline bool lies_along(const Vector3d& chord, const Vector3d& axis) {
    constexpr double within = 0.7;  // cosine
    return !(std::abs(chord.dot(axis)) < within);
}

/// Whether something is left of the inner line of an arc whose outer line is `length` long. False for NaN.
[[nodiscard]] inline bool has_inner_line(double length, double angle, double radius) {
    constexpr double most = 1 - 1e-4;
    return angle * 2 * radius < most * length;
}

/// Maps places to coordinates about a line: (x, y) along e1 and e2 as carried along it, z the length along
/// the line from its point. About a straight line these are the coordinates in its frame; about an arc, those
/// that are left when it is unbent.
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
    double c_ = 1, s_ = 0;  // the direction of the bow, in e1 and e2
};

/// The middle of a triangle's edge. Three of them integrate what is quadratic over the triangle exactly.
struct Sample {
    Vector3d place;   // straightened
    double rho;       // mean of the edge's ends, which the chord does not shorten
    double flux;      // its share of the integral of rho^2 over the unrolled (beta, z) plane; 0 on a cap
    double unrolled;  // its share of that plane's area
    double upright;   // squared cosine of the surface's slope against the line: 1 on a tube, 0 on a cap

    double lateral() const { return flux / rho; }  // its share of the lateral area
};

/// The body, straightened.
struct View {
    std::vector<Vector3d> local;  // of each vertex
    std::vector<double> rho;

    View(const Body& body, const Line& line) : View(body, Straightened(line)) {}

    /// `straightened` maps a place to coordinates about a center line.
    template <class Map>
    View(const Body& body, const Map& straightened) {
        local.reserve(body.points.size());
        rho.reserve(body.points.size());
        for (const Vector3d& p : body.points) {
            local.push_back(straightened(p));
            rho.push_back(local.back().template head<2>().norm());
        }
    }
};

/// Calls visit(sample) for the samples of all triangles. The flux of the field (x, y, 0) through a triangle
/// is the integral of rho^2 over its image in the unrolled plane. Its sign is dropped, so that the winding
/// does not matter.
template <class Visit>
void each_sample(const Body& body, const View& view, Visit visit) {
    constexpr double least = 0.05;  // share of rho^2, so that no sample on the axis outweighs all others
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
[[nodiscard]] std::pair<double, double> extent(const Body& body, const View& view);

/// The sections of a body, gathered in a few slices along its line: that a bottle's neck is thinner than its
/// belly must not count as a bend.
class Slices {
public:
    Slices(const Body& body, const View& view, std::size_t count = 16)
        : count_(count), body_(body), view_(view), extent_(extent(body, view)) {}

    /// `visit` gets each sample, the number of its slice, and its weight. Caps have none.
    template <class Visit>
    void each(Visit visit) const {
        const auto last = static_cast<double>(count_) - 1;
        const double scale = static_cast<double>(count_) / (extent_.second - extent_.first);
        each_sample(body_, view_, [&](const Sample& s) {
            const double at = (s.place.z() - extent_.first) * scale;
            const double slice = at > 0 ? std::min(at, last) : 0;  // for NaN, too
            visit(s, static_cast<std::size_t>(slice), s.unrolled * s.upright);
        });
    }

    [[nodiscard]] std::size_t count() const { return count_; }

private:
    std::size_t count_;
    const Body& body_;
    const View& view_;
    std::pair<double, double> extent_;
};

/// How far the sections about a line are from circles about it: the rms of rho's difference from its mean in
/// a slice. It is 0 if all sections are circles about the line, whatever their radii.
[[nodiscard]] double roughness(const Body& body, const View& view);

/// Radius and residual about a line, in units of the body's size and of the radius.
struct Section {
    double radius;
    double residual;
};

/// r^2 is the mean of rho^2 over the unrolled surface: pi r^2 is the mean area of the sections. Nothing where
/// there is no surface around the line.
[[nodiscard]] std::optional<Section> section_around(const Body& body, const View& view);

/// The same. Throws Error where there is no surface around the line.
[[nodiscard]] Section section(const Body& body, const Line& line);

/// A center line with the body's extent and section about it, in units of the body's size.
struct Fitted {
    Line line;
    double low, high;  // from the line's point to base and tip, along the line
    Section section;

    [[nodiscard]] double angle() const { return line.bow.norm() * (high - low); }
};

/// Throws Error where there is no surface around the line.
[[nodiscard]] Fitted measured(const Body& body, const Line& line);

struct Settled {
    Line line;
    double radius;  // of the sections' circles; NaN if there are none
};

/// Moves a straight line, and with `tilt` turns it, until it is the axis of the sections' circles. The result
/// may be nonsense if the body has no such axis.
[[nodiscard]] Settled settle(const Body& body, const Line& start, bool tilt);

}  // namespace goffer::fit
