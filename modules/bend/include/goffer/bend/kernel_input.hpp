// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/method.hpp>
#include <goffer/engine/isa.hpp>

#include <cstddef>
#include <span>

/// What the kernels read: the columns of a body, and the coefficients of an instance. For those who evaluate
/// the map elsewhere, as goffer/gpu does in shaders: what a vertex becomes is a function of these numbers.
/// Their meaning may change with any minor version, and the version of body files with it.

namespace goffer::bend {

class Body;
struct Batch;

/// The columns of a body, arrays of one value per vertex, as plain pointers. S_0 is the scale at rest of the
/// line along the body that a vertex is on, s the radius about the vertex over that of its region. In regions
/// with neither a rest arc nor an onset, sqrt(s) stands for S_0 in the first arrays, and 1 in the last three.
/// For g and w see modules/paper/README.md, "Wrinkle", for s and D "Shaped bodies".
struct RestColumns {
    const float* cos_half_beta = nullptr;  ///< sqrt(2) cos(beta / 2)
    const float* sin_half_beta = nullptr;  ///< sqrt(2) sin(beta / 2)
    const float* rho = nullptr;
    const float* radial_offset = nullptr;  ///< g w S_0: rho' = rho + amplitude * radial_offset
    const float* height = nullptr;         ///< z / L - 1/2, of its region
    const float* wrinkle = nullptr;        ///< g w S_0 / rho
    const float* slope = nullptr;          ///< d(g w S_0) / dz; without relative squeezes sqrt(s) d(g w) / dz
    const float* normal[3] = {};           ///< along e_rho, e_beta, e_z
    const float* tangent[3] = {};          ///< likewise; null if the body has no tangents, as is tangent_sign
    const float* tangent_sign = nullptr;
    /// These three are null unless the body has a shape.
    const float* scale = nullptr;  ///< s
    const float* drift = nullptr;  ///< D / L
    /// g w (ds / dz) / s, times -1 in regions with a rest arc or an onset, and times sqrt(s) in others.
    const float* taper = nullptr;
    /// These five are null unless a region of the body has a rest arc or an onset.
    const float* cos_beta = nullptr;
    const float* sin_beta = nullptr;
    const float* rest_cosine = nullptr;     ///< s cos(beta) / S_0
    const float* rest_sine = nullptr;       ///< s sin(beta) / S_0
    const float* per_rest_scale = nullptr;  ///< s / S_0
};

inline constexpr std::size_t amplitude_terms = wrinkle_degree + 1;
inline constexpr std::size_t arc_terms = 4;

/// The numbers of one region. `Number` is a float, that of one instance; in goffer's own sources it is also
/// an array of them, one for each of many instances. The map (eq 2-6) is evaluated in the frame of the arc's
/// middle, where the arc angle delta = alpha (z / L - 1/2) stays small. `matrix` and `offset` then take it to
/// the streams' space. The numbers come in rows of four floats, which set-up stores whole. See
/// modules/paper/README.md, "Bend".
template <class Number>
struct alignas(16) CoefficientsOf {
    Number cos_half_direction, sin_half_direction;  ///< of theta / 2
    Number one_minus_kappa;
    Number curvature;          ///< alpha / L
    Number arc_z[arc_terms];   ///< L sin delta / alpha = v sum arc_z[n] v^(2n), v = z / L - 1/2
    Number arc_x[arc_terms];   ///< L (1 - cos delta) / alpha = v^2 sum arc_x[n] v^(2n)
    Number first_curvature;    ///< alpha / 2^doublings / L
    Number doublings;          ///< arc_x and arc_z are for alpha / 2^doublings
    Number half_radius;        ///< r / 2, below which the depth weight falls
    Number handedness;         ///< -1 where `matrix` mirrors, else 1
    Number matrix[12];         ///< n, b, t of the middle frame in the streams' space, each followed by a 0
    Number offset[4];          ///< the arc's middle in the streams' space
    Number normal_matrix[12];  ///< the cofactors of `matrix`, scaled and turned outward
    /// With h = sqrt(2) cos((beta - theta) / 2), h' = sqrt(2) sin((beta - theta) / 2) and T = h^2:
    /// Plain, with x = s T: A = |h| sqrt(s) sum of amplitude[n] x^n, and dA/dbeta = sign(h) h' sqrt(s) sum of
    /// amplitude_slope[n] x^n.
    /// Relative, with x = q^2 / (q + onset): A / S_0 = sqrt(x) sum of amplitude[n] x^n, and sum of
    /// amplitude_slope[n] x^n is its derivative by sqrt(x).
    Number amplitude[amplitude_terms];
    Number amplitude_slope[amplitude_terms];
    /// What follows is for squeezes that are relative to those at rest; set_up() sets it to 0 elsewhere. With
    /// u = (cos beta, sin beta), the scales of a column at rest and in the pose, and its squeeze, are
    /// - S_0 = 1 - s (kappa_0 + rest_curl . u),
    /// - S = S_0 - s (kappa_change + curl_change . u),
    /// - q = 1 - S / S_0 = (kappa_change + curl_change . u) s / S_0.
    Number cos_direction, sin_direction;  ///< of theta
    Number rest_curl[2];
    Number curl_change[2];
    Number onset;         ///< > 0; after set_up(), 0 tells that squeezes are plain
    Number kappa_change;  ///< kappa - kappa_0
};

/// The coefficients of one region of one instance.
struct Coefficients : CoefficientsOf<float> {};

/// Rows of four floats in Coefficients.
inline constexpr std::size_t coefficient_rows = 17;
static_assert(sizeof(Coefficients) == coefficient_rows * 4 * sizeof(float));

/// The columns of `body`, which is not empty. They are valid as long as the body is, and the bytes that it
/// was loaded from. Does not allocate. Thread-safe.
[[nodiscard]] RestColumns rest_columns(const Body& body) noexcept;

/// What the wrinkle of a vertex near a joint has of the region beyond: its amplitude A, and derivatives of
/// it, are A + share (A' - A). A' is the amplitude that the coefficients of that region give for s times
/// `radius_ratio`, times `gain`; a factor sqrt(s) in it is the vertex's own, without that ratio. Where
/// squeezes are relative, S_0 in A' and in its q is that of the column in that region. See
/// modules/paper/README.md, "Folds over joints".
struct NeighborShare {
    int neighbor = 0;  ///< 1: the next region, -1: the one before; 0: the vertex is near no joint
    float share = 0;   ///< 0..1/2
    float slope = 0;   ///< of the share, by z
    float gain = 1;
    float radius_ratio = 1;  ///< the radius of the vertex's region over the neighbor's
};

/// Returns the share that the neighbor has in the wrinkle of vertices of region `region` of `body`, which is
/// not empty, at `height`: RestColumns::height. Does not allocate. Thread-safe.
[[nodiscard]] NeighborShare neighbor_share(const Body& body, std::size_t region, float height) noexcept;

/// Sets up every instance of `batch`, whatever its masks say: result[i * regions + r] are the coefficients of
/// region r of instance i, at the batch's poses, transforms and wrinkle weights. Amplitudes are 0 where
/// nothing wrinkles. `result` is the caller's and holds batch.count * region_count() or more; it is written
/// in no order, and not in whole cache lines, so that a mapped buffer of a GPU is better filled by a copy.
/// Poses and weights may hold any bits, as in a run. batch.body is neither null nor empty, and batch.poses is
/// given; outputs are not read. `isa` runs here. Does not allocate. Thread-safe.
void set_up(const Batch& batch, std::span<Coefficients> result, Isa isa = Isa::automatic) noexcept;

/// The same at batch.previous_poses, which are given, and batch.previous_transforms (default: the identity).
void set_up_previous(const Batch& batch, std::span<Coefficients> result, Isa isa = Isa::automatic) noexcept;

}  // namespace goffer::bend
