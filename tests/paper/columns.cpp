// SPDX-License-Identifier: MIT
#include "support/worst.hpp"
#include "surface.hpp"

#include <goffer/paper/grid.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace goffer::paper;
using goffer::test::degree;
using goffer::test::tube_length;
using goffer::test::tube_radius;

namespace {

double length_of_column(const BentGrid& bent, std::uint32_t column, std::uint32_t rows) {
    double sum = 0;
    for (std::uint32_t row = 0; row + 1 < rows; ++row) {
        sum += glm::length(bent.node(column, row + 1) - bent.node(column, row));
    }
    return sum;
}

}  // namespace

TEST_CASE("P3: every column of the wrinkled base keeps its length") {
    const std::uint32_t columns = 48;
    for (const Profile profile : {Profile::damped, Profile::smooth}) {
        for (const int folds : {6, 8, 12}) {
            for (const double angle : {10.0, 30.0, 90.0, 180.0}) {
                const auto rows = static_cast<std::uint32_t>(512 * folds + 1);
                const BentGrid bent =
                    Grid({tube_length, tube_radius, folds, profile}, columns, rows).bend({angle * degree, 0});
                double worst = 0;
                for (std::uint32_t column = 0; column < columns; ++column) {
                    goffer::test::take_worst(
                        worst, std::abs(length_of_column(bent, column, rows) / tube_length - 1));
                }
                std::printf("columns, %s, k = %2d, %3.0f deg: within %.4f %%\n",
                            profile == Profile::damped ? "damped" : "smooth", folds, angle, 100 * worst);
                CHECK(worst < 1e-3);
            }
        }
    }
}

TEST_CASE("columns of the bare bend are as long as eq 9 and 10 say, the outer one keeps its length") {
    const std::uint32_t columns = 16, rows = 2001;
    const double angle = 2.5, theta = 2 * std::numbers::pi * 3 / 16;
    const BentGrid bent = Grid({tube_length, tube_radius, 0}, columns, rows).bend({angle, theta});
    for (std::uint32_t column = 0; column < columns; ++column) {
        const double q =
            squeeze(angle * tube_radius / tube_length, 2 * std::numbers::pi * column / columns, theta);
        CHECK(length_of_column(bent, column, rows) / tube_length == doctest::Approx(1 - q).epsilon(1e-6));
    }
    CHECK(length_of_column(bent, 11, rows) / tube_length == doctest::Approx(1).epsilon(1e-6));
}
