// SPDX-License-Identifier: MIT
#include "surface.hpp"

#include <goffer/paper/grid.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <stdexcept>

using namespace goffer::paper;
using goffer::test::tube_length;
using goffer::test::tube_radius;

namespace {

std::vector<Cylindrical> vertices(int count) {
    std::mt19937 engine(3);
    const auto in = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine);
    };
    std::vector<Cylindrical> made;
    for (int i = 0; i < count; ++i) made.push_back({in(-7, 7), in(0, tube_length), in(0.2, 1.4)});
    return made;
}

struct Error {
    double largest = 0;
    double mean_square = 0;
};

Error merge_error(const Parameters& body, const Pose& pose, std::uint32_t columns, std::uint32_t rows) {
    static const std::vector<Cylindrical> sample = vertices(6000);
    const Grid grid(body, columns, rows);
    const BentGrid bent = grid.bend(pose);
    const ClosedForm map(body, pose);
    Error error;
    for (const Cylindrical& v : sample) {
        const double miss = glm::length(bent.position(grid.bind(v)) - map.position(v));
        error.largest = std::max(error.largest, miss);
        error.mean_square += miss * miss / static_cast<double>(sample.size());
    }
    return error;
}

// Observed order of convergence in the largest and in the mean error.
Error order(const char* name, const Parameters& body, const Pose& pose, std::uint32_t odd) {
    const Error coarse = merge_error(body, pose, 128, 512 + odd),
                fine = merge_error(body, pose, 256, 1024 + odd);
    const Error found{std::log2(coarse.largest / fine.largest),
                      std::log2(coarse.mean_square / fine.mean_square) / 2};
    std::printf("merge, %-28s largest error %.1e, order %.2f; root mean square order %.2f\n", name,
                fine.largest, found.largest, found.mean_square);
    return found;
}

}  // namespace

TEST_CASE("P1: what the grid takes apart it puts together again") {
    for (const std::uint32_t columns : {3u, 8u, 33u}) {
        const Grid grid({tube_length, tube_radius, 3}, columns, 5);
        const BentGrid bent = grid.bend({0, 1});
        for (const Cylindrical& v : vertices(300)) {
            CHECK(glm::length(bent.position(grid.bind(v)) - from_cylindrical(v)) < 1e-14 * tube_length);
        }
        const Cylindrical beyond{0.3, 1.1 * tube_length, 0.5};
        CHECK(glm::length(bent.position(grid.bind(beyond)) - from_cylindrical(beyond)) < 1e-14 * tube_length);
    }
}

TEST_CASE("nodes of the grid lie on the closed form") {
    const Parameters body{tube_length, tube_radius, 3};
    const Pose pose{1.2, 0.7};
    const BentGrid bent = Grid(body, 12, 9).bend(pose);
    const ClosedForm map(body, pose);
    for (std::uint32_t column = 0; column < 12; ++column) {
        for (std::uint32_t row = 0; row < 9; ++row) {
            const Cylindrical v{2 * std::numbers::pi * column / 12, tube_length * row / 8, tube_radius};
            CHECK(glm::length(bent.node(column, row) - map.position(v)) < 1e-14 * tube_length);
        }
    }
}

TEST_CASE("a grid of a larger body is larger") {
    constexpr double scale = 4;
    const Pose pose{1.2, 0.7};
    const Grid grid({tube_length, tube_radius, 3}, 12, 33),
        large_grid({scale * tube_length, scale * tube_radius, 3}, 12, 33);
    const BentGrid bent = grid.bend(pose), large = large_grid.bend(pose);
    for (const Cylindrical& v : vertices(300)) {
        const Cylindrical large_v{v.beta, scale * v.z, scale * v.rho};
        CHECK(glm::length(large.position(large_grid.bind(large_v)) - scale * bent.position(grid.bind(v))) <
              1e-13 * tube_length);
    }
}

TEST_CASE("the merge converges to the closed form with the square of the cell size") {
    const double on_column = 2 * std::numbers::pi * 5 / 128;
    const Parameters smooth{tube_length, tube_radius, 3, Profile::smooth},
        damped{tube_length, tube_radius, 3, Profile::damped};
    CHECK(order("smooth, column on outer line", smooth, {1.5, on_column}, 1).largest > 1.8);
    CHECK(order("damped, rings on the creases", damped, {1.5, on_column}, 1).largest > 1.8);
}

TEST_CASE("where a crease cuts cells the merge still converges, with the first order there") {
    const Parameters smooth{tube_length, tube_radius, 3, Profile::smooth},
        damped{tube_length, tube_radius, 3, Profile::damped};
    const double off_column = 2 * std::numbers::pi * 5.3 / 128;
    const Error across = order("smooth, outer line in a cell", smooth, {1.5, off_column}, 1);
    CHECK(across.largest > 0.5);
    CHECK(across.mean_square > 1.3);
    const Error along =
        order("damped, mid-height in a cell", damped, {1.5, 2 * std::numbers::pi * 5 / 128}, 0);
    CHECK(along.largest > 0.8);
    CHECK(along.mean_square > 1.3);
}

TEST_CASE("grids and vertices that make no sense are refused") {
    CHECK_THROWS_AS(Grid({tube_length, tube_radius, 3}, 2, 5), std::invalid_argument);
    CHECK_THROWS_AS(Grid({tube_length, tube_radius, 3}, 5, 1), std::invalid_argument);
    CHECK_THROWS_AS(Grid({-1, tube_radius, 3}, 5, 5), std::invalid_argument);
    const Grid grid({tube_length, tube_radius, 3}, 5, 5);
    CHECK_THROWS_AS(static_cast<void>(grid.bind({0, std::numeric_limits<double>::infinity(), 1})),
                    std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(grid.bend({6, 0})), std::invalid_argument);
}
