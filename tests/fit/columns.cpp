// SPDX-License-Identifier: MIT
#include "refined.hpp"
#include "support/angles.hpp"
#include "support/worst.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/fit/patches.hpp>
#include <goffer/fit/refine.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

/// What fit::refine cuts about the axis.

using namespace goffer;
using fit::Refinement;
using namespace goffer::test;

namespace {

Solid prism(int sides, int rows = 1, bool closed = true) {
    std::mt19937 random(1);
    return cylinder({.columns = sides, .rows = rows, .closed = closed}, random);
}

Solid squashed(Solid solid, float across) {
    for (glm::vec3& p : solid.positions) p.y *= across;
    return solid;
}

/// A prism that is thinner at its tip, where it is `end` as thick.
Solid tapered_prism(int sides, float end) {
    Solid solid = prism(sides);
    for (glm::vec3& p : solid.positions) {
        const float scale = 1 + (end - 1) * p.z / 10;
        p.x *= scale, p.y *= scale;
    }
    return solid;
}

Refinement rows_alone(const Solid& solid, const std::vector<fit::Stretch>& stretches) {
    return fit::refine(solid.geometry(), fit::heights(solid.positions, upright()), stretches);
}

Refinement refined_upright(const Solid& solid, const std::vector<fit::Stretch>& stretches = {{10, 6.5}}) {
    return fit::refine(solid.geometry(), upright(), stretches);
}

/// The widest edge about z between two heights, in degrees.
double widest(const Solid& solid, double low, double high) {
    double most = 0;
    for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
        const glm::dvec3 a = solid.positions[solid.triangles[t]];
        const glm::dvec3 b = solid.positions[solid.triangles[t % 3 == 2 ? t - 2 : t + 1]];
        if (std::min(a.z, b.z) < low || std::max(a.z, b.z) > high) continue;
        const double turn = std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
        test::take_worst(most, std::abs(turn) / degree);
    }
    return most;
}

/// Whether new vertices at one place are named alike, and, where that is so of the others, are one.
void check_names(const Solid& after, const Refinement& refinement, bool seams) {
    const std::size_t before = after.positions.size() - refinement.vertices.size();
    std::map<Place, std::pair<Place, Place>> ends;
    for (std::size_t i = 0; i < refinement.vertices.size(); ++i) {
        const auto& [a, b, t] = refinement.vertices[i];
        const std::pair own{place(after.positions[a]), place(after.positions[b])};
        REQUIRE(ends.try_emplace(place(after.positions[before + i]), own).first->second == own);
    }
    if (!seams) CHECK(ends.size() == refinement.vertices.size());
}

/// Deformed by 90 degrees, with wrinkles that do not depend on the mesh.
std::vector<glm::vec3> bent_at_right_angle(const Solid& solid) {
    const fit::BindOptions options{.folds = 13, .amplitude = fit::Amplitude::paper};
    const fit::Binding binding = fit::bind(solid.geometry(), upright(), options);
    REQUIRE(binding.folds() == 13);
    std::vector<glm::vec3> positions(binding.body.vertex_count());
    bend::DeformJob job{.body = &binding.body,
                        .pose = {.angle = std::numbers::pi_v<float> / 2, .direction = 0.4f}};
    job.positions = interleaved<3>(&positions[0].x, positions.size());
    bend::run(job);
    return positions;
}

/// How far edges of the deformed solid lie from where their middles are deformed to (rms).
double chord_error(Solid solid) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t t = 0; t < solid.triangles.size(); ++t)
        edges.insert(std::minmax(solid.triangles[t], solid.triangles[t % 3 == 2 ? t - 2 : t + 1]));
    const std::size_t vertices = solid.positions.size();
    for (const auto& [a, b] : edges)
        solid.positions.push_back((solid.positions[a] + solid.positions[b]) / 2.0f);
    const std::vector<glm::vec3> now = bent_at_right_angle(solid);
    double squares = 0;
    std::size_t next = vertices;
    for (const auto& [a, b] : edges) {
        const double off = static_cast<double>(glm::distance((now[a] + now[b]) / 2.0f, now[next++]));
        squares += off * off;
    }
    return std::sqrt(squares / static_cast<double>(edges.size()));
}

