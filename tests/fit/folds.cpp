// SPDX-License-Identifier: MIT
#include "support/rounds.hpp"
#include "synthetic.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace goffer;
using test::capacity;
using test::Recipe;
using test::Solid;
using test::soup;

namespace {

fit::Cylinder base(double length, double radius) {
    fit::Cylinder cylinder;
    cylinder.length = length;
    cylinder.radius = radius;
    return cylinder;
}

}  // namespace

TEST_CASE("16 k + 1 uniform rows carry exactly k folds, one row less does not") {
    std::mt19937 random(11);
    for (const int folds : {1, 2, 3, 5, 8, 12}) {
        for (const bool closed : {false, true}) {
            const Recipe recipe{.columns = 24, .rows = 16 * folds, .length = 12, .closed = closed};
            const Recipe less{.columns = 24, .rows = 16 * folds - 1, .length = 12, .closed = closed};
            for (int i = 0; i < test::rounds(5, 1); ++i) {
                const test::Placing placing = test::random_placing(120, random);
                CHECK(capacity(test::placed(test::cylinder(recipe, random), placing)) == folds);
                CHECK(capacity(test::placed(test::cylinder(less, random), placing)) == folds - 1);
            }
        }
    }
}

TEST_CASE("capacity does not care for the order of triangles or shared vertices") {
    std::mt19937 random(12);
    const Solid solid = test::cylinder({.columns = 24, .rows = 64, .length = 12}, random);
    CHECK(capacity(soup(solid)) == 4);
}

TEST_CASE("a long stretch without rows carries no fold, one coarse sliver does not matter") {
    std::mt19937 random(13);
    Solid bottle = test::cylinder({.columns = 24, .rows = 160, .length = 12}, random);
    CHECK(capacity(bottle) == 10);
    bottle.positions.emplace_back(1.0f, 0.0f, 0.0f);
    bottle.positions.emplace_back(0.9999f, 0.02f, 0.0f);
    bottle.positions.emplace_back(1.0f, 0.0f, 12.0f);
    const auto n = static_cast<std::uint32_t>(bottle.positions.size());
    bottle.triangles.insert(bottle.triangles.end(), {n - 3, n - 2, n - 1});
    CHECK(capacity(bottle) == 10);

    // the rows between 20 % and 77 % of the height move into its ends
    for (glm::vec3& p : bottle.positions) {
        const float u = p.z / 12;
        if (u > 0.2f && u < 0.77f) p.z = u < 0.5f ? 12 * 0.2f : 12 * 0.77f;
    }
    CHECK(capacity(bottle) == 0);
}

TEST_CASE("uneven rows are judged by the coarse end") {
    std::mt19937 random(14);
    const int even = capacity(test::cylinder({.columns = 24, .rows = 160, .length = 12}, random));
    const int uneven =
        capacity(test::cylinder({.columns = 24, .rows = 160, .length = 12, .dense = 10}, random));
    CHECK(even == 10);
    CHECK(uneven < even);
}

TEST_CASE("capacity follows the given cylinder's axis") {
    std::mt19937 random(15);
    const Solid solid = test::cylinder({.columns = 24, .rows = 64, .length = 12}, random);
    CHECK(fit::folds_capacity(solid.geometry(), fit::fit_cylinder(solid.geometry(), glm::dvec3(1, 0, 0))) <
          4);
}

TEST_CASE("sensible folds are about as long as the radius") {
    CHECK(fit::sensible_folds(base(10, 1), 100) == 5);
    CHECK(fit::sensible_folds(base(10.9, 1), 100) == 5);
    CHECK(fit::sensible_folds(base(11.1, 1), 100) == 6);
    CHECK(fit::sensible_folds(base(3, 1), 100) == 2);
    CHECK(fit::sensible_folds(base(0.5, 1), 100) == 0);
}

TEST_CASE("sensible folds are at most what the mesh carries, and none below half of what is wanted") {
    CHECK(fit::sensible_folds(base(10, 1), 5) == 5);
    CHECK(fit::sensible_folds(base(10, 1), 4) == 4);
    CHECK(fit::sensible_folds(base(10, 1), 3) == 3);
    CHECK(fit::sensible_folds(base(10, 1), 2) == 0);
    CHECK(fit::sensible_folds(base(10, 1), 0) == 0);
    CHECK(fit::sensible_folds(base(10, 1), -3) == 0);
    CHECK(fit::sensible_folds(base(1e300, 1e-300), std::numeric_limits<int>::max()) > 0);
}
