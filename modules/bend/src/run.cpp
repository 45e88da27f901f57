// SPDX-License-Identifier: MIT
#include "run.hpp"

#include "kernels.hpp"
#include "streams_wanted.hpp"

#include <algorithm>
#include <cstdint>

namespace goffer::bend {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

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

bool planar(const DeformJob& job) noexcept {
    return (job.positions.empty() || job.positions.planar()) &&
           (job.normals.empty() || job.normals.planar()) && (job.tangents.empty() || job.tangents.planar());
}

void set_outputs(KernelArgs& args, const DeformJob& job) noexcept {
    for (std::size_t c = 0; c < 3; ++c) {
        args.position_out[c] = job.positions.component[c];
        args.normal_out[c] = job.normals.component[c];
        args.tangent_out[c] = job.tangents.component[c];
    }
}

/// Vertices from `first` to where every wanted plane begins a cache line, or `none` where they never do
/// together.
std::size_t to_line(const KernelArgs& args, unsigned streams, std::size_t first) noexcept {
    constexpr std::size_t line = line_floats * sizeof(float);
    std::size_t offset = line;  // none seen yet
    const float* const* planes[3] = {args.position_out, args.normal_out, args.tangent_out};
    for (unsigned stream = 0; stream < 3; ++stream) {
        if ((streams >> stream & 1) == 0) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t at = reinterpret_cast<std::uintptr_t>(planes[stream][c] + first) % line;
            if (offset != line && at != offset) return none;
            offset = at;
        }
    }
    return (line - offset) % line / sizeof(float);
}

/// Any streams, any count: block by block, then copied. Reads whole batches, which the padding of the columns
/// allows.
void run_blocked(const DeformJob& job, const KernelSet& set, const KernelArgs& args, std::size_t first,
                 std::size_t last) noexcept {
    Block block;
    while (first < last) {
        const std::size_t count = std::min(last - first, Block::size);
        const std::size_t batches = (count + set.width - 1) / set.width;
        set.by_streams[streams_wanted(job)](block.redirect(args, first), 0, batches * set.width);
        copy(block.values, count, job.positions, first);
        copy(block.values + 3, count, job.normals, first);
        copy(block.values + 6, count, job.tangents, first);
        first += count;
    }
}

/// Whole lines past the cache; what is before the first and behind the last line goes by blocks. Returns
/// whether the streams allow it.
bool run_streaming(const DeformJob& job, const KernelSet& set, const KernelArgs& args, std::size_t first,
                   std::size_t last) noexcept {
    const unsigned streams = streams_wanted(job);
    const std::size_t head = to_line(args, streams, first);
    if (head == none || last - first < head + line_floats) return false;
    const std::size_t begin = first + head;
    const std::size_t end = begin + (last - begin) / line_floats * line_floats;
    run_blocked(job, set, args, first, begin);
    set.streaming[streams](args, begin, end);
    run_blocked(job, set, args, end, last);
    return true;
}

}  // namespace

void run_prepared(const DeformJob& job, const Coefficients& coefficients, std::size_t first, std::size_t last,
                  bool streaming) noexcept {
    const KernelSet& set = kernels(job.isa);
    KernelArgs args = rest_columns(*job.body, coefficients);
    set_outputs(args, job);
    const bool direct = planar(job);
    if (!direct || !streaming || !run_streaming(job, set, args, first, last)) {
        const std::size_t batches = direct ? (last - first) / set.width * set.width : 0;
        if (batches != 0) set.by_streams[streams_wanted(job)](args, first, first + batches);
        run_blocked(job, set, args, first + batches, last);
    }
    if (!job.tangents.empty()) copy_signs(job.body->column(Body::tangent_sign), job.tangents, first, last);
}

}  // namespace goffer::bend