/// By what share the deformed solid's area differs from before, patch by patch.
std::vector<double> area_changes(const Solid& solid) {
    const fit::PatchGrid grid;
    const std::vector<std::uint32_t> patches = fit::patches_of(solid.geometry(), upright(), grid);
    const Solid now{bent_at_right_angle(solid), solid.triangles};
    const auto count = static_cast<std::size_t>(grid.slices * grid.sides);
    std::vector<double> before(count), after(count);
    for (std::size_t t = 0; t < patches.size(); ++t) {
        before[patches[t]] += glm::length(area_vector(solid, t));
        after[patches[t]] += glm::length(area_vector(now, t));
    }
    for (std::size_t p = 0; p < count; ++p) after[p] = after[p] / before[p] - 1;
    return after;
}

double rms_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(squares / static_cast<double>(a.size()));
}

}  // namespace

TEST_CASE("columns: few sides are cut, closed where they were, the surface as it was, and no further") {
    std::mt19937 random(41);
    for (const int sides : {3, 4, 5, 6, 8, 10}) {
        for (const int rows : {1, 5, 130}) {
            for (const bool seams : {false, true}) {
                CAPTURE(sides);
                CAPTURE(rows);
                CAPTURE(seams);
                const Solid solid = seams ? soup(prism(sides, rows)) : prism(sides, rows);
                const Refinement refinement = refined_upright(solid);
                check_refinement(solid, refinement, 1);
                const Solid after = applied(solid, refinement);
                check_names(after, refinement, seams);
                CHECK(border(after) == 0);
                CHECK(widest(after, 0.2, 9.8) < 34.01);
                CHECK(widest(applied(solid, rows_alone(solid, {{10, 6.5}})), 0.2, 9.8) > 35);
                CHECK(fit::folds_capacity(after.geometry(), upright()) >= 6);
                CHECK(refined_upright(after).vertices.empty());
                CHECK(refined_upright(after).triangles == after.triangles);
            }
        }
    }
}

TEST_CASE("columns: a hose anywhere, of any size, tapered or bent at rest, is closed and gets no more") {
    std::mt19937 random(42);
    for (const int sides : {4, 6, 8}) {
        for (const bool arc : {false, true}) {
            Solid solid = tapered_prism(sides, arc ? 1 : 0.4f);
            if (arc) {
                solid = prism(sides, 24);
                for (glm::vec3& p : solid.positions) {
                    const float turn = p.z / 10, out = 10 - p.x;
                    p = {10 - out * std::cos(turn), p.y, out * std::sin(turn)};
                }
            }
            const Placing placing = random_placing(12, random);
            solid = soup(placed(solid, placing));
            const fit::Cylinder base = fit::fit_shape(solid.geometry(), fit::fit_cylinder(solid.geometry()));
            CHECK((base.rest_angle != 0) == arc);
            const std::vector<fit::Stretch> stretches = fit::stretches_of(base, {});
            const Refinement refinement = fit::refine(solid.geometry(), base, stretches);
            check_refinement(solid, refinement, placing.scale);
            const Solid after = applied(solid, refinement);
            CHECK(border(after) == 0);
            const Refinement rows =
                fit::refine(solid.geometry(), fit::heights(solid.positions, base), stretches);
            CHECK(refinement.parents.size() > 1.2 * static_cast<double>(rows.parents.size()));
            CHECK(refinement.parents.size() < 4 * rows.parents.size());
            CHECK(fit::refine(after.geometry(), base, stretches).vertices.empty());
        }
    }
}

TEST_CASE("columns: 11 sides are enough") {
    for (const int sides : {11, 12, 24}) {
        const Solid solid = prism(sides);
        const Refinement refinement = refined_upright(solid), rows = rows_alone(solid, {{10, 6.5}});
        CHECK(refinement.vertices.size() == rows.vertices.size());
        CHECK(refinement.triangles == rows.triangles);
    }
}

