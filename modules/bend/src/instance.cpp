// SPDX-License-Identifier: MIT
#include "instance.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace goffer::bend {
namespace {

// Polynomials in x = delta^2 on |delta| <= pi/2, at Chebyshev's points, first coefficient exact.
constexpr double sinc_terms[arc_terms] = {1.0, -0.16666665963821187, 0.00833324213509693,
                                          -0.00019822739488629444,
                                          2.6347563918072004e-06};  // sin(delta) / delta, within 1.7e-8
constexpr double versine_terms[arc_terms] = {
    0.5, -0.04166666607830637, 0.0013888812551247128, -2.4786082439959972e-05,
    2.654606580554261e-07};  // (1 - cos(delta)) / delta^2, within 1.5e-9

// Beyond a half turn delta leaves the polynomials' range: they then serve a fraction of the angle, doubled
// back.
int doublings_for(double alpha) noexcept {
    int count = 0;
    for (; alpha > std::numbers::pi * (1 + 1e-9); alpha /= 2) ++count;
    return count;
}

void set_arc(Coefficients& k, double alpha, double length) noexcept {
    k.doublings = doublings_for(alpha);
    const double part = std::ldexp(alpha, -k.doublings);
    k.first_curvature = static_cast<float>(part / length);
    k.curvature = static_cast<float>(alpha / length);
    double power = length;
    for (std::size_t n = 0; n < arc_terms; ++n) {
        k.reach[n] = static_cast<float>(power * sinc_terms[n]);
        k.rise[n] = static_cast<float>(power * part * versine_terms[n]);
        power *= part * part;
    }
}

void set_amplitude(Coefficients& k, const WrinkleTable& table, double alpha, double kappa) noexcept {
    const WrinkleRow row = table.at(alpha);
    const float root = static_cast<float>(std::sqrt(2 * kappa));
    for (std::size_t n = 0; n < amplitude_terms; ++n) {
        k.amplitude[n] = root * row[n];
        k.amplitude_slope[n] = -0.5f * static_cast<float>(2 * n + 1) * k.amplitude[n];
    }
}

// The middle frame: the arc's point and axes at half height, where the arc has turned by alpha / 2.
void set_frame(Coefficients& k, const Body& body, double alpha, double kappa, double sin_theta,
               double cos_theta) noexcept {
    const double half = alpha / 2;
    const double sine = std::sin(half);
    const double cosine = std::cos(half);
    const double sinc = half < 1e-4 ? 1 - half * half / 6 : sine / half;
    const double quarter = half / 2;
    const double sinc_quarter = quarter < 1e-4 ? 1 - quarter * quarter / 6 : std::sin(quarter) / quarter;
    const double arc = (1 - kappa) * body.length() / 2;
    const double out = arc * quarter * sinc_quarter * sinc_quarter;  // (1 - cos) / half, without cancelling
    const double up = arc * sinc;

    const glm::dmat3& e = body.axes();
    const glm::dvec3 towards = cos_theta * e[0] + sin_theta * e[1];
    const glm::dvec3 across = cos_theta * e[1] - sin_theta * e[0];
    const glm::dvec3 columns[3] = {cosine * towards - sine * e[2], across, sine * towards + cosine * e[2]};
    const glm::dvec3 middle = body.origin() + out * towards + up * e[2];
    for (int c = 0; c < 3; ++c) {
        for (int row = 0; row < 3; ++row) k.matrix[3 * c + row] = static_cast<float>(columns[c][row]);
        k.offset[c] = static_cast<float>(middle[c]);
    }
}

}  // namespace

Coefficients prepare(const Body& body, const Pose& pose, bool& clamped) noexcept {
    static_assert(amplitude_terms == wrinkle_degree + 1);
    Coefficients k{};
    double alpha = std::fabs(static_cast<double>(pose.angle));
    clamped = alpha > static_cast<double>(body.max_angle());
    if (clamped) alpha = static_cast<double>(body.max_angle());
    const double kappa = alpha * body.radius() / body.length();

    const double turn = pose.angle < 0 ? std::numbers::pi : 0.0;
    const double half_direction = (static_cast<double>(pose.direction) + turn) / 2;
    const double ch = std::cos(half_direction);
    const double sh = std::sin(half_direction);
    k.cos_half_direction = static_cast<float>(ch);
    k.sin_half_direction = static_cast<float>(sh);
    k.one_minus_kappa = static_cast<float>(1 - kappa);
    k.half_radius = static_cast<float>(body.radius() / 2);
    set_arc(k, alpha, body.length());
    set_amplitude(k, body.table(), alpha, kappa);
    set_frame(k, body, alpha, kappa, 2 * sh * ch, (ch - sh) * (ch + sh));
    return k;
}

}  // namespace goffer::bend
