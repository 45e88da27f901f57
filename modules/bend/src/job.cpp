// SPDX-License-Identifier: MIT
#include "instance.hpp"
#include "kernels.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/engine/parallel.hpp>

#include <algorithm>
#include <cmath>

namespace goffer::bend {
namespace {

enum Streams : unsigned { positions = 1, normals = 2, tangents = 4 };

unsigned wanted(const DeformJob& job) noexcept {
    return (job.positions.empty() ? 0u : unsigned{positions}) |
           (job.normals.empty() ? 0u : unsigned{normals}) | (job.tangents.empty() ? 0u : unsigned{tangents});
}

struct StreamFaults {
    JobFault count, stride, component;
};

template <std::size_t N>
JobFault check(const Stream<N>& stream, std::size_t vertices, const StreamFaults& faults) noexcept {
    if (stream.empty()) return JobFault::none;
    for (const float* component : stream.component) {
        if (component == nullptr || reinterpret_cast<std::uintptr_t>(component) % alignof(float) != 0) {
            return faults.component;
        }
    }
    const bool together = vertices > 1 && stream.component[1] == stream.component[0] + 1;
    const std::size_t least = together ? N * sizeof(float) : sizeof(float);
    if (stream.stride < least || stream.stride % sizeof(float) != 0) return faults.stride;
    return stream.count < vertices ? faults.count : JobFault::none;
}

KernelArgs rest_columns(const Body& body, const Coefficients& coefficients) noexcept {
    KernelArgs args{};
    const auto column = [&](std::size_t index) {
        return body.column(static_cast<Body::Column>(index)).data();
    };
    args.coefficients = &coefficients;
    args.cos_half_beta = column(Body::cos_half_beta);
    args.sin_half_beta = column(Body::sin_half_beta);
    args.rho = column(Body::rho);
    args.height = column(Body::height);
    args.wrinkle = column(Body::wrinkle);
    args.slope = column(Body::slope);
    for (std::size_t c = 0; c < 3; ++c) {
        args.normal[c] = column(Body::normal_rho + c);
        args.tangent[c] = body.has_tangents() ? column(Body::tangent_rho + c) : nullptr;
    }
    return args;
}

/// A block of planar output that a kernel fills where it must not write to the caller's stream itself: for
/// interleaved streams, and for the last vertices that are fewer than a batch.
struct Block {
    static constexpr std::size_t size =
        128;  // vertices; with nine floats each it stays in the first-level cache
    alignas(column_alignment) float values[9][size];