TEST_CASE("columns: caps, what lies near the axis and stretches without folds stay as they are") {
    const Solid hose = prism(6);
    const Solid after = applied(hose, refined_upright(hose));
    for (std::size_t i = hose.positions.size(); i < after.positions.size(); ++i)
        REQUIRE(std::abs(after.positions[i].z - 5) < 4.95f);

    Solid rod = prism(4);
    for (glm::vec3& p : rod.positions) p.x *= 0.02f, p.y *= 0.02f;
    CHECK(refined_upright(rod).triangles == rows_alone(rod, {{10, 6.5}}).triangles);

    const std::vector<fit::Stretch> stretches{{4, 3}, {2, 0}, {4, 3}};
    const Solid rows = prism(6, 20);
    const Solid partly = applied(rows, refined_upright(rows, stretches));
    CHECK(widest(partly, 0.5, 3.99) < 34.01);
    CHECK(widest(partly, 6.01, 9.5) < 34.01);
    CHECK(widest(partly, 4.01, 5.99) > 59);
    CHECK(border(partly) == 0);
    CHECK(refined_upright(rows, {{10, 0}}).vertices.empty());
}

TEST_CASE("columns: a flat body gets few") {
    for (const float across : {0.3f, 0.02f}) {
        const Solid flat = squashed(prism(4), across);
        const Refinement refinement = refined_upright(flat), rows = rows_alone(flat, {{10, 6.5}});
        check_refinement(flat, refinement, 1);
        CHECK(border(applied(flat, refinement)) == 0);
        CHECK(refinement.parents.size() < 8 * rows.parents.size());
    }
}

TEST_CASE("columns: bent by 90 degrees, a hose of few sides lies closer to its exact image") {
    for (const int sides : {4, 6, 8}) {
        CAPTURE(sides);
        const Solid solid = prism(sides);
        const Solid rows = applied(solid, rows_alone(solid, {{10, 6.5}})),
                    all = applied(solid, refined_upright(solid));
        CHECK(chord_error(all) < (sides < 8 ? 0.65 : 0.8) * chord_error(rows));
        // The same sides, each of 12 columns.
        Solid fine = prism(12 * sides, 208);
        const double apothem = std::cos(std::numbers::pi / sides);
        for (glm::vec3& p : fine.positions) {
            const double beta = std::atan2(static_cast<double>(p.y), static_cast<double>(p.x));
            const double side = 2 * std::numbers::pi / sides;
            const double within = beta - side * (std::floor(beta / side) + 0.5);
            const auto scale = static_cast<float>(apothem / std::cos(within));
            p.x *= scale, p.y *= scale;
        }
        const std::vector<double> exact = area_changes(fine);
        const double with = rms_difference(area_changes(all), exact);
        const double without = rms_difference(area_changes(rows), exact);
        CAPTURE(with);
        CAPTURE(without);
        CHECK(with < 0.7 * without);
    }
}

TEST_CASE("columns: pieces are no slivers") {
    for (const int sides : {4, 6, 8, 10}) {
        const Solid solid = prism(sides);
        const Solid rows = applied(solid, rows_alone(solid, {{10, 6.5}})),
                    all = applied(solid, refined_upright(solid));
        const auto mean = [](const Solid& of) {
            double sum = 0;
            for (std::size_t t = 0; t < of.triangles.size() / 3; ++t) sum += quality(of, t);
            return sum / static_cast<double>(of.triangles.size() / 3);
        };
        const auto worst = [](const Solid& of) {
            double least = 1;
            for (std::size_t t = 0; t < of.triangles.size() / 3; ++t) least = std::min(least, quality(of, t));
            return least;
        };
        CHECK(mean(all) > 0.85 * mean(rows));
        CHECK(worst(all) > 0.25 * worst(rows));
    }
}

TEST_CASE("columns: there are none where they would be too many") {
    const Solid solid = prism(6);
    const std::vector<fit::Stretch> stretches{{10, 6.5}};
    const std::size_t rows = rows_alone(solid, stretches).parents.size(),
                      all = refined_upright(solid).parents.size();
    REQUIRE(rows < all);
    const auto with = [&](std::size_t most) {
        return fit::refine(solid.geometry(), upright(), stretches, {.max_triangles = most}).parents.size();
    };
    CHECK(with(all) == all);
    CHECK(with(all - 1) == rows);
    CHECK(with(rows) == rows);
    CHECK_THROWS_AS((void)with(rows - 1), fit::SizeError);
}

TEST_CASE("columns: progress goes up to all of it, and is not told too often") {
    std::vector<double> told;
    const Solid solid = prism(6, 40);
    const fit::RefineOptions options{.progress = [&](double share) { told.push_back(share); }};
    (void)fit::refine(solid.geometry(), upright(), 12, options);
    CHECK(std::ranges::is_sorted(told));
    CHECK(told.size() > 100);
    CHECK(told.size() < 400);
    CHECK(told.front() >= 0);
    CHECK(told.back() > 0.95);
    CHECK(told.back() <= 1);
}

