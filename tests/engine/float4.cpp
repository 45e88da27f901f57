// SPDX-License-Identifier: MIT
#include <goffer/simd/float4.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>

/// Four floats: the same from a register as from plain arithmetic, lane by lane.

namespace goffer::test {
namespace {

using simd::Float4;

using Lanes = std::array<float, 4>;

Lanes lanes(Float4 a) {
    Lanes result;
    simd::store4(result.data(), a);
    return result;
}

const Float4 a = {1.5f, -2, 0.25f, 7};
const Float4 b = {-3, -2, 9, 0.125f};

}  // namespace

TEST_CASE("Float4: lanes go in and out in order") {
    const Lanes from = {1, 2, 3, 4};
    CHECK(lanes(Float4{1, 2, 3, 4}) == from);
    CHECK(lanes(simd::load4(from.data())) == from);
    CHECK(lanes(simd::splat(5)) == Lanes{5, 5, 5, 5});
    CHECK(lanes(simd::load3(from.data())) == Lanes{1, 2, 3, 0});
    for (std::size_t i = 0; i < 4; ++i) CHECK(simd::load4(from.data())[i] == from[i]);
}

TEST_CASE("Float4: the first lanes are stored, and nothing behind them") {
    for (std::size_t count = 1; count <= 4; ++count) {
        Lanes to = {-1, -1, -1, -1};
        simd::store_first(to.data(), Float4{1, 2, 3, 4}, count);
        for (std::size_t i = 0; i < 4; ++i) CHECK(to[i] == (i < count ? static_cast<float>(i + 1) : -1.0f));
    }
}

TEST_CASE("Float4: arithmetic is that of its lanes") {
    Float4 product = a;
    product *= b;
    const Lanes sum = lanes(a + b), difference = lanes(a - b), times = lanes(a * b), quotient = lanes(a / b),
                negative = lanes(-a);
    const Lanes least = lanes(min(a, b)), most = lanes(max(a, b)), size = lanes(abs(a)),
                root = lanes(sqrt(abs(a)));
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(sum[i] == a[i] + b[i]);
        CHECK(difference[i] == a[i] - b[i]);
        CHECK(times[i] == a[i] * b[i]);
        CHECK(quotient[i] == a[i] / b[i]);
        CHECK(product[i] == times[i]);
        CHECK(negative[i] == -a[i]);
        CHECK(least[i] == std::fmin(a[i], b[i]));
        CHECK(most[i] == std::fmax(a[i], b[i]));
        CHECK(size[i] == std::fabs(a[i]));
        CHECK(root[i] == std::sqrt(std::fabs(a[i])));
    }
}

TEST_CASE("Float4: masks choose lanes") {
    CHECK(lanes(select(a < b, a, b)) == Lanes{-3, -2, 0.25f, 0.125f});
    CHECK(lanes(select(a > b, a, b)) == Lanes{1.5f, -2, 9, 7});
    CHECK_FALSE(any(a < a));
    CHECK_FALSE(any(a > a));
    for (std::size_t i = 0; i < 4; ++i) {
        Lanes one = {};
        one[i] = 1;
        CHECK(any(simd::load4(one.data()) > simd::splat(0)));
    }
}

TEST_CASE("Float4: vectors of three") {
    CHECK(lanes(cross(Float4{1, 0, 0, 5}, Float4{0, 1, 0, 5})) == Lanes{0, 0, 1, 0});
    CHECK(lanes(cross(Float4{2, 3, 5, 1}, Float4{7, 11, 13, 1})) == Lanes{-16, 9, 1, 0});
    CHECK(sum3(Float4{1, 2, 4, 100}) == 7);
}

TEST_CASE("Float4: rows and columns change places") {
    Float4 rows[4];
    for (std::size_t r = 0; r < 4; ++r) {
        const auto first = static_cast<float>(4 * r);
        rows[r] = {first, first + 1, first + 2, first + 3};
    }
    simd::transpose(rows);
    for (std::size_t r = 0; r < 4; ++r) {
        for (std::size_t c = 0; c < 4; ++c) CHECK(rows[r][c] == static_cast<float>(4 * c + r));
    }
}

TEST_CASE("Float4: polynomials of one value and of four are the same") {
    const float coefficients[] = {0.5f, -3, 0.25f, 2};
    const Lanes at = lanes(simd::polynomial(coefficients, a));
    for (std::size_t i = 0; i < 4; ++i) {
        const float x = a[i];
        CHECK(simd::polynomial(coefficients, x) ==
              doctest::Approx(0.5f - 3 * x + 0.25f * x * x + 2 * x * x * x));
        CHECK(at[i] == doctest::Approx(simd::polynomial(coefficients, x)));
    }
}

}  // namespace goffer::test