    /// `args` with its vertices starting at `first` and all output going here.
    [[nodiscard]] KernelArgs redirect(KernelArgs args, std::size_t first) noexcept {
        for (const float** rest : {&args.cos_half_beta, &args.sin_half_beta, &args.rho, &args.height,
                                   &args.wrinkle, &args.slope, &args.normal[0], &args.normal[1],
                                   &args.normal[2], &args.tangent[0], &args.tangent[1], &args.tangent[2]}) {
            if (*rest != nullptr) *rest += first;
        }
        for (std::size_t c = 0; c < 3; ++c) {
            args.position_out[c] = values[c];
            args.normal_out[c] = values[3 + c];
            args.tangent_out[c] = values[6 + c];
        }
        return args;
    }
};

template <std::size_t N>
void copy(const float (*from)[Block::size], std::size_t count, const Stream<N>& to,
          std::size_t first) noexcept {
    if (to.empty()) return;
    for (std::size_t c = 0; c < 3; ++c) {
        std::byte* out = reinterpret_cast<std::byte*>(to.component[c]) + first * to.stride;
        for (std::size_t i = 0; i < count; ++i, out += to.stride) *reinterpret_cast<float*>(out) = from[c][i];
    }
}

void copy_signs(std::span<const float> signs, const Stream4& to, std::size_t first,
                std::size_t last) noexcept {
    for (std::size_t i = first; i < last; ++i) {
        *reinterpret_cast<float*>(reinterpret_cast<std::byte*>(to.component[3]) + i * to.stride) = signs[i];
    }
}

/// Whole batches of planar streams, straight into the caller's memory.
void run_direct(const DeformJob& job, const KernelSet& set, KernelArgs args, std::size_t first,
                std::size_t last) noexcept {
    for (std::size_t c = 0; c < 3; ++c) {
        args.position_out[c] = job.positions.component[c];
        args.normal_out[c] = job.normals.component[c];
        args.tangent_out[c] = job.tangents.component[c];
    }
    set.by_streams[wanted(job)](args, first, last);
}

/// Any streams, any count: block by block, then copied. Reads whole batches, which the padding of the columns
/// allows.
void run_blocked(const DeformJob& job, const KernelSet& set, const KernelArgs& args, std::size_t first,
                 std::size_t last) noexcept {
    Block block;
    while (first < last) {
        const std::size_t count = std::min(last - first, Block::size);
        const std::size_t batches = (count + set.width - 1) / set.width;
        set.by_streams[wanted(job)](block.redirect(args, first), 0, batches * set.width);
        copy(block.values, count, job.positions, first);
        copy(block.values + 3, count, job.normals, first);
        copy(block.values + 6, count, job.tangents, first);
        first += count;
    }
}

void run_prepared(const DeformJob& job, const Coefficients& coefficients, std::size_t first,
                  std::size_t last) noexcept {
    const KernelSet& set = kernels(job.isa);
    const KernelArgs args = rest_columns(*job.body, coefficients);
    const bool planar = (job.positions.empty() || job.positions.planar()) &&
                        (job.normals.empty() || job.normals.planar()) &&
                        (job.tangents.empty() || job.tangents.planar());
    const std::size_t direct = planar ? (last - first) / set.width * set.width : 0;
    if (direct != 0) run_direct(job, set, args, first, first + direct);
    run_blocked(job, set, args, first + direct, last);
    if (!job.tangents.empty()) copy_signs(job.body->column(Body::tangent_sign), job.tangents, first, last);
}

}  // namespace

std::string_view describe(JobFault fault) noexcept {
    switch (fault) {
        case JobFault::none:
            return "no fault";
        case JobFault::body:
            return "body: null";
        case JobFault::pose_angle:
            return "pose.angle: not finite";
        case JobFault::pose_direction:
            return "pose.direction: not finite";
        case JobFault::no_streams:
            return "positions, normals, tangents: all empty, nothing to write";
        case JobFault::positions_count:
            return "positions.count: below the body's vertex_count()";
        case JobFault::positions_stride:
            return "positions.stride: not a multiple of 4, or below 4 (12 for interleaved)";
        case JobFault::positions_component:
            return "positions.component: null, or not aligned to 4 bytes";
        case JobFault::normals_count:
            return "normals.count: below the body's vertex_count()";
        case JobFault::normals_stride:
            return "normals.stride: not a multiple of 4, or below 4 (12 for interleaved)";
        case JobFault::normals_component:
            return "normals.component: null, or not aligned to 4 bytes";
        case JobFault::tangents_count:
            return "tangents.count: below the body's vertex_count()";
        case JobFault::tangents_stride:
            return "tangents.stride: not a multiple of 4, or below 4 (16 for interleaved)";
        case JobFault::tangents_component:
            return "tangents.component: null, or not aligned to 4 bytes";
        case JobFault::body_without_tangents:
            return "tangents: asked for, but the body was bound without tangents";
        case JobFault::isa:
            return "isa: not built, or not supported by this processor";
    }
    return "unknown fault";
}

JobFault validate(const DeformJob& job) noexcept {
    if (job.body == nullptr) return JobFault::body;
    if (!std::isfinite(job.pose.angle)) return JobFault::pose_angle;
    if (!std::isfinite(job.pose.direction)) return JobFault::pose_direction;
    if (wanted(job) == 0) return JobFault::no_streams;
    const std::size_t vertices = job.body->vertex_count();
    JobFault fault =
        check(job.positions, vertices,
              {JobFault::positions_count, JobFault::positions_stride, JobFault::positions_component});
    if (fault != JobFault::none) return fault;
    fault = check(job.normals, vertices,
                  {JobFault::normals_count, JobFault::normals_stride, JobFault::normals_component});
    if (fault != JobFault::none) return fault;
    fault = check(job.tangents, vertices,
                  {JobFault::tangents_count, JobFault::tangents_stride, JobFault::tangents_component});
    if (fault != JobFault::none) return fault;
    if (!job.tangents.empty() && !job.body->has_tangents()) return JobFault::body_without_tangents;
    return runs_here(job.isa) ? JobFault::none : JobFault::isa;
}

DeformResult run_range(const DeformJob& job, std::size_t first, std::size_t last) noexcept {
    DeformResult result;
    const Coefficients coefficients = prepare(*job.body, job.pose, result.clamped);
    run_prepared(job, coefficients, first, last);
    return result;
}

DeformResult run(const DeformJob& job) noexcept {
    return run_range(job, 0, job.body->vertex_count());
}

DeformResult run_parallel(const DeformJob& job, std::size_t grain) {
    DeformResult result;
    const Coefficients coefficients = prepare(*job.body, job.pose, result.clamped);
    parallel_ranges(job.body->vertex_count(), grain, [&](std::size_t first, std::size_t last) {
        run_prepared(job, coefficients, first, last);
    });
    return result;
}

}  // namespace goffer::bend