TEST_CASE("columns: hostile meshes end, whatever crosses the axis, and do not tear") {
    std::mt19937 random(43);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::uniform_int_distribution<std::uint32_t> any(0, 19);
    for (int run = 0; run < 60; ++run) {
        CAPTURE(run);
        Solid solid;
        for (int i = 0; i < 20; ++i) {
            const float near = i % 4 == 0 ? 1e-4f : 1, flat = run % 3 == 0 ? 1e-3f : 1;
            solid.positions.emplace_back(near * uniform(random), near * flat * uniform(random),
                                         5 + 5 * uniform(random));
        }
        solid.positions[1] = {0, 0, 3};
        solid.positions[2] = {0, 0, 7};
        solid.positions[3] = solid.positions[4] = {0.5f, 0, 5};
        solid.positions[5] = {-0.5f, 0, 5};
        for (int t = 0; t < 40; ++t) {  // every triangle and its back: closed
            const std::uint32_t a = any(random), b = any(random), c = any(random);
            solid.triangles.insert(solid.triangles.end(), {a, b, c, a, c, b});
        }
        for (const std::vector<fit::Stretch>& stretches :
             {std::vector<fit::Stretch>{{10, 2}}, {{3, 1}, {4, 0}, {3, 1}}, {{5, 0}, {5, 2}}}) {
            const Refinement refinement =
                fit::refine(solid.geometry(), upright(), stretches, {.max_triangles = 1'000'000});
            check_refinement(solid, refinement, 10);
            CHECK(border(applied(solid, refinement)) == 0);
            CHECK(refinement.parents.size() > rows_alone(solid, stretches).parents.size());
            CHECK(refinement.parents.size() < 40 * rows_alone(solid, stretches).parents.size());
        }
    }
}

TEST_CASE("columns: a triangle that leans on a stretch without folds is not cut without end") {
    // Two corners at the height where the folds end, the third as close below as float has a place, where all
    // middles are rounded to.
    const float end = std::nextafter(4.0f, 5.0f);
    const Solid solid{{{1, -3, end}, {1, 3, end}, {1, 0.5f, 4}, {-1, 0, 0}, {-1, 0, 9}},
                      {0, 1, 2, 0, 2, 3, 0, 1, 4}};
    const std::vector<fit::Stretch> stretches{{static_cast<double>(end), 0.5}, {3, 0}, {3, 1}};
    const Refinement refinement = refined_upright(solid, stretches);
    check_refinement(solid, refinement, 10);
    CHECK(refinement.parents.size() > rows_alone(solid, stretches).parents.size());
    CHECK(refinement.parents.size() < 1000);
}

TEST_CASE("columns: an edge between two places next to each other in float is left as it is") {
    // A rod whose columns are as close together as float has places there, and something that is wider.
    constexpr float here = 16;
    const float next = std::nextafter(here, 17.0f);
    const Solid solid{{{here, here, 0},
                       {next, here, 5},
                       {next, next, 5},
                       {here, next, 5},
                       {here, here, 10},
                       {15, here, 2},
                       {17, here, 3},
                       {here, 17, 7}},
                      {0, 1, 2, 0, 2, 3, 1, 4, 2, 2, 4, 3, 5, 6, 7}};
    fit::Cylinder base = upright();
    const auto apart = static_cast<double>(next - here), axis = static_cast<double>(here) + apart / 2;
    base.origin = {axis, axis, 0};
    base.radius = apart;
    const Refinement refinement = fit::refine(solid.geometry(), base, std::vector<fit::Stretch>{{10, 0.5}});
    const Solid after = applied(solid, refinement);
    CHECK(!refinement.vertices.empty());
    int at_ends = 0;
    for (std::size_t i = 0; i < refinement.vertices.size(); ++i) {
        const auto& [a, b, t] = refinement.vertices[i];
        const glm::vec3& middle = after.positions[solid.positions.size() + i];
        if (middle == after.positions[a] || middle == after.positions[b]) ++at_ends;
    }
    CHECK(at_ends == 0);
}
