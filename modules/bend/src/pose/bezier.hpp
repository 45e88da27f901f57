// SPDX-License-Identifier: MIT
#pragma once

#include "pose/center_samples.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

namespace goffer::bend {

/// The largest lane.
[[nodiscard]] inline float largest(Float4 a) noexcept {
    return std::max(std::max(a[0], a[1]), std::max(a[2], a[3]));
}

/// Coordinates of four points, or components of four vectors.
struct Vec3x4 {
    Float4 c[3];

    /// Sets all four to `v`.
    void set(const glm::vec3& v) noexcept {
        for (int i = 0; i < 3; ++i) c[i] = splat(v[i]);
    }

    [[nodiscard]] Float4 square() const noexcept { return c[0] * c[0] + c[1] * c[1] + c[2] * c[2]; }
};

/// The stretch of a cubic curve that a region runs along, and the straight line behind the end of the curve,
/// in float, for four places at a time. Coordinates are relative to where the region begins, in units of its
/// length. The parameter runs from 0 to 1 along the region.
struct BezierStretch {
    Vec3x4 from, linear, square, cubic;
    Vec3x4 end, onward;  // where the line begins, and its direction; 0 unless it `ends`
    static constexpr double most_pace = 3;
    float begin_pace, end_pace;  // d parameter / d length, limited
    Float4 least, most;          // the range of parameters on the curve that is searched
    bool ends;                   // the line is near

    /// The parameters of the places at these distances along the curve, in lengths of the region.
    [[nodiscard]] Float4 parameters(Float4 along) const noexcept {
        const float bend = begin_pace + end_pace - 2;
        return along * (splat(begin_pace) + along * (splat(1 - begin_pace - bend) + along * splat(bend)));
    }
    /// The vectors from four samples of the region, those of samples.arc_x[i], to `point`.
    [[nodiscard]] static Vec3x4 away(const Vec3x4& point, const CenterSamples& samples, int i) noexcept {
        Vec3x4 away;
        for (int c = 0; c < 3; ++c) {
            away.c[c] = point.c[c] - samples.arc_x[i] * splat(samples.across[c]) -
                        samples.arc_z[i] * splat(samples.onward[c]);
        }
        return away;
    }
    /// Squared distances of four samples from the curve, and from the feet of the perpendiculars on its
    /// tangents there.
    struct Squares {
        Float4 from_curve, from_feet;
    };
    /// Moves `parameters` to these feet. `seen` is away() of `from`.
    [[nodiscard]] Squares step(const Vec3x4& seen, Float4& parameters) const noexcept;
    /// The squared distances from the line. `seen` is away() of `end`.
    [[nodiscard]] Float4 from_line(const Vec3x4& seen) const noexcept;
};

inline BezierStretch::Squares BezierStretch::step(const Vec3x4& seen, Float4& parameters) const noexcept {
    const Float4 u = min(max(parameters, least), most);
    Vec3x4 away, slope;
    Float4 dot = splat(0);
    for (int c = 0; c < 3; ++c) {  // Horner's scheme, for the value and the slope
        const Float4 k2 = square.c[c] + u * cubic.c[c], k1 = linear.c[c] + u * k2;
        slope.c[c] = k1 + u * (k2 + u * cubic.c[c]);
        away.c[c] = seen.c[c] + u * k1;
        dot = dot + away.c[c] * slope.c[c];
    }
    const Float4 foot = u - dot / max(slope.square(), splat(1e-30f)), from_curve = away.square();
    parameters = min(max(foot, least), most);
    for (int c = 0; c < 3; ++c) away.c[c] = away.c[c] + (parameters - u) * slope.c[c];
    return {from_curve, away.square()};
}

inline Float4 BezierStretch::from_line(const Vec3x4& seen) const noexcept {
    Float4 dot = splat(0);
    for (int c = 0; c < 3; ++c) dot = dot - seen.c[c] * onward.c[c];
    const Float4 along = max(dot, splat(0)) / max(onward.square(), splat(1e-30f));
    Vec3x4 away;
    for (int c = 0; c < 3; ++c) away.c[c] = seen.c[c] + along * onward.c[c];
    return away.square();
}

/// A walk along a cubic Bezier curve, by length. Beyond its end the path goes straight on. Control points are
/// finite; any of them may be equal.
class Bezier {
public:
    /// Begins at the distance `start` >= 0 from the first point.
    Bezier(const glm::vec3 (&control)[4], double start) noexcept;

    /// The current place.
    [[nodiscard]] glm::dvec3 place() const noexcept {
        return here_.t > 1 ? point(1) + (here_.t - 1) * onward_ : point(here_.t);
    }
    /// The direction at the distance `ahead` >= 0 in front of the current place, as a vector of any length.
    /// It is zero if the curve is a single point, and at the tip of a cusp.
    [[nodiscard]] glm::dvec3 heading(double ahead) noexcept {
        const double t = at(gone_ + ahead).t;
        return t >= 1 ? onward_ : t > 0 ? slope(t) : first_;
    }
    /// Moves on by the length of a region. Returns the largest squared distance of its samples from the path,
    /// which is searched along the region and for about its length before and behind it.
    [[nodiscard]] double advance(const CenterSamples& samples) noexcept;

private:
    static constexpr int pieces = 16;  // equal in the parameter

