// SPDX-License-Identifier: MIT
#pragma once

namespace goffer::bend {

/// A body's columns, one value per vertex: plain pointers, since this crosses into the kernels' files.
struct RestColumns {
    const float* cos_half_beta = nullptr;  ///< sqrt(2) cos(beta / 2)
    const float* sin_half_beta = nullptr;  ///< sqrt(2) sin(beta / 2)
    const float* rho = nullptr;
    const float* radial_offset =
        nullptr;  ///< g w S, S of the column at rest: rho' = rho + amplitude * radial_offset
    const float* height = nullptr;   ///< z / L - 1/2, of its region
    const float* wrinkle = nullptr;  ///< g w S / rho
    const float* slope = nullptr;    ///< d(g w S) / dz
    const float* normal[3] = {};     ///< along e_rho, e_beta, e_z
    const float* tangent[3] = {};    ///< likewise; null in a body without tangents, as is tangent_sign
    const float* tangent_sign = nullptr;
    /// Null unless a region of the body compares_with_rest.
    const float* cos_beta = nullptr;
    const float* sin_beta = nullptr;
    const float* rest_cosine = nullptr;  ///< cos(beta) / S
    const float* rest_sine = nullptr;    ///< sin(beta) / S
};

}  // namespace goffer::bend
