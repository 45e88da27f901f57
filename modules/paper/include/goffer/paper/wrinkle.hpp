// SPDX-License-Identifier: MIT
#pragma once

/// The wrinkle of a squeezed column of vertices, in double: the oscillation (eq 6), the squeeze of a column
/// (eq 9, 10), and the amplitude that keeps the column's length (eq 7).
/// See modules/paper/README.md, "Wrinkle".
///
/// Chen, Fang, Yang, Li, Chen. "Local Deformation Method for Soft Cylindrical Model". Journal of System
/// Simulation 27(6), 2015, 1255-1261. Equation numbers are that paper's.
///
/// Angles are radians, lengths model units. All functions are thread-safe.

namespace goffer::paper {

/// Shape of the wrinkle along the body, as a function of u = |2 z / L - 1|: 0 at mid-height, 1 at both ends.
/// A plain value.
struct Profile {
    enum class Kind {
        damped,  ///< g(u) = (1 - u) cos(2 pi k u), the paper's. Creases at mid-height and at the ends.
        smooth,  ///< g(u) = (1 - u^2)^2 cos(2 pi k u). No crease along the body.
        even,  ///< g(u) = e(u) (cos(pi k u) - b cos(2 pi k u)): k folds of one depth, over the whole length,
               ///< of which e fades the first and the last. No crease along the body.
    };

    Kind kind = Kind::damped;
    /// b of `even`, 0..0.5: 0 is a plain cosine; the larger, the rounder are crests and the tighter troughs.
    double roundness = 0.25;

    static const Profile damped, smooth, even;

    /// Return the largest g, and the largest -g, of many folds.
    [[nodiscard]] constexpr double crest() const {
        if (kind != Kind::even) return 1;
        return roundness <= 0.25 ? 1 - roundness : roundness + 1 / (8 * roundness);
    }
    [[nodiscard]] constexpr double trough() const { return kind == Kind::even ? 1 + roundness : 1; }

    /// Returns how many oscillations there are from end to end: folds are counted per half length, those of
    /// `even` over all of it.
    [[nodiscard]] constexpr int folds_of_length(int folds) const {
        return kind == Kind::even ? folds : 2 * folds;
    }

    [[nodiscard]] constexpr bool operator==(const Profile&) const = default;
};

/// Which folds of a wave a region has. A wave may run on over the joints of several regions, and then fades
/// at its own two ends alone: only one of Profile::even does, which has whole folds in each region. A number
/// of folds is a wave of that region alone. A plain value.
struct FoldRange {
    int count = 0;   ///< k of the region; 0: no wrinkle
    int before = 0;  ///< folds of the same wave in the regions before
    int total = 0;   ///< of the whole wave

    constexpr FoldRange(int folds = 0) : count(folds), total(folds) {}
    constexpr FoldRange(int own, int folds_before, int folds_in_all)
        : count(own), before(folds_before), total(folds_in_all) {}

    [[nodiscard]] constexpr bool whole() const { return before == 0 && count == total; }

    /// Returns where a place is in the wave, from -1 to 1, for one that has `share` of the region's folds
    /// before it.
    [[nodiscard]] constexpr double place(double share) const {
        return whole() ? 2 * share - 1 : 2 * (before + count * share) / total - 1;
    }

    /// Returns the length of the wave, whose folds are as long as those of a region of `length`.
    [[nodiscard]] constexpr double wave_length(double length) const {
        return whole() ? length : length * total / count;
    }

    [[nodiscard]] constexpr bool operator==(const FoldRange&) const = default;
};

inline constexpr Profile Profile::damped{Profile::Kind::damped};
inline constexpr Profile Profile::smooth{Profile::Kind::smooth};
inline constexpr Profile Profile::even{Profile::Kind::even};

/// How the amplitude is chosen. See modules/paper/README.md, "Amplitude modes".
enum class Amplitude {
    none,   ///< no wrinkle: the bare bend
    paper,  ///< eq 7: every column keeps its length
    area,   ///< eq 7 times m(alpha): the lateral area of the bent, wrinkled base is 2 pi r L
    mesh,   ///< eq 7 times m(alpha, theta), solved at bind on the triangles of a mesh; in this module,
            ///< which has no mesh, as `paper`
};

/// Returns the shape g(u) of the wrinkle at u in 0..1, for `folds` k >= 1.
[[nodiscard]] double shape(Profile profile, int folds, double u);

/// Returns dg/du at u in 0..1. Where g has a crease (u = 0 and u = 1 of `damped`), it is the slope inside.
[[nodiscard]] double shape_slope(Profile profile, int folds, double u);

/// Returns the squeeze q = 1 - S = kappa (1 + cos(beta - theta)) of the column at `beta` (eq 9, 10), where
/// kappa = alpha r / L.
[[nodiscard]] double squeeze(double kappa, double beta, double theta);

/// Solves eq 7 for the relative amplitude a >= 0: the integral of sqrt(1 + a^2 g'(u)^2) over u in 0..1 is
/// 1 / (1 - q). The relative error is below 1e-12 up to a squeeze of 0.999.
/// Throws std::invalid_argument if folds < 1, the profile's roundness is not in 0..0.5, or `squeeze`
/// is not in 0 <= q < 1.
[[nodiscard]] double relative_amplitude(Profile profile, int folds, double squeeze);

/// Returns the amplitude A = (L / 2) S a of a column (eq 7), in the units of `length`. Domain and errors as
/// relative_amplitude().
[[nodiscard]] double amplitude(Profile profile, int folds, double length, double squeeze);

/// Returns the lateral area of the bent, wrinkled base cylinder as a fraction of 2 pi r L, by quadrature of
/// the map's exact Jacobian. `factor` multiplies the amplitude of eq 7; 0 is the bare bend, whose area is
/// exactly 1 - kappa. Throws std::invalid_argument if length or radius is not a finite number above 0,
/// `angle` (radians) is not in 0 <= alpha < length / (2 radius), or, with a factor other than 0, folds < 1 or
/// the profile's roundness is not in 0..0.5.
[[nodiscard]] double lateral_area(Profile profile, int folds, double length, double radius, double angle,
                                  double factor);

/// Returns the factor m(alpha), at most 1.5, with which lateral_area() is 1: that of Amplitude::area. As long
/// as the wrinkle is less deep than the radius, the area is met within 1e-7 up to six tenths of the largest
/// angle, and within 2e-6 up to all of it. At alpha = 0 the limit is returned, with N and G the integrals of
/// g^2 and g'^2 over u in 0..1:
///
///     m = 1 / sqrt(1 + (L / r)^2 N / (16 G))
///
/// This is the limit of `damped`. `smooth` has none: its mean displacement, -24 / (2 pi k)^4 of the
/// amplitude, costs area like sqrt(alpha), and drives m to 1.5 below some small angle (for L / r = 10: half a
/// degree for k = 1, 1e-5 degrees for k = 3). Errors as lateral_area(); folds < 1 is always one.
[[nodiscard]] double area_factor(Profile profile, int folds, double length, double radius, double angle);

}  // namespace goffer::paper
