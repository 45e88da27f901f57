// SPDX-License-Identifier: MIT
#include "job/run.hpp"

#include "output/outputs.hpp"

#include <algorithm>

namespace goffer::bend {
namespace {

KernelArgs rest_columns(const Body& body, const Coefficients& coefficients, std::size_t first) noexcept {
    KernelArgs args{};
    const auto column = [&](std::size_t index) {
        return body.column(static_cast<Body::Column>(index)).data() + first;
    };
    args.coefficients = &coefficients;
    args.cos_half_beta = column(Body::cos_half_beta);
    args.sin_half_beta = column(Body::sin_half_beta);
    args.rho = column(Body::rho);
    args.lift = column(Body::lift);
    args.height = column(Body::height);
    args.wrinkle = column(Body::wrinkle);
    args.slope = column(Body::slope);
    if (coefficients.wrinkling == Squeeze::relative) {
        args.cos_beta = column(Body::cos_beta);
        args.sin_beta = column(Body::sin_beta);
        args.rest_cosine = column(Body::rest_cosine);
        args.rest_sine = column(Body::rest_sine);
    }
    for (std::size_t c = 0; c < 3; ++c) {
        args.normal[c] = column(Body::normal_rho + c);
        args.tangent[c] = body.has_tangents() ? column(Body::tangent_rho + c) : nullptr;
    }
    return args;
}

void write_signs(const PreparedPass& pass, std::size_t first, std::size_t count, float* to) noexcept {
    const float* signs = pass.job->body->column(Body::tangent_sign).data() + first;
    for (std::size_t i = 0; i < count; ++i) to[i] = pass.coefficients.handedness * signs[i];
}

/// The kernel writes the caller's planes itself.
void run_planar(const PreparedPass& pass, const Outputs& out, std::size_t first, std::size_t last,
                bool streaming) noexcept {
    KernelArgs args = rest_columns(*pass.job->body, pass.coefficients, 0);
    for (std::size_t c = 0; c < 3; ++c) {
        args.position_out[c] = out.positions.component[c];
        args.normal_out[c] = out.normals.component[c];
        args.tangent_out[c] = out.tangents.component[c];
    }
    args.head = streaming ? out.head(first) : 0;
    out.planes(args, first, last, streaming);
    if (out.tangents.floats != 0) write_signs(pass, first, last - first, out.tangents.component[3] + first);
}

/// The kernel writes the caller's records itself.
void run_dense(const PreparedPass& pass, const Outputs& out, std::size_t first, std::size_t last,
               bool streaming) noexcept {
    KernelArgs args = rest_columns(*pass.job->body, pass.coefficients, 0);
    args.record_out = out.positions.component[0];
    args.head = streaming ? out.head(first) : 0;
    const bool past = streaming && args.head != line_floats;
    if (!past) args.head = 0;
    out.records(args, first, last, past);
}

/// Any streams: the kernel fills a block of planes in the first-level cache, which is then written out.
void run_blocks(const PreparedPass& pass, const Outputs& out, const KernelSet& set, std::size_t first,
                std::size_t last, bool streaming) noexcept {
    RecordWriter writer(out, set);
    std::size_t size = writer.first_block(first, streaming);
    for (; first < last; size = RecordWriter::most_vertices) {
        const std::size_t count = std::min(last - first, size);
        KernelArgs args = rest_columns(*pass.job->body, pass.coefficients, first);
        for (std::size_t c = 0; c < 3; ++c) {
            args.position_out[c] = writer.position(c);
            args.normal_out[c] = writer.normal(c);
            args.tangent_out[c] = writer.tangent(c);
        }
        out.planes(args, 0, count, false);
        if (out.tangents.floats != 0) write_signs(pass, first, count, writer.tangent(3));
        writer.write(first, count, streaming);
        first += count;
    }
}

}  // namespace

void run_pass(const PreparedPass& pass, std::size_t first, std::size_t last, bool streaming) noexcept {
    if (first >= last) return;
    const KernelSet& set = kernels(pass.job->isa);
    const Outputs outputs = outputs_of(pass, set);
    if (outputs.planar() && (!streaming || outputs.side_by_side())) {
        run_planar(pass, outputs, first, last, streaming);
    } else if (outputs.dense()) {
        run_dense(pass, outputs, first, last, streaming);
    } else {
        run_blocks(pass, outputs, set, first, last, streaming);
    }
}

void run_block(const Body& body, const Coefficients& k, const KernelSet& set, std::size_t first,
               std::size_t count, float* planes, std::size_t stride) noexcept {
    KernelArgs args = rest_columns(body, k, first);
    for (std::size_t c = 0; c < 3; ++c) {
        args.position_out[c] = planes + c * stride;
        args.normal_out[c] = planes + (3 + c) * stride;
        args.tangent_out[c] = planes + (6 + c) * stride;
    }
    set.planes[static_cast<std::size_t>(k.wrinkling)][7](args, 0, count, false);
}

}  // namespace goffer::bend
