// SPDX-License-Identifier: MIT
#pragma once

/// What a body keeps of a mesh: vertices and vectors in the coordinates of the base cylinder.

namespace goffer::bend {

/// One vertex at rest, in cylinder coordinates of its region. A region that is bent at rest is straightened
/// first. For g and w see modules/paper/README.md, "Wrinkle".
struct RestVertex {
    double beta = 0;  ///< direction about the axis, radians
    double z = 0;     ///< height along its region, 0..length, model units; may be off by length / 1000
    double rho = 0;   ///< distance from the axis, model units
    /// g w / rho, 1 / model units: a wrinkle of amplitude A takes the vertex to rho (1 + A wrinkle). Finite
    /// on the axis, where w / rho = 2 / (s r), with s the scale below.
    double wrinkle = 0;
    double slope = 0;  ///< d(g w) / dz, 1 / model units
    /// These three are of the body's shape at z: see modules/paper/README.md, "Shaped bodies".
    double scale = 1;        ///< s > 0: the radius there over the region's
    double scale_slope = 0;  ///< ds / dz, 1 / model units
    /// D: integral of the radius there less the region's, from 0 to z, units squared; at most length radius
    /// max_scale, either way.
    double drift = 0;
};

/// A rest normal's or tangent's components along (e_rho, e_beta, e_z) at its vertex. In a region that is bent
/// at rest, a normal is straightened by the transpose of the bend's Jacobian, a tangent by its inverse.
struct RestVector {
    double rho = 0;
    double beta = 0;
    double z = 0;
};

}  // namespace goffer::bend
