// SPDX-License-Identifier: MIT
#include "quadrature.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace goffer::paper {
namespace {

struct Legendre {
    double value;
    double slope;
};

// P_n and its derivative at -1 < x < 1, by the three-term recurrence.
Legendre legendre(int order, double x) {
    double value = 1, before = 0;
    for (int j = 0; j < order; ++j) {
        const double next = ((2 * j + 1) * x * value - j * before) / (j + 1);
        before = value;
        value = next;
    }
    return {value, order * (x * value - before) / (x * x - 1)};
}

}  // namespace

Rule gauss_legendre(int order) {
    const auto count = static_cast<std::size_t>(order);
    Rule rule{std::vector<double>(count), std::vector<double>(count)};
    for (std::size_t i = 0; 2 * i < count; ++i) {
        // The well-known first guess is so near that three steps of Newton reach the last bit; one to spare.
        double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (order + 0.5));
        for (int step = 0; step < 4; ++step) {
            const Legendre p = legendre(order, x);
            x -= p.value / p.slope;
        }
        const double slope = legendre(order, x).slope;
        const double weight = 1 / ((1 - x * x) * slope * slope);
        rule.at[i] = (1 - x) / 2;
        rule.at[count - 1 - i] = (1 + x) / 2;
        rule.weight[i] = rule.weight[count - 1 - i] = weight;
    }
    return rule;
}

Rule clustered(int order) {
    Rule rule = gauss_legendre(order);
    for (std::size_t i = 0; i < rule.at.size(); ++i) {
        const double s = rule.at[i];
        rule.at[i] = s * s * (3 - 2 * s);
        rule.weight[i] *= 6 * s * (1 - s);
    }
    return rule;
}

}  // namespace goffer::paper
