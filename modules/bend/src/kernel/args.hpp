// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/kernel_input.hpp>

#include <cstddef>

/// What kernels are called with: plain numbers and pointers. Kernel files call no inline function of these
/// types, since it might be compiled with the flags of one instruction set and linked for another.

/// Inlines everything into a kernel: one loop without calls. Not with sanitizers, which take minutes to
/// compile it.
#if defined(GOFFER_SANITIZED) || !defined(__GNUC__)
#define GOFFER_FLATTENED
#else
#define GOFFER_FLATTENED [[gnu::flatten]]
#endif

namespace goffer::bend {

/// Floats in a cache line.
constexpr std::size_t line_floats = 16;

/// The most vertices that a kernel works on at a time. With Write::staged it may write that many beyond the
/// end.
constexpr std::size_t max_unit = 32;

/// What makes wrinkles. Each has kernels of its own.
enum class Squeeze : unsigned char {
    none,      ///< no wrinkles
    plain,     ///< q = kappa T
    relative,  ///< relative to the rest arc, and with an onset: see WrinkleRow
    shaped,    ///< q = kappa s T, of a body with a shape; without wrinkles too
};
constexpr std::size_t squeeze_count = 4;

/// Which vectors a kernel computes.
enum class StreamSet : unsigned char {
    positions,
    positions_normals,
    positions_normals_tangents,
    packed,  ///< the three words of PackedVertex, as the bits of floats
};
constexpr std::size_t stream_set_count = 4;

/// How a kernel writes.
enum class Write : unsigned char {
    cached,        ///< exactly the values asked for
    non_temporal,  ///< the same, whole lines past the cache; the caller must fence them
    staged,        ///< whole units: may overwrite up to max_unit values beyond the end
};

/// How the wrinkles of a region pass into those of the one beyond a joint, for vertices of that region. At
/// height v, x = at + per_height v is 0 where that begins and 1 at the joint.
struct JointBlend {
    float at, per_height;
    float per_length;  ///< dx/dz
    /// What the neighbor's amplitudes are multiplied by here, term by term: its wave over that of the region,
    /// and the radii of both, may differ. Its squeezes, where these are relative, are multiplied by the ratio
    /// of the radii.
    float gain[amplitude_terms];
    float radius_ratio;  ///< the own radius over the neighbor's
    /// Where squeezes are relative, the scale of a column in the neighbor at rest, over that in the region,
    /// is 1 + (kappa + curl . u) s / S_0, with u = (cos beta, sin beta). All are 0 where both lie on one arc.
    float rest_kappa, rest_curl[2];
};

/// Rest columns that have their wrinkles: of vertices near a joint, for kernels that add none. The first ones
/// belong to the first vertex of a call.
struct BlendColumns {
    static constexpr std::size_t vertices = 192;  ///< of a call, at most
    static constexpr std::size_t places = vertices + max_unit;
    alignas(64) float rho[places];
    alignas(64) float normal[3][places];
    alignas(64) float tangent[3][places];
};

/// The most instances that are set up together.
constexpr std::size_t setup_width = 16;

/// A number of each of many instances.
using InstanceLanes = float[setup_width];

/// The coefficients of one region of many instances.
struct LaneCoefficients : CoefficientsOf<InstanceLanes> {
    InstanceLanes most_doublings;  ///< the largest of `doublings`, in each lane
};

/// Where kernels write planes; those of vectors that a kernel does not have may be null. Kernels load several
/// of these pointers at a time, which waits for whatever was stored just before: set them once, not for each
/// call.
struct PlaneOutput {
    float* position[3];
    float* normal[3];
    float* tangent[4];
};

/// Deforms `count` vertices of one region from vertex `first` on, and writes them from vertex `out_first` of
/// the planes on. May read widest_batch rest vertices from any of them. With Write::non_temporal, all planes
/// must begin their cache lines at the same vertices.
using PlaneKernel = void (*)(const RestColumns& rest, const Coefficients& k, const PlaneOutput& out,
                             std::size_t out_first, std::size_t first, std::size_t count, Write write);

/// Deforms the line of each plane that one instance ends in and the next one begins in: `count` vertices of
/// the one from vertex `first` on, and the first ones of the other. The line begins at vertex `out_first` of
/// the planes, and goes past the cache, to be fenced by the caller.
using SharedLineKernel = void (*)(const RestColumns& rest, const Coefficients& ending,
                                  const Coefficients& beginning, const PlaneOutput& out,
                                  std::size_t out_first, std::size_t first, std::size_t count);

/// What lies between a kernel's vectors in a record.
enum class RecordGaps : unsigned char {
    none,
    one_behind_each,  ///< a float behind each vector: records of 4 or 8 floats
    two_behind_all,   ///< two floats behind a position and a normal: records of 8 floats
};

/// Where a kernel call writes records of its vectors, in their order. Those of packed vertices have no gaps.
struct RecordOutput {
    float* first;        ///< the first vertex's
    std::size_t stride;  ///< floats
    RecordGaps gaps;
    bool keeps_last_gap;  ///< of the last vertex
    std::size_t peeled;   ///< with Write::non_temporal, vertices before the first that begins a cache line
};

/// The same to records. With Write::cached, gaps keep what they hold. With Write::non_temporal they become
/// zero, and lines go past the cache, from vertex first + peeled on.
using WeavingKernel = void (*)(const RestColumns& rest, const Coefficients& k, const RecordOutput& out,
                               std::size_t first, std::size_t count, Write write);

/// The order of vectors in a record of two poses. Where there are no normals, previous_position_normal and
/// position_previous_normal stand for the order of the other two.
enum class PairOrder : unsigned char {
    previous_position_normal,
    previous_normal_position,
    position_previous_normal,
    position_normal_previous,
    normal_previous_position,
    normal_position_previous,
};

/// Where a kernel call writes records of two poses, which have no gaps.
struct PairOutput {
    float* first;  ///< the first vertex's
    PairOrder order;
    std::size_t peeled;  ///< as in RecordOutput
};

/// The same to records that also hold the positions of the pose `previous`. Both have the squeeze of the
/// kernel.
using PairKernel = void (*)(const RestColumns& rest, const Coefficients& current,
                            const Coefficients& previous, const PairOutput& out, std::size_t first,
                            std::size_t count, Write write);

/// Wrinkles `count` vertices of one region from vertex `first` on, at most BlendColumns::places, of which
/// some are near the joint that `joint` tells of. `neighbor` has what set_as_own() sets of the region beyond
/// it. Only the first `wanted` of them need be of that region: others take nothing of the neighbor. Writes
/// normals only if it is a kernel of directions, tangents only if these are wanted too. `count` is max_unit
/// or more, and no other rest vertices are read.
using BlendKernel = void (*)(const RestColumns& rest, const Coefficients& own, const Coefficients& neighbor,
                             const JointBlend& joint, std::size_t first, std::size_t count,
                             std::size_t wanted, bool tangents, BlendColumns& out);

/// Writes 16 * lines records, each of one float from every plane. `non_temporal`: past the cache, to be
/// fenced by the caller; `to` must then begin a cache line.
using Weave = void (*)(const float* const* planes, std::size_t lines, float* to, bool non_temporal);

/// The fewest and the most floats of a record that is woven.
constexpr std::size_t min_woven = 3, max_woven = 16;

/// Copies `count` floats. `non_temporal`: whole lines past the cache, to be fenced by the caller.
using CopyLines = void (*)(const float* from, float* to, std::size_t count, bool non_temporal);

/// Writes `count` rows, each of one float from every plane, `stride` bytes apart, into the cache. May read a
/// register beyond the end of planes.
using WriteRows = void (*)(const float* const* planes, std::size_t count, float* first, std::size_t stride);

/// A region as set-up reads it.
struct SetupRegion {
    float length, per_length, radius, max_angle;
    const float (*rows)[amplitude_terms];  ///< rows of the wrinkle table; null if there is none
    std::size_t row_count;
    float table_max_angle;
    bool relative;
    bool last;    ///< no region follows it
    bool shaped;  ///< kernels evaluate amplitudes even where there is no wrinkle: set-up sets them to 0
    float onset, rest_angle, rest_direction;  ///< used if relative; the direction as in SetupColumns
};

/// What up to setup_width instances are set up from, one value per instance. There are setup_width of each,
/// and unused ones must be finite.
struct SetupColumns {
    const float* angle;                            ///< radians, finite
    const float* direction;                        ///< radians, within +-max_wrapped (direction.hpp)
    const float* factor;                           ///< on the amplitude
    alignas(64) float transform[12][setup_width];  ///< the matrix, column after column
    /// e1, e2, e3 and origin of the region. Set-up replaces them by those of the next region, if one follows.
    alignas(64) float frame[12][setup_width];
};

/// Computes the coefficients of one region for `count` instances: all that depends on the pose and not on the
/// vertex. Those of instance i go to k[i * step]. Sets amplitudes where wrinkled[i]; elsewhere to 0 if the
/// region is shaped. `normals`: kernels compute more than positions; else the normal matrix is not set.
using Setup = void (*)(const SetupRegion& region, SetupColumns& columns, std::size_t count,
                       const bool* wrinkled, bool normals, Coefficients* k, std::size_t step);

/// The same of setup_width instances, for kernels that deform many at a time; unused ones are set up as well.
/// `wrinkled`: all are.
using LaneSetup = void (*)(const SetupRegion& region, SetupColumns& columns, bool wrinkled, bool normals,
                           LaneCoefficients& k);

/// Vertices in a tile, which holds some vertices of many instances: value c of vertex v is at
/// tile[c * tile_vertices + v]. Values are those of a kernel's vectors, one after the other.
constexpr std::size_t tile_vertices = line_floats;

/// Deforms the vertices [first, first + count) of all instances into the first `count` places of `tile`,
/// which may point to a later place of a tile, if there is room for them.
using LaneKernel = void (*)(const RestColumns& rest, const LaneCoefficients& k, std::size_t first,
                            std::size_t count, InstanceLanes* tile);

/// The same for vertices of which some are near the joint that `joint` tells of. `neighbor`: those
/// of the region beyond it.
using LaneBlendKernel = void (*)(const RestColumns& rest, const LaneCoefficients& own,
                                 const LaneCoefficients& neighbor, const JointBlend& joint, std::size_t first,
                                 std::size_t count, InstanceLanes* tile);

/// Writes one value of a tile, the first vertex's of which is `*value`, to a plane of each instance: that of
/// instance i begins at to[i]. Writes tile_vertices floats to each.
using Untile = void (*)(const InstanceLanes* value, float* const* to);

/// Asks for the line that holds `at`, which will be written in part.
using Prefetch = void (*)(const float* at);

/// One instruction set's kernels.
struct KernelSet {
    PlaneKernel planes[squeeze_count][stream_set_count];
    WeavingKernel weaving[squeeze_count][stream_set_count];  ///< null where there is none
    PairKernel pairs[squeeze_count][2];  ///< of positions, and of normals too; null where there is none
    BlendKernel blending[squeeze_count]
                        [2];     ///< of positions alone, and of directions too; null without wrinkles
    Weave weave[max_woven + 1];  ///< indexed by the floats of a record; null below min_woven
    CopyLines copy_lines;
    WriteRows write_rows[max_woven + 1];  ///< indexed by the floats of a row; null where there is none
    Setup setup;
    /// These are null where instances are always deformed one at a time, for packed vertices, and for
    /// blending without wrinkles.
    LaneKernel lanes[squeeze_count][stream_set_count];
    LaneBlendKernel lane_blending[squeeze_count][stream_set_count];
    LaneSetup lane_setup;
    Untile untile;
    Prefetch prefetch;
    /// Of positions, and of normals too; null where there is none.
    SharedLineKernel shared_lines[squeeze_count][2];

