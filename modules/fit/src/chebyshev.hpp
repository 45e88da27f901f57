// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

/// Interpolation at Chebyshev's points: close to the best polynomial, and stable at any degree used here.

namespace goffer::fit {

/// The polynomial through `function` at `points` Chebyshev points of [0, high].
class Chebyshev {
public:
    Chebyshev(double high, int points, const std::function<double(double)>& function);

    /// Value at x in [0, high], by Clenshaw's recurrence.
    [[nodiscard]] double operator()(double x) const;

    /// Coefficients of 1, t, t^2, ... with t = x / high. For a handful of points.
    [[nodiscard]] std::vector<double> monomials() const;

private:
    double high_;
    std::vector<double> terms_;  // of T_0, T_1, ...
};

}  // namespace goffer::fit
