// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>

#include <cstddef>
#include <vector>

/// What is measured: one soft body, as goffer holds it and as a programmer would hold it who types the paper
/// in.

namespace goffer::bench {

/// The size that the method's table is made for: L / r = 10, five folds.
inline constexpr double length = 10;
inline constexpr double radius = 1;
inline constexpr int folds = 5;

/// A bumpy cylinder of about `vertices` vertices, rows four times as many as columns.
[[nodiscard]] bend::Body make_body(std::size_t vertices);

/// A vertex in the paper's terms, as an array of structs in double holds it.
struct NaiveVertex {
    double beta, z, rho;
    double normal_rho, normal_beta, normal_z;
    int column;
};

struct NaivePoint {
    double x, y, z;
};

/// The same body, its amplitudes tabled per column.
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
