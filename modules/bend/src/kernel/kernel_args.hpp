// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

/// What crosses into the kernels' files: plain numbers and pointers, nothing with inline code that could be
/// compiled with one instruction set's flags and linked for another's.

/// On a kernel: one loop without calls. Not for sanitizers, which take minutes to compile such a thing.
#ifdef GOFFER_SANITIZED
#define GOFFER_FLATTENED
#else
#define GOFFER_FLATTENED [[gnu::flatten]]
#endif

namespace goffer::bend {

/// Where wrinkles come from: each has kernels of its own.
enum class Squeeze : unsigned char {
    none,      ///< no wrinkles
    plain,     ///< q = kappa T
    relative,  ///< against the rest arc, and with an onset: see WrinkleTable
};
constexpr std::size_t squeeze_count = 3;

constexpr std::size_t amplitude_terms = 8;  ///< wrinkle_degree + 1
constexpr std::size_t arc_terms = 4;

/// One region's numbers in one instance. The map (DESIGN's 2.1 to 2.3, eq 2-6) is evaluated in the frame of
/// the arc's middle, where the arc angle delta = alpha (z / L - 1/2) stays small, and placed in the streams'
/// space by `matrix` and `offset`.
struct Coefficients {
    float cos_half_direction, sin_half_direction;  ///< of theta / 2
    /// A = |h| sum amplitude[n] T^n, dA/dbeta = sign(h) h' sum amplitude_slope[n] T^n; relative, with
    /// x = q^2 / (q + onset): A / S_0 = sqrt(x) sum amplitude[n] x^n, its slope over sqrt(x) likewise.
    float amplitude[amplitude_terms];
    float amplitude_slope[amplitude_terms];
    float cos_direction, sin_direction;  ///< relative: of theta
    /// Relative, with u = (cos beta, sin beta): S_0 = 1 - kappa_0 - rest_curl . u, and at this pose S = S_0 -
    /// (kappa - kappa_0) - curl_change . u; so q = 1 - S / S_0 is squeeze[0] + squeeze[1, 2] . u / S_0.
    float rest_curl[2], curl_change[2], squeeze[3];
    float onset;             ///< relative: > 0
    float rise[arc_terms];   ///< L (1 - cos delta) / alpha = v^2 sum rise[n] v^(2n), v = z / L - 1/2
    float reach[arc_terms];  ///< L sin delta / alpha = v sum reach[n] v^(2n)
    int doublings;           ///< rise and reach are for alpha / 2^doublings
    float first_curvature;   ///< alpha / 2^doublings / L
    float curvature;         ///< alpha / L
    float one_minus_kappa;
    float half_radius;  ///< depth weight: inner parts lie below it
    float matrix[12];   ///< columns of four, the last unused: middle frame's n, b, t in the streams' space
    float offset[4];    ///< the arc's middle in the streams' space
    float normal_matrix[12];  ///< as `matrix`: its cofactors, to scale and facing outwards
    float handedness;         ///< -1 where `matrix` mirrors, else 1
    Squeeze wrinkling;        ///< whose kernels are to be used
};

/// Rest columns and output streams of one kernel call. Streams are planar; index i of a stream is vertex i.
struct KernelArgs {
    const Coefficients* coefficients;
    const float *cos_half_beta, *sin_half_beta, *rho, *lift, *height, *wrinkle, *slope;
    const float *cos_beta, *sin_beta, *rest_cosine, *rest_sine;  ///< for relative squeezes only
    const float* normal[3];
    const float* tangent[3];
    float* position_out[3];
    float* normal_out[3];
    float* tangent_out[3];
    float* record_out;  ///< vertex 0's record, for kernels that write records
    std::size_t head;   ///< where they stream: vertices before the first whole line, 0 to 15
};

/// Floats in a cache line.
constexpr std::size_t line_floats = 16;

/// Deforms [first, last); reads widest_batch rest vertices from any of them. `streaming`: whole cache lines
/// are written past the cache, and not fenced; planes are then equally aligned.
using Kernel = void (*)(const KernelArgs& args, std::size_t first, std::size_t last, bool streaming);

/// Writes `lines` times 16 records of N floats, gathered from planes that are `plane_stride` floats apart.
/// `streaming`: past the cache, and not fenced; `to` is then aligned to a line.
using Interleave = void (*)(const float* planes, std::size_t plane_stride, std::size_t lines, float* to,
                            bool streaming);

/// The streams that a kernel is for: bit 0: positions, 1: normals, 2: tangents. Or the packed stream alone.
constexpr std::size_t packed_streams = 8;

/// One instruction set's kernels, by streams. Null where there is none: other streams then go through a
/// block.
struct KernelSet {
    /// To planes, by Squeeze too. Of the packed stream: PackedVertex's three words to position_out, as if
    /// they were floats.
    Kernel planes[squeeze_count][9];
    /// To records without gaps, positions first; of plain squeezes.
    Kernel records[9];
    Interleave interleave[11];  ///< by floats a record; null where there is none
};

}  // namespace goffer::bend
