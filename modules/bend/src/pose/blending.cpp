// SPDX-License-Identifier: MIT
#include "pose/blending.hpp"

#include <algorithm>

namespace goffer::bend {
namespace {

/// Coefficients for kernels that evaluate wrinkles in any case, and are to find none.
Coefficients without_wrinkles(Coefficients k) noexcept {
    std::ranges::fill(k.amplitude, 0.0f);
    std::ranges::fill(k.amplitude_slope, 0.0f);
    std::ranges::fill(k.curl_change, 0.0f);
    k.kappa_change = 0;
    return k;
}

}  // namespace

void Blending::set_columns(const RestColumns& rest, StreamSet streams, std::size_t first,
                           RestColumns& columns) const noexcept {
    const auto behind = [first](const float* column) { return column == nullptr ? nullptr : column + first; };
    columns.cos_half_beta = rest.cos_half_beta + first;
    columns.sin_half_beta = rest.sin_half_beta + first;
    columns.rho = blended_.rho;
    columns.radial_offset = rest.radial_offset + first;
    columns.height = rest.height + first;
    columns.wrinkle = rest.wrinkle + first;
    columns.slope = rest.slope + first;
    columns.tangent_sign = behind(rest.tangent_sign);
    columns.scale = behind(rest.scale);
    columns.drift = behind(rest.drift);
    columns.taper = behind(rest.taper);
    columns.cos_beta = behind(rest.cos_beta);
    columns.sin_beta = behind(rest.sin_beta);
    columns.rest_cosine = behind(rest.rest_cosine);
    columns.rest_sine = behind(rest.rest_sine);
    columns.rest_scale = behind(rest.rest_scale);
    if (streams == StreamSet::positions) return;
    for (std::size_t c = 0; c < 3; ++c) {
        columns.normal[c] = blended_.normal[c];
        columns.tangent[c] = blended_.tangent[c];
    }
}

KernelInput Blending::blend(const BodyData& body, const KernelSet& kernels, std::size_t r, const Joint& joint,
                            const PosedRegions& posed, StreamSet streams, std::size_t first,
                            std::size_t count, bool in_lines, RestColumns& columns) noexcept {
    // Kernels compute with whole units, the first of which may be shorter.
    const std::size_t computed =
        in_lines ? (count + max_unit - 1) / max_unit * max_unit : count + max_unit - 1;
    const bool tangents = streams == StreamSet::positions_normals_tangents;
    const Squeeze squeeze = posed.squeezes[r];
    const Coefficients neighbor = as_own(posed.k[joint.neighbor], joint.blend, squeeze == Squeeze::relative);
    kernels.blend_kernel(squeeze, streams)(body.columns, posed.k[r], neighbor, joint.blend, first, computed,
                                           tangents, blended_);
    set_columns(body.columns, streams, first, columns);
    if (squeeze == Squeeze::plain) return {&columns, &posed.k[r], Squeeze::none, 0};
    bare_ = without_wrinkles(posed.k[r]);
    return {&columns, &bare_, squeeze, 0};
}

}  // namespace goffer::bend