    [[nodiscard]] PlaneKernel plane_kernel(Squeeze squeeze, StreamSet streams) const noexcept {
        return planes[static_cast<unsigned char>(squeeze)][static_cast<unsigned char>(streams)];
    }
    [[nodiscard]] WeavingKernel weaving_kernel(Squeeze squeeze, StreamSet streams) const noexcept {
        return weaving[static_cast<unsigned char>(squeeze)][static_cast<unsigned char>(streams)];
    }
    /// Null unless `streams` are positions, with normals or without.
    [[nodiscard]] PairKernel pair_kernel(Squeeze squeeze, StreamSet streams) const noexcept {
        const bool normals = streams == StreamSet::positions_normals;
        return normals || streams == StreamSet::positions
                   ? pairs[static_cast<unsigned char>(squeeze)][normals ? 1 : 0]
                   : nullptr;
    }
    [[nodiscard]] SharedLineKernel shared_line_kernel(Squeeze squeeze, StreamSet streams) const noexcept {
        const bool normals = streams == StreamSet::positions_normals;
        return normals || streams == StreamSet::positions
                   ? shared_lines[static_cast<unsigned char>(squeeze)][normals ? 1 : 0]
                   : nullptr;
    }
    [[nodiscard]] LaneKernel lane_kernel(Squeeze squeeze, StreamSet streams) const noexcept {
        return lanes[static_cast<unsigned char>(squeeze)][static_cast<unsigned char>(streams)];
    }
    [[nodiscard]] LaneBlendKernel lane_blend_kernel(Squeeze squeeze, StreamSet streams) const noexcept {
        return lane_blending[static_cast<unsigned char>(squeeze)][static_cast<unsigned char>(streams)];
    }
    [[nodiscard]] BlendKernel blend_kernel(Squeeze squeeze, StreamSet streams) const noexcept {
        return blending[static_cast<unsigned char>(squeeze)][streams == StreamSet::positions ? 0 : 1];
    }
};

}  // namespace goffer::bend
