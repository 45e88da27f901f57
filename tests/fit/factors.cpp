// SPDX-License-Identifier: MIT
#include "support/angles.hpp"
#include "support/arena.hpp"
#include "support/models.hpp"
#include "support/rounds.hpp"
#include "support/worst.hpp"
#include "synthetic.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/fit/base.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/fit/patches.hpp>
#include <goffer/fit/refine.hpp>
#include <goffer/mesh/mesh.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <numbers>
#include <optional>
#include <random>
#include <string_view>
#include <vector>

/// Amplitude mode `mesh`: a mesh keeps its own area, whichever way and however far it is bent.

using namespace goffer;
using test::degree;

namespace {

// With sanitizers the largest meshes would take minutes.
const std::size_t max_vertices = test::rounds<std::size_t>(1'000'000, 10'000);

struct Soup {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> triangles;

    [[nodiscard]] fit::Geometry geometry() const { return {positions, triangles}; }
};

/// Refined, so that it carries as many folds as suit it.
Soup refined_soup(Soup soup, const fit::Cylinder& cylinder, const fit::BindOptions& options = {}) {
    const fit::Refinement refinement =
        fit::refine(soup.geometry(), cylinder, fit::stretches_of(cylinder, options));
    return {fit::refined_positions(soup.positions, refinement), refinement.triangles};
}

std::vector<glm::vec3> bent_positions(const fit::Binding& binding, const Soup& soup, const bend::Pose& pose,
                                      float wrinkles = 1) {
    std::vector<glm::vec3> bent(soup.positions.size());
    bend::DeformJob job;
    job.body = &binding.body;
    job.pose = pose;
    job.wrinkle_weight = wrinkles;
    job.transform[3] = -glm::vec3(binding.body.origin());
    job.positions = interleaved<3>(&bent[0].x, bent.size());
    bend::run(job);
    return bent;
}

double bent_area(const fit::Binding& binding, const Soup& soup, const bend::Pose& pose, float wrinkles = 1) {
    return fit::surface_area(bent_positions(binding, soup, pose, wrinkles), soup.triangles);
}

/// The largest changes of area in 16 directions at six angles from 10 degrees to 0.9 of the largest.
struct AreaChange {
    double low = 0, high = 0;

    [[nodiscard]] double most() const {
        double most = -low;
        test::take_worst(most, high);
        return most;
    }
};

AreaChange area_change_of(const fit::Binding& binding, const Soup& soup) {
    const double rest = fit::surface_area(soup.positions, soup.triangles);
    const double least = 10 * degree, most = 0.9 * static_cast<double>(binding.body.max_angle());
    AreaChange change;
    for (int step = 0; step <= 5; ++step) {
        const double angle = least + (most - least) * step / 5;
        for (int direction = 0; direction < 16; ++direction) {
            const bend::Pose pose{static_cast<float>(angle),
                                  static_cast<float>(2 * std::numbers::pi * direction / 16)};
            const double here = bent_area(binding, soup, pose) / rest - 1;
            test::take_least(change.low, here);
            test::take_worst(change.high, here);
        }
    }
    return change;
}

/// Bound for its own area, a model that carries its folds keeps it within `most`. Bodies that are bent at
/// rest are bound as straight: straightening stretches them, which no wrinkle can make up for.
void check_area(const char* name, double most, std::optional<glm::dvec3> axis = std::nullopt) {
    const std::filesystem::path path = test::model(name);
    if (path.empty()) return;
    const mesh::VertexArrays records = mesh::vertex_arrays(mesh::load(path));
    const Soup read{records.positions, records.triangles};
    if (read.positions.size() > max_vertices) {
        MESSAGE("skipped: few rounds are run, without ", name);
        return;
    }
    const fit::Cylinder fitted = fit::fit_cylinder(read.geometry(), axis, fit::RestPose::straight);
    const fit::Cylinder cylinder = fit::fit_shape(read.geometry(), fitted);
    const Soup soup = refined_soup(read, cylinder);
    fit::BindOptions options;
    const AreaChange paper = area_change_of(fit::bind(soup.geometry(), cylinder, options), soup);
    options.amplitude = paper::Amplitude::mesh;
    const fit::Binding binding = fit::bind(soup.geometry(), cylinder, options);
    const AreaChange own = area_change_of(binding, soup);
    std::printf(
        "%-24s %8zu vertices, %2d folds, bound in %6.0f ms: paper %+6.2f .. %+5.2f %%, mesh %+6.3f "
        ".. %+5.3f %%\n",
        name, soup.positions.size(), binding.folds(), binding.milliseconds, 100 * paper.low, 100 * paper.high,
        100 * own.low, 100 * own.high);
    CHECK(own.most() < most);
}

}  // namespace

TEST_CASE("amplitude mesh: wine_bottle.glb keeps its own area") {
    check_area("wine_bottle.glb", 5e-5);
}

TEST_CASE("amplitude mesh: WaterBottle.gltf keeps its own area") {
    check_area("WaterBottle.gltf", 6e-5);
}

TEST_CASE("amplitude mesh: banana.obj keeps its own area") {
    check_area("banana.obj", 3.5e-5);
}

TEST_CASE("amplitude mesh: blub_open.obj keeps its own area") {
    check_area("blub_open.obj", 7e-5);
}

TEST_CASE("amplitude mesh: log_01.glb keeps its own area") {
    check_area("log_01.glb", 4e-5);
}

TEST_CASE("amplitude mesh: insect_leg.glb keeps its own area") {
    check_area("insect_leg.glb", 1.1e-4);
}

TEST_CASE("amplitude mesh: cushion_02.glb keeps its own area") {
    check_area("cushion_02.glb", 8e-5);
}

TEST_CASE("amplitude mesh: fuze.ply keeps its own area") {
    check_area("fuze.ply", 2e-5);
}

TEST_CASE("amplitude mesh: koala.obj keeps its own area") {
    check_area("koala.obj", 8e-5);
}

TEST_CASE("amplitude mesh: lh_trochanterfemur.stl keeps its own area") {
    check_area("lh_trochanterfemur.stl", 6e-5);
}

TEST_CASE("amplitude mesh: l_arista.stl keeps its own area") {
    check_area("l_arista.stl", 4e-5);
}

TEST_CASE("amplitude mesh: softball.obj keeps its own area") {
    check_area("softball.obj", 2e-5, glm::dvec3(0, 1, 0));
}

TEST_CASE("amplitude mesh: banana.obj, bent at rest, keeps its area when it is bent further") {
    const std::filesystem::path path = test::model("banana.obj");
    if (path.empty()) return;
    const mesh::VertexArrays records = mesh::vertex_arrays(mesh::load(path));
    const Soup soup{records.positions, records.triangles};
    const fit::Cylinder cylinder = fit::fit_cylinder(soup.geometry());
    REQUIRE(cylinder.rest_angle > 1.5);
    fit::BindOptions options;
    options.amplitude = paper::Amplitude::mesh;
    const fit::Binding binding = fit::bind(soup.geometry(), cylinder, options);
    const double rest = fit::surface_area(soup.positions, soup.triangles);
    const double most = 0.9 * static_cast<double>(binding.body.max_angle());
    for (int step = 1; step <= 20; ++step) {
        const double angle = cylinder.rest_angle + (most - cylinder.rest_angle) * step / 20;
        const auto change = [&](double turned) {
            return std::abs(
                bent_area(binding, soup,
                          {static_cast<float>(angle), static_cast<float>(cylinder.rest_direction + turned)}) /
                    rest -
                1);
        };
        CAPTURE(angle);
        CHECK(change(0) < 5e-4);
        for (const double turned : {0.2, 1.0, 2.5, 4.0}) CHECK(change(turned) < 3e-3);
    }
}

TEST_CASE("amplitude mesh: regions keep the area of each") {
    std::mt19937 random(7);
    const test::Solid solid = test::cylinder({.columns = 48, .rows = 160}, random);
    const Soup soup{solid.positions, solid.triangles};
    const fit::Cylinder cylinder = fit::fit_cylinder(soup.geometry());
    fit::BindOptions options;
    options.amplitude = paper::Amplitude::mesh;
    options.folds = 2;
    options.regions = {{0.5, {}}, {0.5, {}}};
    const fit::Binding binding = fit::bind(soup.geometry(), cylinder, options);
    for (const bend::RegionInput& region : binding.body.region_inputs()) {
        REQUIRE(!region.factors.empty());
        CHECK(region.factors.rows[0] == region.factors.rows[1]);  // nothing is solved at the angle 0
    }
    const double rest = fit::surface_area(soup.positions, soup.triangles);
    for (const float direction : {0.0f, 1.0f, 2.5f}) {
        const bend::Pose poses[] = {{0.7f, direction}, {-0.9f, 0.3f}};
        std::vector<glm::vec3> bent(soup.positions.size()), sorted(bent.size());
        bend::DeformJob job;
        job.body = &binding.body;
        job.poses = poses;
        job.positions = interleaved<3>(&bent[0].x, bent.size());
        bend::run(job);
        for (std::size_t i = 0; i < bent.size(); ++i)
            sorted[binding.order.empty() ? i : binding.order[i]] = bent[i];
        // What passes over the joint was solved for regions that bend alike.
        CHECK(std::abs(fit::surface_area(sorted, soup.triangles) / rest - 1) < 1.5e-3);
    }
}

TEST_CASE("amplitude mesh: slices of a body that is thick here and thin there keep their area each") {
    std::mt19937 random(21);
    const test::Solid solid =
        test::warped(test::cylinder({.columns = 48, .rows = 240, .closed = false}, random), [](glm::dvec3 p) {
            const double thick = 0.75 + 0.35 * std::cos(0.9 * p.z);
            return glm::dvec3(thick * p.x, thick * p.y, p.z);
        });
    const Soup soup{solid.positions, solid.triangles};
    const fit::Binding binding =
        fit::bind(soup.geometry(), test::upright(), {.amplitude = paper::Amplitude::mesh});
    const std::vector<std::uint32_t> slices =
        fit::patches_of(soup.geometry(), binding.cylinder, {.slices = 10, .sides = 1});
    for (const float direction : {0.0f, 2.0f}) {
        const fit::PatchChange change =
            fit::patch_change(soup.geometry(), bent_positions(binding, soup, {1.5f, direction}), slices);
        MESSAGE("slices: rms ", change.rms, ", worst ", change.worst);
        CHECK(change.rms < 0.013);
        CHECK(std::abs(change.worst) < 0.022);
    }
}

TEST_CASE("amplitude mesh: folds that nobody asked for are no deeper than a quarter of the radius") {
    std::mt19937 random(9);
    // So few rows that folds are 0.8 radii long.
    const test::Solid solid =
        test::cylinder({.columns = 32, .rows = 40, .length = 4, .closed = true}, random);
    fit::Cylinder base = test::upright();
    base.length = 4;
    const Soup soup{solid.positions, solid.triangles};
    fit::BindOptions options;
    options.amplitude = paper::Amplitude::mesh;
    const auto depth = [&] {
        return fit::wrinkle_depth(fit::bind(soup.geometry(), base, options), 0, 90 * degree);
    };
    CHECK(depth() < 0.25);
    CHECK(depth() > 0.15);
    options.fold_length = fit::default_fold_length(options.profile);
    CHECK(depth() > 0.25);
}

TEST_CASE(
    "amplitude mesh: where the bare bend makes a body larger there are no wrinkles, and enough beside that") {
    std::mt19937 random(14);
    const test::Solid solid = test::warped(test::cylinder({.columns = 24, .rows = 200}, random),
                                           [](glm::dvec3 p) { return p + glm::dvec3(1.2, 0, 0); });
    const Soup soup{solid.positions, solid.triangles};
    const fit::Binding binding =
        fit::bind(soup.geometry(), test::upright(), {.folds = 6, .amplitude = paper::Amplitude::mesh});
    const double rest = fit::surface_area(soup.positions, soup.triangles);
    double low = 0, high = 0, largest = 0;
    for (const float share : {0.2f, 0.5f, 0.9f}) {
        for (int direction = 0; direction < 40; ++direction) {
            const bend::Pose pose{share * binding.body.max_angle(),
                                  static_cast<float>(2 * std::numbers::pi * direction / 40)};
            const double bare = bent_area(binding, soup, pose, 0), all = bent_area(binding, soup, pose);
            const double off = (all - std::max(bare, rest)) / rest;
            low = std::min(low, off), high = std::max(high, off), largest = std::max(largest, bare / rest);
        }
    }
    CHECK(largest > 1.01);
    CHECK(low > -0.01);
    CHECK(high < 2e-4);
}

TEST_CASE("amplitude mesh: triangles without area change nothing") {
    std::mt19937 random(8);
    const test::Solid solid = test::cylinder({.columns = 24, .rows = 64}, random);
    const Soup plain{solid.positions, solid.triangles};
    Soup folded = plain;
    for (std::size_t t = 0; t < 300; t += 3) {
        const std::uint32_t a = plain.triangles[t], b = plain.triangles[t + 1];
        folded.triangles.insert(folded.triangles.end(), {a, a, b});
    }
    const fit::Cylinder cylinder = fit::fit_cylinder(plain.geometry());
    fit::BindOptions options;
    options.amplitude = paper::Amplitude::mesh;
    options.folds = 3;
    const fit::Binding one = fit::bind(plain.geometry(), cylinder, options);
    const fit::Binding other = fit::bind(folded.geometry(), cylinder, options);
    for (const float direction : {0.0f, 1.0f, 2.5f}) {
        const bend::Pose pose{1.2f, direction};
        CHECK(bent_area(one, plain, pose) == bent_area(other, plain, pose));
    }
}

TEST_CASE("amplitude mesh: where rows are too few for the folds, wrinkles are at most twice as deep") {
    std::mt19937 random(9);
    double deepest = 0;
    for (const auto& [folds, rows] : {std::pair(3, 8), std::pair(6, 16)}) {
        const test::Solid solid = test::cylinder({.columns = 24, .rows = rows}, random);
        const fit::Cylinder cylinder = fit::fit_cylinder(solid.geometry());
        fit::BindOptions options;
        options.folds = folds;
        options.profile = paper::Profile::damped;
        const fit::Binding paper = fit::bind(solid.geometry(), cylinder, options);
        options.amplitude = paper::Amplitude::mesh;
        const fit::Binding own = fit::bind(solid.geometry(), cylinder, options);
        for (const float angle : {0.1f, 0.8f, 1.5f}) {
            const auto bent = [&](const fit::Binding& binding, float wrinkle_weight) {
                std::vector<glm::vec3> positions(solid.positions.size());
                bend::DeformJob job;
                job.body = &binding.body;
                job.pose = {angle, 0.5f};
                job.wrinkle_weight = wrinkle_weight;
                job.positions = interleaved<3>(&positions[0].x, positions.size());
                bend::run(job);
                return positions;
            };
            const std::vector<glm::vec3> bare = bent(paper, 0), wrinkled = bent(paper, 1),
                                         deep = bent(own, 1);
            for (std::size_t i = 0; i < bare.size(); ++i) {
                const double of_paper = glm::distance(glm::dvec3(wrinkled[i]), glm::dvec3(bare[i]));
                const double of_own = glm::distance(glm::dvec3(deep[i]), glm::dvec3(bare[i]));
                if (of_paper > 0.01) deepest = std::max(deepest, of_own / of_paper);
            }
        }
    }
    CHECK(deepest == doctest::Approx(2).epsilon(1e-4));
}

TEST_CASE("bind tells how far it is, and is not changed by that") {
    std::mt19937 random(4);
    const test::Solid solid = test::cylinder({.columns = 24, .rows = 96}, random);
    const fit::Cylinder cylinder = fit::fit_cylinder(solid.geometry());
    fit::BindOptions options;
    options.regions = {{0.4}, {0.6}};
    options.amplitude = paper::Amplitude::mesh;
    const fit::Binding unheard = fit::bind(solid.geometry(), cylinder, options);
    std::mutex mutex;
    std::vector<double> shares;
    options.progress = [&](double share) {
        const std::lock_guard lock(mutex);
        shares.push_back(share);
    };
    std::optional<fit::Binding> in_one_thread;
    test::in_arena(1, [&] { in_one_thread = fit::bind(solid.geometry(), cylinder, options); });
    const fit::Binding& heard = *in_one_thread;
    CHECK(shares.size() > 100);
    CHECK(shares.front() < 0.2);
    CHECK(shares.back() == 1);
    CHECK(std::ranges::all_of(shares, [](double share) { return share >= 0 && share <= 1; }));
    CHECK(std::ranges::is_sorted(shares));
    double widest = 0;
    for (std::size_t i = 1; i < shares.size(); ++i) widest = std::max(widest, shares[i] - shares[i - 1]);
    CHECK(widest < 0.11);
    for (std::size_t r = 0; r < 2; ++r) {
        CHECK(heard.body.max_angle(r) == unheard.body.max_angle(r));
        CHECK(heard.body.region_inputs()[r].factors.rows == unheard.body.region_inputs()[r].factors.rows);
    }
    options.amplitude = paper::Amplitude::paper;
    shares.clear();
    (void)fit::bind(solid.geometry(), cylinder, options);
    CHECK(shares.back() == 1);
}