    struct Place {
        double t, pace;  // the parameter, and d t / d length
    };

    void measure() noexcept;
    [[nodiscard]] Place at(double length) noexcept;
    [[nodiscard]] glm::dvec3 point(double t) const noexcept {
        return start_ + t * (linear_ + t * (square_ + t * cubic_));
    }
    [[nodiscard]] glm::dvec3 slope(double t) const noexcept {
        return linear_ + t * (2.0 * square_ + 3.0 * t * cubic_);
    }
    [[nodiscard]] BezierStretch stretch_to(const Place& to, const CenterSamples& samples) const noexcept;
    /// The parameter from the current place to `to`.
    [[nodiscard]] double span_to(const Place& to) const noexcept { return std::max(to.t - here_.t, 1e-30); }
    /// Sets `feet` to where the samples of a region of `length` would be if it lay on the curve, from the
    /// current place to `to`.
    void look_up(const Place& to, double length, Float4* feet) noexcept;

    glm::dvec3 start_, linear_, square_, cubic_;
    glm::dvec3 first_;           // direction at the start
    glm::dvec3 onward_;          // slope beyond the end; 0 if the curve is a single point
    double onward_pace_ = 0;     // the pace there
    double before_[pieces + 1];  // length of the curve up to the beginning of each piece, and of all of it
    double pace_[pieces + 1];    // the pace there
    int piece_ = 0;              // found last by at()
    double gone_;                // length up to the current place
    Place here_;                 // the current place
    float drift_ = 0;            // of the last foot from where it was expected, in its region's parameter
};

inline Bezier::Bezier(const glm::vec3 (&control)[4], double start) noexcept : gone_(start) {
    const glm::dvec3 a(control[0]), b(control[1]), c(control[2]), d(control[3]);
    start_ = a;
    linear_ = 3.0 * (b - a);
    square_ = 3.0 * (a - 2.0 * b + c);
    cubic_ = d - a + 3.0 * (b - c);
    // What is left of a handle after rounding has a direction that the curve leaves at once.
    const double least = 1e-5 * (glm::distance(a, b) + glm::distance(b, c) + glm::distance(c, d));
    const auto apart = [least](const glm::dvec3& p, const glm::dvec3& q) {
        return glm::distance(p, q) > least;
    };
    first_ = apart(a, b) ? b - a : apart(a, c) ? c - a : d - a;
    onward_ = 3.0 * (apart(d, c) ? d - c : apart(d, b) ? d - b : d - a);
    measure();
    // Beyond the end a parameter that ran far faster than on the curve would leave the range of its powers.
    const double own = glm::length(onward_), speed = own > 0 ? std::max(own, 1e-3 * before_[pieces]) : 0;
    if (speed > 0) {
        onward_ *= speed / own;
        onward_pace_ = 1 / speed;
    }
    here_ = at(start);
}

/// Measures the length by Simpson's rule, piece by piece.
inline void Bezier::measure() noexcept {
    double speed[2 * pieces + 1];
    for (int i = 0; i <= 2 * pieces; ++i) {
        const glm::dvec3 v = slope(static_cast<double>(i) / (2 * pieces));
        speed[i] = std::sqrt(glm::dot(v, v));
    }
    before_[0] = 0;
    const double* at = speed;  // where the piece begins; its middle and its end follow
    for (int i = 0; i < pieces; ++i, at += 2) {
        const double mean = (at[0] + 4 * at[1] + at[2]) / 6;
        before_[i + 1] = before_[i] + mean / pieces;
    }
    // Where control points coincide the speed is 0: at() limits paces to far less than this.
    const double least = std::max(1e-12 * before_[pieces], min_square);
    for (std::size_t i = 0; i < std::size(pace_); ++i) pace_[i] = 1 / std::max(speed[2 * i], least);
}

/// Within a piece, the parameter is a cubic polynomial of the length, given by values and paces at both ends.
/// Paces are limited so that the cubic increases for sure.
inline Bezier::Place Bezier::at(double length) noexcept {
    if (length >= before_[pieces]) {
        return {1 + (length - before_[pieces]) * onward_pace_, onward_pace_};
    }
    while (before_[piece_ + 1] < length) ++piece_;
    while (before_[piece_] > length) --piece_;
    const double whole = std::max(before_[piece_ + 1] - before_[piece_], min_square), per_whole = 1 / whole;
    const double x = (length - before_[piece_]) * per_whole;
    const double from = std::min(pace_[piece_] * whole * pieces, 3.0);
    const double to = std::min(pace_[piece_ + 1] * whole * pieces, 3.0);
    const double square = 3 - 2 * from - to, cubic = from + to - 2;
    const double t = (piece_ + x * (from + x * (square + x * cubic))) * (1.0 / pieces);
    return {t, (from + x * (2 * square + 3 * x * cubic)) * (per_whole / pieces)};
}

inline BezierStretch Bezier::stretch_to(const Place& to, const CenterSamples& samples) const noexcept {
    const double span = span_to(to), per_span = 1 / span, unit = 1 / samples.length;
    const double t = std::min(here_.t, 1.0), left = std::max(1 - here_.t, 0.0) * per_span;
    // The line is searched from two regions behind its current place on.
    const double behind = std::max(here_.t - 1 - 2 * span, 0.0);
    const glm::dvec3 end = point(1) + behind * onward_;
    // A curve that is so far behind, or so much shorter than the region, is a point to it: where the line
    // begins.
    const double curved = behind > 0 || span > 1e6 ? 0 : span;
    BezierStretch stretch;
    stretch.from.set(glm::vec3(unit * ((curved == 0 ? end : point(t)) - samples.begin)));
    stretch.linear.set(glm::vec3(unit * curved * slope(t)));
    stretch.square.set(glm::vec3(unit * curved * curved * (square_ + 3.0 * t * cubic_)));
    stretch.cubic.set(glm::vec3(unit * curved * curved * curved * cubic_));
    stretch.begin_pace =
        static_cast<float>(std::min(here_.pace * samples.length * per_span, BezierStretch::most_pace));
    stretch.end_pace =
        static_cast<float>(std::min(to.pace * samples.length * per_span, BezierStretch::most_pace));
    stretch.least = splat(static_cast<float>(std::max(-t * per_span, -1.0)));
    stretch.most = splat(static_cast<float>(std::min(left, 2.0)));
    stretch.ends = left < 2;
    // Compilers may square the line's direction before they ask whether it is near.
    stretch.end.set(stretch.ends ? glm::vec3(unit * (end - samples.begin)) : glm::vec3(0));
    stretch.onward.set(stretch.ends ? glm::vec3(unit * span * onward_) : glm::vec3(0));
    return stretch;
}

inline void Bezier::look_up(const Place& to, double length, Float4* feet) noexcept {
    constexpr int count = CenterSamples::count;
    const double per_span = 1 / span_to(to);
    float places[count];
    for (int i = 0; i < count; ++i)
        places[i] = static_cast<float>((at(gone_ + length * (i + 1) / count).t - here_.t) * per_span);
    for (int i = 0; i < CenterSamples::fours; ++i) feet[i] = simd::load4(places + std::ptrdiff_t{4} * i);
}

inline double Bezier::advance(const CenterSamples& samples) noexcept {
    constexpr int max_steps = 8;
    // Steps this small end the search: the error that remains is about their square.
    constexpr float near = 0.004f;
    constexpr int fours = CenterSamples::fours;
    const Place to = at(gone_ + samples.length);
    const BezierStretch stretch = stretch_to(to, samples);
    Vec3x4 seen[fours];
    Float4 feet[fours], squares[fours], nearest[fours];
    for (int i = 0; i < fours; ++i) {
        const Float4 shares = {0.0625f, 0.125f, 0.1875f, 0.25f};
        seen[i] = stretch.away(stretch.from, samples, i);
        feet[i] = stretch.parameters(splat(0.25f * static_cast<float>(i)) + shares) + splat(drift_);
        nearest[i] = splat(std::numeric_limits<float>::max());
    }
    // Where the curve all but stands still, guesses are too rough, and a search may end at that place.
    bool settled = false;
    bool looks_up = std::max(stretch.begin_pace, stretch.end_pace) >= BezierStretch::most_pace;
    for (int attempt = looks_up ? 1 : 0; attempt < 2 && !settled; ++attempt, looks_up = true) {
        if (looks_up) look_up(to, samples.length, feet);
        Float4 moved = splat(1);
        for (int step = 0; step < max_steps && largest(moved) > near; ++step) {
            moved = splat(0);
            for (int i = 0; i < fours; ++i) {
                const Float4 before = feet[i];
                const BezierStretch::Squares found = stretch.step(seen[i], feet[i]);
                squares[i] = found.from_feet;
                nearest[i] = min(nearest[i], found.from_curve);
                moved = max(moved, abs(feet[i] - before));
            }
        }
        settled = largest(moved) <= near;
    }
    gone_ += samples.length;
    here_ = to;
    if (!settled) {  // feet on tangents may be far from the curve, and nearer than it is
        for (int i = 0; i < fours; ++i)
            squares[i] = min(nearest[i], stretch.step(seen[i], feet[i]).from_curve);
    }
    drift_ = feet[fours - 1][3] - 1;
    Float4 worst = splat(0);
    for (int i = 0; i < fours; ++i) {
        if (stretch.ends)
            squares[i] = min(squares[i], stretch.from_line(stretch.away(stretch.end, samples, i)));
        worst = max(worst, squares[i]);
    }
    return samples.length * samples.length * static_cast<double>(largest(worst));
}

}  // namespace goffer::bend
