// SPDX-License-Identifier: MIT
#pragma once

#include "kernel/rest_columns.hpp"

#include <goffer/bend/method.hpp>

#include <cstddef>

/// What crosses into the kernels' files: plain numbers and pointers, nothing with inline code that could be
/// compiled with one instruction set's flags and linked for another's.

/// On a kernel: one loop without calls. Not for sanitizers, which take minutes to compile such a thing.
#if defined(GOFFER_SANITIZED) || !defined(__GNUC__)
#define GOFFER_FLATTENED
#else
#define GOFFER_FLATTENED [[gnu::flatten]]
#endif

namespace goffer::bend {

/// Floats in a cache line.
constexpr std::size_t line_floats = 16;

/// Vertices that a kernel works on at a time at most: it may write so many beyond the end of a stage.
constexpr std::size_t largest_unit = 32;

/// Where wrinkles come from: each has kernels of its own.
enum class Squeeze : unsigned char {
    none,      ///< no wrinkles
    plain,     ///< q = kappa T
    relative,  ///< against the rest arc, and with an onset: see WrinkleTable
};
constexpr std::size_t squeeze_count = 3;

/// What a kernel makes.
enum class StreamSet : unsigned char {
    positions,
    positions_normals,
    positions_normals_tangents,
    packed,  ///< PackedVertex's three words, as if they were floats
};
constexpr std::size_t stream_set_count = 4;

/// How a kernel writes.
enum class Write : unsigned char {
    cached,        ///< the values asked for and no others
    non_temporal,  ///< the same, whole lines past the cache, and not fenced
    staged,        ///< whole units: up to largest_unit values beyond the end may be overwritten
};

constexpr std::size_t amplitude_terms = wrinkle_degree + 1;
constexpr std::size_t arc_terms = 4;

/// One region's numbers in one instance. The map (eq 2-6) is evaluated in the frame of the arc's middle,
/// where the arc angle delta = alpha (z / L - 1/2) stays small, and placed in the streams' space by `matrix`
/// and `offset`. In rows of four floats, which is how set-up writes them.
/// See modules/paper/README.md, "Bend".
struct alignas(16) Coefficients {
    float cos_half_direction, sin_half_direction;  ///< of theta / 2
    float one_minus_kappa;
    float curvature;          ///< alpha / L
    float arc_z[arc_terms];   ///< L sin delta / alpha = v sum arc_z[n] v^(2n), v = z / L - 1/2
    float arc_x[arc_terms];   ///< L (1 - cos delta) / alpha = v^2 sum arc_x[n] v^(2n)
    float first_curvature;    ///< alpha / 2^doublings / L
    float doublings;          ///< arc_x and arc_z are for alpha / 2^doublings
    float half_radius;        ///< depth weight: inner parts lie below it
    float handedness;         ///< -1 where `matrix` mirrors, else 1
    float matrix[12];         ///< columns of four, the last 0: middle frame's n, b, t in the streams' space
    float offset[4];          ///< the arc's middle in the streams' space
    float normal_matrix[12];  ///< as `matrix`: its cofactors, to scale and facing outward
    /// A = |h| sum amplitude[n] T^n, dA/dbeta = sign(h) h' sum amplitude_slope[n] T^n; relative, with
    /// x = q^2 / (q + onset): A / S_0 = sqrt(x) sum amplitude[n] x^n, its slope over sqrt(x) likewise.
    float amplitude[amplitude_terms];
    float amplitude_slope[amplitude_terms];
    /// The rest is of relative squeezes alone. With u = (cos beta, sin beta): S_0 = 1 - kappa_0 - rest_curl .
    /// u, and at this pose S = S_0 - (kappa - kappa_0) - curl_change . u; so q = 1 - S / S_0 is squeeze[0] +
    /// squeeze[1, 2] . u / S_0.
    float cos_direction, sin_direction;  ///< of theta
    float rest_curl[2];
    float curl_change[2];
    float onset;  ///< > 0
    float unused;
    float squeeze[4];  ///< the last 0
};
static_assert(sizeof(Coefficients) == 72 * sizeof(float));

/// Where one kernel call writes planes: value j is of the j-th vertex of the call.
struct PlaneOutput {
    float* position[3];
    float* normal[3];
    float* tangent[4];
};

/// Where one kernel call writes rows: vectors, or the packed words, whose components follow each other; that
/// of the j-th vertex of the call is j * stride bytes behind the first.
struct RowOutput {
    float* position;
    float* normal;
    float* tangent;
    std::size_t position_stride, normal_stride, tangent_stride;
};

/// Deforms `count` vertices of one region from vertex `first` on; reads widest_batch rest vertices from any
/// of them. Planes begin their lines at the same vertices where Write::non_temporal.
using PlaneKernel = void (*)(const RestColumns& rest, const Coefficients& k, const PlaneOutput& out,
                             std::size_t first, std::size_t count, Write write);

/// The same to rows. Writes exactly the values asked for.
using RowKernel = void (*)(const RestColumns& rest, const Coefficients& k, const RowOutput& out,
                           std::size_t first, std::size_t count);

/// The same to records without gaps, of the vectors that the kernel makes and no others: lines of a single
/// stream that begins at `record`. Write::non_temporal: from the first line on that begins with a vertex,
/// `peeled` vertices behind.
using WeavingKernel = void (*)(const RestColumns& rest, const Coefficients& k, float* record,
                               std::size_t first, std::size_t count, Write write, std::size_t peeled);

/// Writes records of as many floats as there are planes, `lines` times 16 of them. `non_temporal`: past the
/// cache, and not fenced; `to` then begins a line.
using Weave = void (*)(const float* const* planes, std::size_t lines, float* to, bool non_temporal);

/// Most floats of a record that is woven.
constexpr std::size_t most_woven = 13;

/// Copies `count` floats. `non_temporal`: whole lines past the cache, and not fenced.
using CopyLines = void (*)(const float* from, float* to, std::size_t count, bool non_temporal);

/// Instances that are set up together.
constexpr std::size_t setup_width = 16;

/// A region as set-up reads it.
struct SetupRegion {
    float length, per_length, radius, max_angle;
    const float (*rows)[amplitude_terms];  ///< of the wrinkle table; null where there is none
    std::size_t row_count;
    float table_max_angle;
    bool relative;
    float onset, rest_angle, rest_direction;  ///< relative: the direction within -pi..pi
};

/// What up to setup_width instances are set up from, one value per instance; those that are not used must be
/// finite.
struct SetupColumns {
    alignas(64) float angle[setup_width];          ///< radians, finite
    alignas(64) float direction[setup_width];      ///< radians, -pi..pi
    alignas(64) float factor[setup_width];         ///< on the amplitude
    alignas(64) float transform[12][setup_width];  ///< column after column: see TransformColumn
    alignas(64) float frame[12][setup_width];  ///< e1, e2, e3, origin of the region; set to the next one's
};

/// Makes the coefficients of one region of `count` instances: everything in the map that depends on the pose
/// and not on the vertex. Those of instance i go to k + i * step. The amplitude's only where `wrinkled[i]`.
using Setup = void (*)(const SetupRegion& region, SetupColumns& columns, std::size_t count,
                       const bool* wrinkled, Coefficients* k, std::size_t step);

/// One instruction set's kernels.
struct KernelSet {
    PlaneKernel planes[squeeze_count][stream_set_count];
    RowKernel rows[squeeze_count][stream_set_count];
    WeavingKernel weaving[squeeze_count][stream_set_count];  ///< null where there is none
    Weave weave[most_woven + 1];  ///< by the floats of a record; null where there is none
    CopyLines copy_lines;
    Setup setup;

    [[nodiscard]] PlaneKernel plane_kernel(Squeeze squeeze, StreamSet streams) const noexcept {
        return planes[static_cast<unsigned char>(squeeze)][static_cast<unsigned char>(streams)];
    }
    [[nodiscard]] RowKernel row_kernel(Squeeze squeeze, StreamSet streams) const noexcept {
        return rows[static_cast<unsigned char>(squeeze)][static_cast<unsigned char>(streams)];
    }
    [[nodiscard]] WeavingKernel weaving_kernel(Squeeze squeeze, StreamSet streams) const noexcept {
        return weaving[static_cast<unsigned char>(squeeze)][static_cast<unsigned char>(streams)];
    }
};

}  // namespace goffer::bend
