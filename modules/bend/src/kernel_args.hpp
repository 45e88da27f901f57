// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

/// What crosses into the kernels' files: plain numbers and pointers, nothing with inline code that could be
/// compiled with one instruction set's flags and linked for another's.

namespace goffer::bend {

constexpr std::size_t amplitude_terms = 8;  ///< wrinkle_degree + 1
constexpr std::size_t arc_terms = 5;

/// One instance's numbers. The map (DESIGN's 2.1 to 2.3, eq 2-6) is evaluated in the frame of the arc's
/// middle, where the arc angle delta = alpha (z / L - 1/2) stays small, and placed in model space by `matrix`
/// and `offset`.
struct Coefficients {
    float cos_half_direction, sin_half_direction;  ///< of theta / 2
    float amplitude[amplitude_terms];              ///< A = |h| sum amplitude[n] h^(2n)
    float amplitude_slope[amplitude_terms];        ///< dA/dbeta = sign(h) h' sum amplitude_slope[n] h^(2n)
    float rise[arc_terms];   ///< L (1 - cos delta) / alpha = v^2 sum rise[n] v^(2n), v = z / L - 1/2
    float reach[arc_terms];  ///< L sin delta / alpha = v sum reach[n] v^(2n)
    int doublings;           ///< rise and reach are for alpha / 2^doublings
    float first_curvature;   ///< alpha / 2^doublings / L
    float curvature;         ///< alpha / L
    float one_minus_kappa;
    float half_radius;  ///< depth weight: inner parts lie below it
    float matrix[9];    ///< columns: middle frame's n, b, t in model space
    float offset[3];    ///< the arc's middle in model space
};

/// Rest columns and output streams of one kernel call. Streams are planar; index i of a stream is vertex i.
struct KernelArgs {
    const Coefficients* coefficients;
    const float *cos_half_beta, *sin_half_beta, *rho, *height, *wrinkle, *slope;
    const float* normal[3];
    const float* tangent[3];
    float* position_out[3];
    float* normal_out[3];
    float* tangent_out[3];
};

/// Deforms [first, last), a multiple of the kernel's width; reads a whole batch from every multiple of it.
using Kernel = void (*)(const KernelArgs& args, std::size_t first, std::size_t last);

/// One instruction set's kernels, by the streams wanted (bit 0: positions, 1: normals, 2: tangents). The
/// streaming ones write whole cache lines past the cache: their outputs are aligned to lines at `first`, and
/// the count is a multiple of a line's.
struct KernelSet {
    std::size_t width;
    Kernel by_streams[8];
    Kernel streaming[8];
};

constexpr std::size_t line_floats = 16;

}  // namespace goffer::bend
