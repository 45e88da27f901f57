// SPDX-License-Identifier: MIT
#include "pose/blending.hpp"

namespace goffer::bend {
namespace {

/// A column for kernels that evaluate wrinkles in any case, and are to find none.
alignas(64) constexpr float no_wrinkle[BlendColumns::places] = {};

}  // namespace

void Blending::set_columns(const RestColumns& rest, StreamSet streams, std::size_t first) noexcept {
    const auto behind = [first](const float* column) { return column == nullptr ? nullptr : column + first; };
    columns_.cos_half_beta = rest.cos_half_beta + first;
    columns_.sin_half_beta = rest.sin_half_beta + first;
    columns_.rho = blended_.rho;
    columns_.radial_offset = no_wrinkle;
    columns_.height = rest.height + first;
    columns_.wrinkle = no_wrinkle;
    columns_.slope = no_wrinkle;
    columns_.tangent_sign = behind(rest.tangent_sign);
    columns_.scale = behind(rest.scale);
    columns_.drift = behind(rest.drift);
    columns_.taper = rest.taper == nullptr ? nullptr : no_wrinkle;
    columns_.cos_beta = behind(rest.cos_beta);
    columns_.sin_beta = behind(rest.sin_beta);
    columns_.rest_cosine = behind(rest.rest_cosine);
    columns_.rest_sine = behind(rest.rest_sine);
    columns_.per_rest_scale = behind(rest.per_rest_scale);
    if (streams == StreamSet::positions) return;
    for (std::size_t c = 0; c < 3; ++c) {
        columns_.normal[c] = blended_.normal[c];
        columns_.tangent[c] = blended_.tangent[c];
    }
}

KernelInput Blending::blend(const BodyData& body, const KernelSet& kernels, std::size_t r, const Joint& joint,
                            const PosedRegions& posed, StreamSet streams, std::size_t first,
                            std::size_t count, bool in_lines) noexcept {
    // Kernels compute with whole units, the first of which may be shorter.
    const std::size_t computed =
        in_lines ? (count + max_unit - 1) / max_unit * max_unit : count + max_unit - 1;
    const bool tangents = streams == StreamSet::positions_normals_tangents;
    const Squeeze squeeze = posed.squeezes[r];
    Coefficients neighbor;
    set_as_own(posed.k[joint.neighbor], joint.blend, squeeze == Squeeze::relative, neighbor);
    kernels.blend_kernel(squeeze, streams)(body.columns, posed.k[r], neighbor, joint.blend, first, computed,
                                           count, tangents, blended_);
    set_columns(body.columns, streams, first);
    return {&columns_, &posed.k[r], squeeze == Squeeze::plain ? Squeeze::none : squeeze, 0};
}

}  // namespace goffer::bend
