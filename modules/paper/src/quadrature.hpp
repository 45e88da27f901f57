// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace goffer::paper {

/// A quadrature rule on 0..1.
struct Rule {
    std::vector<double> at;
    std::vector<double> weight;
};

/// Gauss-Legendre with `order` points, exact for polynomials of degree 2 order - 1.
[[nodiscard]] Rule gauss_legendre(int order);

/// Gauss-Legendre behind the substitution t = s^2 (3 - 2 s), which draws the points toward both ends: for
/// integrands that are smooth inside but bend sharply there.
[[nodiscard]] Rule clustered(int order);

}  // namespace goffer::paper
