// SPDX-License-Identifier: MIT
#include "refined.hpp"
#include "support/models.hpp"
#include "support/worst.hpp"

#include <goffer/fit/refine.hpp>
#include <goffer/mesh/mesh.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

using namespace goffer;
using fit::Refinement;
using namespace goffer::test;

namespace {

/// The refinement of a solid in its own fit.
Refinement refined_in_own_fit(const Solid& solid, int folds) {
    return fit::refine(solid.geometry(), fit::fit_cylinder(solid.geometry()), folds);
}

std::string refine_error(const fit::Geometry& geometry, std::span<const double> heights,
                         std::span<const fit::Stretch> stretches) {
    try {
        (void)fit::refine(geometry, heights, stretches);
    } catch (const fit::Error& error) {
        return error.what();
    }
    return {};
}

std::vector<double> heights_of(const Solid& solid) {
    std::vector<double> heights;
    for (const glm::vec3& p : solid.positions) heights.push_back(static_cast<double>(p.z));
    return heights;
}

void check_refined_model(const char* name) {
    const std::filesystem::path path = test::model(name);
    if (path.empty()) return;
    const mesh::VertexArrays records = mesh::vertex_arrays(mesh::load(path));
    const Solid solid{records.positions, records.triangles};
    const fit::Cylinder base = fit::fit_cylinder(solid.geometry());
    for (const int folds : {6, 12}) {
        const Refinement refinement = fit::refine(solid.geometry(), base, folds);
        check_refinement(solid, refinement, base.radius);
        const Solid after = applied(solid, refinement);
        CHECK((border(after) == 0) == (border(solid) == 0));
        CHECK(fit::folds_capacity(after.geometry(), base) >= folds);
        CHECK(capacity(after) >= folds);
    }
}

}  // namespace

TEST_CASE("refine: any body carries the folds asked for, closed where it was, its flat surface as it was") {
    std::mt19937 random(31);
    for (const int folds : {1, 3, 6, 13}) {
        for (const bool closed : {true, false}) {
            for (const bool seams : {true, false}) {
                const Recipe recipe{.columns = 24,
                                    .rows = 7,
                                    .length = 12,
                                    .closed = closed,
                                    .dense = 4,
                                    .jitter = 0.4,
                                    .noise = 0.05};
                const test::Placing placing = test::random_placing(12, random);
                Solid solid = test::placed(test::cylinder(recipe, random), placing);
                if (seams) solid = soup(solid);
                CAPTURE(folds);
                CAPTURE(closed);
                CAPTURE(seams);
                const Refinement refinement = refined_in_own_fit(solid, folds);
                check_refinement(solid, refinement, placing.scale);
                const Solid after = applied(solid, refinement);
                if (closed) CHECK(border(after) == 0);
                CHECK(capacity(solid) == 0);
                CHECK(capacity(after) >= folds);
            }
        }
    }
}

TEST_CASE("refine: both sides of a seam get the same bits, whichever way their triangles name the edge") {
    // The midpoints of these positions round, so that different orders of the same sum may differ.
    std::mt19937 random(32);
    std::uniform_real_distribution<float> uniform(0.1f, 1.9f);
    for (int run = 0; run < 200; ++run) {
        const glm::vec3 a(uniform(random), uniform(random), 0), b(uniform(random), uniform(random), 97.3f);
        Solid solid{{a, b, {5, 0, 40}, b, a, {-5, 1, 60}}, {0, 1, 2, 3, 4, 5}};
        if (run % 2 == 1) std::swap(solid.positions[4], solid.positions[5]);
        if (run % 2 == 1) solid.triangles = {0, 1, 2, 5, 3, 4};
        const fit::Stretch whole{97.3, 3};
        const Solid after = applied(solid, fit::refine(solid.geometry(), heights_of(solid), {&whole, 1}));
        const double sides = border(solid);
        REQUIRE(std::abs(border(after) / sides - 1) < 1e-12);
    }
}

TEST_CASE("refine: a mesh that has its rows comes back as it is") {
    std::mt19937 random(33);
    for (const int folds : {1, 4, 9}) {
        const Recipe recipe{.columns = 24, .rows = 16 * folds, .length = 12};
        const Solid solid = test::placed(test::cylinder(recipe, random), test::random_placing(3, random));
        const Refinement refinement = refined_in_own_fit(solid, folds);
        CHECK(refinement.vertices.empty());
        CHECK(refinement.triangles == solid.triangles);
    }
}

