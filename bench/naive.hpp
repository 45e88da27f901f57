// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

/// The paper's equations as a programmer would first type them: array of structs, double, std::sin. What
/// goffer's kernels are compared with.

namespace goffer::bench {

/// A vertex in the paper's terms.
struct NaiveVertex {
    double beta, z, rho;
    double normal_rho, normal_beta, normal_z;
    int column;
};

struct NaivePoint {
    double x, y, z;
};

/// The same body as make_body's, its amplitudes tabled per column.
struct NaiveBody {
    std::vector<NaiveVertex> vertices;
    std::vector<double> column_beta;
    std::vector<double> amplitude;        // per column, for the pose at hand
    std::vector<double> amplitude_slope;  // d amplitude / d beta
};

[[nodiscard]] NaiveBody make_naive(std::size_t vertices);

/// Equations 7, 9, 10 for every column. (Not timed: the table is made before the frame.)
void set_amplitudes(NaiveBody& body, double angle, double direction);

/// Equations 2 to 6 for every vertex, as they stand in the paper.
void deform_naive(const NaiveBody& body, double angle, double direction, std::vector<NaivePoint>& positions);

/// The same with normals by the analytic Jacobian.
void deform_naive(const NaiveBody& body, double angle, double direction, std::vector<NaivePoint>& positions,
                  std::vector<NaivePoint>& normals);

}  // namespace goffer::bench
