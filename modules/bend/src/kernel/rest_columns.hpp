// SPDX-License-Identifier: MIT
#pragma once

namespace goffer::bend {

/// The columns of a body, one value per vertex, as plain pointers for the kernels. S is the scale of a
/// vertex's column at rest, s the radius about the vertex over that of its region; in regions that do not
/// compare_with_rest, S stands for sqrt(s). For g and w see modules/paper/README.md, "Wrinkle", for s and D
/// "Shaped bodies".
struct RestColumns {
    const float* cos_half_beta = nullptr;  ///< sqrt(2) cos(beta / 2)
    const float* sin_half_beta = nullptr;  ///< sqrt(2) sin(beta / 2)
    const float* rho = nullptr;
    const float* radial_offset = nullptr;  ///< g w S: rho' = rho + amplitude * radial_offset
    const float* height = nullptr;         ///< z / L - 1/2, of its region
    const float* wrinkle = nullptr;        ///< g w S / rho
    const float* slope = nullptr;          ///< d(g w S) / dz; without relative squeezes sqrt(s) d(g w) / dz
    const float* normal[3] = {};           ///< along e_rho, e_beta, e_z
    const float* tangent[3] = {};          ///< likewise; null if the body has no tangents, as is tangent_sign
    const float* tangent_sign = nullptr;
    /// These three are null unless the body has a shape.
    const float* scale = nullptr;  ///< s
    const float* drift = nullptr;  ///< D / L
    /// g w (ds / dz) / s, times -1 in regions that compare_with_rest, and times sqrt(s) in others.
    const float* taper = nullptr;
    /// These five are null unless a region of the body compares_with_rest.
    const float* cos_beta = nullptr;
    const float* sin_beta = nullptr;
    const float* rest_cosine = nullptr;  ///< s cos(beta) / S
    const float* rest_sine = nullptr;    ///< s sin(beta) / S
    const float* rest_scale = nullptr;   ///< s / S
};

}  // namespace goffer::bend