TEST_CASE("refine: as few pieces as reach over a row each") {
    std::mt19937 random(34);
    const std::size_t columns = 24;
    const Solid solid =
        test::cylinder({.columns = static_cast<int>(columns), .rows = 1, .length = 12}, random);
    for (const std::size_t folds : {1u, 2u, 5u}) {
        const Refinement refinement = refined_in_own_fit(solid, static_cast<int>(folds));
        // the lines along the axis and the diagonals between them
        CHECK(refinement.vertices.size() == 2 * columns * (16 * folds - 1));
        CHECK(refinement.parents.size() == 2 * columns + 2 * columns * (2 * 16 * folds - 1));
    }
}

TEST_CASE("refine: what is linear over the surface stays linear, to the last rounding") {
    std::mt19937 random(35);
    const Recipe recipe{.columns = 16, .rows = 3, .length = 12, .jitter = 0.4, .noise = 0.1};
    const Solid solid = test::cylinder(recipe, random);
    const Refinement refinement = refined_in_own_fit(solid, 5);
    const std::vector<glm::vec3> positions = fit::refined_positions(solid.positions, refinement);
    const auto linear = [](const glm::vec3& p) {
        return 0.3 + 1.7 * static_cast<double>(p.x) - 0.9 * static_cast<double>(p.y) +
               0.11 * static_cast<double>(p.z);
    };
    double worst = 0;
    for (std::size_t i = 0; i < refinement.vertices.size(); ++i) {
        const auto [a, b, t] = refinement.vertices[i];
        const double from = linear(positions[a]), to = linear(positions[b]);
        test::take_worst(worst,
                         std::abs(from + t * (to - from) - linear(positions[solid.positions.size() + i])));
    }
    CHECK(refinement.vertices.size() > 1000);
    CHECK(worst < 3e-7);
}

TEST_CASE("refine: pieces are no worse than the triangles that they come from") {
    std::mt19937 random(36);
    for (const int rows : {1, 3, 10}) {
        for (const double jitter : {0.0, 0.4}) {
            CAPTURE(rows);
            CAPTURE(jitter);
            const Solid solid =
                test::cylinder({.columns = 24, .rows = rows, .length = 12, .jitter = jitter}, random);
            const Refinement refinement = refined_in_own_fit(solid, 6);
            const Solid after = applied(solid, refinement);
            double worst = 1, mean_before = 0, mean_after = 0;
            for (std::size_t t = 0; t < refinement.parents.size(); ++t) {
                const double piece = quality(after, t), whole = quality(solid, refinement.parents[t]);
                worst = std::min(worst, piece / std::min(whole, 0.5));
                mean_after += piece / static_cast<double>(refinement.parents.size());
            }
            for (std::size_t t = 0; t < solid.triangles.size() / 3; ++t)
                mean_before += quality(solid, t) / static_cast<double>(solid.triangles.size() / 3);
            CHECK(worst > 0.5);
            CHECK(mean_after > 1.5 * mean_before);
            // the other diagonals would give 0.69
            if (rows == 10 && jitter == 0) CHECK(mean_after > 0.73);
        }
    }
}

TEST_CASE("refine: every stretch gets rows of its own, one without folds none") {
    std::mt19937 random(37);
    const Solid solid = test::cylinder({.columns = 20, .rows = 5, .length = 10, .jitter = 0.4}, random);
    const std::vector<fit::Stretch> stretches{{2, 1}, {3, 4}, {1.5, 0}, {3.5, 2}};
    const std::vector<double> heights = heights_of(solid);
    const Refinement refinement = fit::refine(solid.geometry(), heights, stretches);
    check_refinement(solid, refinement, 1);
    const Solid after = applied(solid, refinement);
    CHECK(border(after) == 0);
    const auto rows_of = [&](double z) {
        return 8 * std::min(z, 2.0) + 64.0 / 3 * std::clamp(z - 2, 0.0, 3.0) +
               32 / 3.5 * std::max(z - 6.5, 0.0);
    };
    double most = 0;
    for (std::size_t t = 0; t < after.triangles.size(); t += 3) {
        for (std::size_t i = 0; i < 3; ++i) {
            const float a = after.positions[after.triangles[t + i]].z;
            const float b = after.positions[after.triangles[t + (i + 1) % 3]].z;
            most =
                std::max(most, std::abs(rows_of(static_cast<double>(a)) - rows_of(static_cast<double>(b))));
        }
    }
    CHECK(most < 1.001);
    CHECK(most > 0.9);
    std::size_t inside = 0;
    for (std::size_t i = solid.positions.size(); i < after.positions.size(); ++i)
        inside += after.positions[i].z > 5.01f && after.positions[i].z < 6.49f;
    CHECK(inside == 0);
}

