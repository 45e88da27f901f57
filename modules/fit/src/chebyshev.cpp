// SPDX-License-Identifier: MIT
#include "chebyshev.hpp"

#include <cmath>
#include <numbers>

namespace goffer::fit {

Chebyshev::Chebyshev(double high, int points, const std::function<double(double)>& function)
    : high_(high), terms_(static_cast<std::size_t>(points), 0.0) {
    for (int i = 0; i < points; ++i) {
        const double angle = std::numbers::pi * (i + 0.5) / points;
        const double value = function(high * 0.5 * (1 + std::cos(angle)));
        for (int n = 0; n < points; ++n) {
            terms_[static_cast<std::size_t>(n)] +=
                (n == 0 ? 1.0 : 2.0) / points * value * std::cos(n * angle);
        }
    }
}

double Chebyshev::operator()(double x) const {
    const double y = 2 * x / high_ - 1;
    double b1 = 0;
    double b2 = 0;
    for (std::size_t n = terms_.size(); n-- > 1;) {
        const double b0 = 2 * y * b1 - b2 + terms_[n];
        b2 = b1;
        b1 = b0;
    }
    return y * b1 - b2 + terms_[0];
}

std::vector<double> Chebyshev::monomials() const {
    // T_n(2 t - 1) as powers of t: T_(n+1) = 2 (2 t - 1) T_n - T_(n-1).
    const std::size_t size = terms_.size();
    std::vector<double> sum(size, 0.0), previous(size, 0.0), current(size, 0.0);
    current[0] = 1;
    for (std::size_t n = 0; n < size; ++n) {
        for (std::size_t i = 0; i <= n; ++i) sum[i] += terms_[n] * current[i];
        std::vector<double> next(size, 0.0);
        const double scale = n == 0 ? 1 : 2;
        for (std::size_t i = 0; i < size; ++i) {
            next[i] -= scale * current[i] + (n == 0 ? 0 : previous[i]);
            if (i + 1 < size) next[i + 1] += 2 * scale * current[i];
        }
        previous = current;
        current = next;
    }
    return sum;
}

}  // namespace goffer::fit
