// SPDX-License-Identifier: MIT
#include "naive.hpp"

#include "model.hpp"

#include <goffer/paper/wrinkle.hpp>

#include <cmath>
#include <numbers>

namespace goffer::bench {

NaiveBody make_naive(std::size_t vertices) {
    const Grid grid(vertices);
    NaiveBody body;
    for (std::size_t column = 0; column < grid.columns; ++column)
        body.column_beta.push_back(grid.beta(column));
    for (std::size_t row = 0; row < grid.rows; ++row) {
        for (std::size_t column = 0; column < grid.columns; ++column) {
            const double beta = grid.beta(column);
            const double z = grid.z(row);
            body.vertices.push_back({beta, z, Grid::rho(beta, z), 1, 0, 0, static_cast<int>(column)});
        }
    }
    return body;
}

void set_amplitudes(NaiveBody& body, double angle, double direction) {
    const double kappa = angle * radius / length;
    const auto solve = [&](double beta) {
        return paper::amplitude(paper::Profile::damped, folds, length,
                                paper::squeeze(kappa, beta, direction));
    };
    constexpr double step = 1e-4;
    for (const double beta : body.column_beta) {
        body.amplitude.push_back(solve(beta));
        body.amplitude_slope.push_back((solve(beta + step) - solve(beta - step)) / (2 * step));
    }
}

void deform_naive(const NaiveBody& body, double angle, double direction, std::vector<NaivePoint>& positions) {
    const double arc_radius = length / angle - radius;
    for (std::size_t i = 0; i < body.vertices.size(); ++i) {
        const NaiveVertex& v = body.vertices[i];
        const double phi = angle * v.z / length;
        const double u = std::fabs(2 * v.z / length - 1);
        const double f = body.amplitude[static_cast<std::size_t>(v.column)] * (1 - u) *
                         std::cos(2 * std::numbers::pi * folds * u);
        const double rho = v.rho + f;
        const double toward = rho * std::cos(v.beta - direction);
        const double across = rho * std::sin(v.beta - direction);
        const double x = arc_radius - (arc_radius - toward) * std::cos(phi);
        const double z = (arc_radius - toward) * std::sin(phi);
        positions[i] = {x * std::cos(direction) - across * std::sin(direction),
                        x * std::sin(direction) + across * std::cos(direction), z};
    }
}

void deform_naive(const NaiveBody& body, double angle, double direction, std::vector<NaivePoint>& positions,
                  std::vector<NaivePoint>& normals) {
    deform_naive(body, angle, direction, positions);
    const double kappa = angle * radius / length;
    for (std::size_t i = 0; i < body.vertices.size(); ++i) {
        const NaiveVertex& v = body.vertices[i];
        const double phi = angle * v.z / length;
        const double x = 2 * v.z / length - 1;
        const double u = std::fabs(x);
        const double wave = 2 * std::numbers::pi * folds;
        const double g = (1 - u) * std::cos(wave * u);
        const double g_z =
            (x < 0 ? -1 : 1) * 2 / length * (-std::cos(wave * u) - (1 - u) * wave * std::sin(wave * u));
        const double amplitude = body.amplitude[static_cast<std::size_t>(v.column)];
        const double slope = body.amplitude_slope[static_cast<std::size_t>(v.column)];
        const double rho = v.rho + amplitude * g;
        const double c = std::cos(v.beta - direction);
        const double s = std::sin(v.beta - direction);
        const double growth = rho / v.rho;
        const double stretch = 1 - kappa - angle / length * rho * c;
        const double n = growth * stretch * v.normal_rho;
        const double b = stretch * (v.normal_beta - slope * g / v.rho * v.normal_rho);
        const double t = growth * (v.normal_z - amplitude * g_z * v.normal_rho);
        const double p = c * n - s * b;
        const double q = s * n + c * b;
        const double nx = p * std::cos(phi) + t * std::sin(phi);
        const double nz = -p * std::sin(phi) + t * std::cos(phi);
        const double inverse = 1 / std::sqrt(nx * nx + q * q + nz * nz);
        normals[i] = {inverse * (nx * std::cos(direction) - q * std::sin(direction)),
                      inverse * (nx * std::sin(direction) + q * std::cos(direction)), inverse * nz};
    }
}

}  // namespace goffer::bench