TEST_CASE("refine: a body's stretches are its regions, with the folds asked for or those that suit") {
    fit::Cylinder cylinder;
    cylinder.length = 20;
    cylinder.radius = 1;
    const auto folds_of = [&](const fit::BindOptions& options) {
        std::vector<std::pair<double, double>> folds;
        for (const auto& [length, count] : fit::stretches_of(cylinder, options))
            folds.emplace_back(length, count);
        return folds;
    };
    using Folds = std::vector<std::pair<double, double>>;
    const paper::Profile damped = paper::Profile::damped;
    CHECK(folds_of({.profile = damped}) == Folds{{20, 10}});
    CHECK(folds_of({.fold_length = 2, .profile = damped}) == Folds{{20, 5}});
    CHECK(folds_of({.folds = 3, .profile = damped}) == Folds{{20, 3}});
    CHECK(folds_of({.profile = damped, .regions = {{0.25, 0}, {0.75, std::nullopt}}}) ==
          Folds{{5, 0}, {15, 8}});
    CHECK(folds_of({.folds = 4, .profile = damped, .regions = {{0.25, 2}, {0.75, std::nullopt}}}) ==
          Folds{{5, 2}, {15, 4}});
    // Those of `even` are counted over the whole length.
    CHECK(folds_of({}) == Folds{{20, 20}});
    CHECK(folds_of({.fold_length = 0.75}) == Folds{{20, 13.5}});
    CHECK(folds_of({.folds = 7}) == Folds{{20, 3.5}});
}

TEST_CASE("refine: where a body has radii, its stretches have folds as long as it is thick there") {
    fit::Cylinder cone;
    cone.length = 20;
    cone.radius = 1;
    cone.radii = {1.5, 1, 0.5};
    double z = 0, unit = 0;  // length of a fold, in radii; the number of folds in a region is rounded
    for (const auto& [length, folds] :
         fit::stretches_of(cone, {.regions = {{0.25, std::nullopt}, {0.75, std::nullopt}}})) {
        const double thickness = 1.5 - (z + length / 2) / cone.length, own = length / (2 * folds * thickness);
        if (z == 0 || std::abs(z - 5) < 1e-9) unit = own;
        REQUIRE(own == doctest::Approx(unit).epsilon(1e-9));
        REQUIRE(own == doctest::Approx(0.5).epsilon(0.03));
        z += length;
    }
    CHECK(z == doctest::Approx(20));
}

TEST_CASE("refine: triangles without an area, and with three at an edge, do not tear") {
    std::mt19937 random(38);
    Solid solid = test::cylinder({.columns = 12, .rows = 2, .length = 10}, random);
    const auto extra = static_cast<std::uint32_t>(solid.positions.size());
    solid.positions.push_back({3, 0, 5});
    solid.triangles.insert(solid.triangles.end(), {0, 0, 24, 0, 24, 24, 0, 24, extra, 24, 0, extra});
    const Refinement refinement = refined_in_own_fit(solid, 4);
    check_refinement(solid, refinement, 1);
    CHECK(border(applied(solid, refinement)) == 0);
}

TEST_CASE("refine: growth has a limit, and it is named") {
    std::mt19937 random(39);
    const Solid solid = test::cylinder({.columns = 12, .rows = 2, .length = 10}, random);
    const fit::Cylinder base = fit::fit_cylinder(solid.geometry());
    const std::size_t needed = fit::refine(solid.geometry(), base, 4).parents.size();
    CHECK(fit::refine(solid.geometry(), base, 4, {.max_triangles = needed}).parents.size() == needed);
    const auto less = [&] { (void)fit::refine(solid.geometry(), base, 4, {.max_triangles = needed - 1}); };
    CHECK_THROWS_WITH_AS(less(), doctest::Contains(("more than the " + std::to_string(needed - 1)).c_str()),
                         fit::Error);
    CHECK_THROWS_WITH_AS((void)fit::refine(solid.geometry(), base, 1 << 20),
                         doctest::Contains("more than the 50000000 allowed; ask for fewer folds"),
                         fit::Error);
    const std::size_t any = std::numeric_limits<std::size_t>::max();
    CHECK_THROWS_AS(
        (void)fit::refine(solid.geometry(), {{}, {}, {}, 1e-300, 1e-301}, 1 << 20, {.max_triangles = any}),
        fit::Error);
    // Triangles without end are asked for, but 32 bits do not number so many vertices.
    const Solid wide = test::cylinder({.columns = 96, .rows = 2, .length = 10}, random);
    CHECK_THROWS_AS((void)fit::refine(wide.geometry(), base, 1 << 20, {.max_triangles = any}), fit::Error);
}

TEST_CASE("refine: bad input is named") {
    std::mt19937 random(40);
    const Solid solid = test::cylinder({.columns = 12, .rows = 2, .length = 10}, random);
    std::vector<double> heights = heights_of(solid);
    const auto told = [&](const std::vector<fit::Stretch>& stretches) {
        return refine_error(solid.geometry(), heights, stretches);
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(told({}).starts_with("stretches: there are none"));
    CHECK(told({{0, 3}}).starts_with("length is 0; give"));
    CHECK(told({{5, 3}, {nan, 3}}).starts_with("length of stretch 1 is nan"));
    CHECK(told({{5, -1}}).starts_with("folds: -1; give 0 to 1048576"));
    CHECK(told({{5, 3}, {5, (1 << 20) + 1}}).starts_with("folds of stretch 1: 1.049e+06"));
    heights[7] = nan;
    CHECK(told({{10, 3}}).starts_with("height of vertex 7 is NaN"));
    heights.pop_back();
    CHECK(told({{10, 3}}).starts_with("heights: 37 for 38 vertices"));
    fit::Cylinder base = fit::fit_cylinder(solid.geometry());
    for (const double angle : {-0.5, base.length / (2 * base.radius), 6.3, 1e300}) {
        CAPTURE(angle);
        base.rest_angle = angle;
        CHECK_THROWS_WITH_AS((void)fit::refine(solid.geometry(), base, 3), doctest::Contains("rest_angle"),
                             fit::Error);
    }
    base.rest_angle = 0;
    base.radius = -1;
    CHECK_THROWS_AS((void)fit::refine(solid.geometry(), base, 3), fit::Error);
    CHECK_THROWS_AS((void)fit::refine({solid.positions, {}}, base, 3), fit::Error);
}

TEST_CASE("refine: wine_bottle.glb carries what suits it, and what was closed is closed") {
    check_refined_model("wine_bottle.glb");
}

TEST_CASE("refine: WaterBottle.gltf carries what suits it, and what was closed is closed") {
    check_refined_model("WaterBottle.gltf");
}

TEST_CASE("refine: banana.obj carries what suits it, and what was closed is closed") {
    check_refined_model("banana.obj");
}

TEST_CASE("refine: blub_open.obj carries what suits it, and what was closed is closed") {
    check_refined_model("blub_open.obj");
}

TEST_CASE("refine: log_01.glb carries what suits it, and what was closed is closed") {
    check_refined_model("log_01.glb");
}

TEST_CASE("refine: insect_leg.glb carries what suits it, and what was closed is closed") {
    check_refined_model("insect_leg.glb");
}

TEST_CASE("refine: cushion_02.glb carries what suits it, and what was closed is closed") {
    check_refined_model("cushion_02.glb");
}

TEST_CASE("refine: fuze.ply carries what suits it, and what was closed is closed") {
    check_refined_model("fuze.ply");
}

TEST_CASE("refine: koala.obj carries what suits it, and what was closed is closed") {
    check_refined_model("koala.obj");
}

TEST_CASE("refine: lh_trochanterfemur.stl carries what suits it, and what was closed is closed") {
    check_refined_model("lh_trochanterfemur.stl");
}
