// SPDX-License-Identifier: MIT
#include "support/angles.hpp"
#include "synthetic.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/fit/patches.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

/// What folds that run on over joints do to the area of chains.

namespace goffer {
namespace {

constexpr float one_degree = std::numbers::pi_v<float> / 180;

/// Where the vertices of a mesh go, in its own order.
std::vector<glm::vec3> posed(const fit::Binding& binding, const std::vector<bend::Pose>& poses) {
    std::vector<glm::vec3> bent(binding.body.vertex_count()), sorted;
    bend::DeformJob job{.body = &binding.body, .poses = poses};
    job.positions = interleaved<3>(&bent[0].x, bent.size());
    bend::run(job);
    for (const std::uint32_t place : binding.vertices_in_body()) sorted.push_back(bent[place]);
    return sorted;
}

/// Equal regions of a tube of radius 1.
struct TestChain {
    const char* name;
    double length;
    std::vector<float> angles, directions;  // degrees
    double most;                            // rms of the local change, in percent
};

/// Changes of area over 24 slices by 4 sides, and of the whole.
struct ChainChange {
    double local, whole;
};

ChainChange chain_change_of(const TestChain& chain, bool over_joints) {
    std::mt19937 random(11);
    test::Recipe tube{.columns = 96, .rows = 1200};
    tube.length = chain.length;
    const test::Solid solid = test::cylinder(tube, random);
    fit::Cylinder base = test::upright();
    base.length = chain.length;
    fit::BindOptions options;
    options.fold_length = 0.6;
    options.folds_over_joints = over_joints;
    options.regions.assign(chain.angles.size(), {1.0 / static_cast<double>(chain.angles.size()), {}});
    const fit::Binding binding = fit::bind(solid.geometry(), base, options);
    std::vector<bend::Pose> poses;
    for (std::size_t r = 0; r < chain.angles.size(); ++r)
        poses.push_back({chain.angles[r] * one_degree, chain.directions[r] * one_degree});
    const std::vector<glm::vec3> bent = posed(binding, poses);
    const std::vector<std::uint32_t> patches = fit::patches_of(solid.geometry(), base, {24, 4});
    const std::vector<std::uint32_t> one(patches.size(), 0);
    return {100 * fit::patch_change(solid.geometry(), bent, patches).rms,
            100 * fit::patch_change(solid.geometry(), bent, one).worst};
}

/// A body of radius 1 that is bent along different arcs at rest.
struct ArcBody {
    const char* name;
    std::vector<fit::RestArc> arcs;

    [[nodiscard]] fit::Cylinder base() const {
        fit::Cylinder base;
        base.radius = 1;
        base.arcs = arcs;
        base.length = 0;
        for (const fit::RestArc& arc : arcs) base.length += arc.length;
        return base;
    }

    /// Bent by a right angle more in all, evenly, toward one side.
    [[nodiscard]] std::vector<bend::Pose> bent_further(double direction) const {
        std::vector<bend::Pose> poses;
        for (const fit::RestArc& arc : arcs) {
            const double more = std::numbers::pi / 2 * arc.length / base().length;
            const double x = arc.angle * std::cos(arc.direction) + more * std::cos(direction),
                         y = arc.angle * std::sin(arc.direction) + more * std::sin(direction);
            poses.push_back({static_cast<float>(std::hypot(x, y)), static_cast<float>(std::atan2(y, x))});
        }
        return poses;
    }
};

/// The surface of an ArcBody, with what of it lies near joints.
class ArcSurface {
public:
    static constexpr double fold_length = 0.6;

    explicit ArcSurface(const ArcBody& body)
        : body_(body),
          base_(body.base()),
          rows_(static_cast<std::uint32_t>(20 * base_.length)),  // bands of whole rows
          solid_(test::surface_of(base_, rows_, sides)) {}

    [[nodiscard]] fit::Binding bound(bool over_joints) const {
        fit::BindOptions options;
        options.fold_length = fold_length;
        options.folds_over_joints = over_joints;
        options.table_rows = 64;
        return fit::bind(solid_.geometry(), base_, options);
    }

    /// The local change of area, rms, within a quarter of a fold of joints and 60 degrees of where a bend
    /// toward `direction` squeezes most: of patches of a joint and 30 degrees.
    [[nodiscard]] double change_at_joints(const fit::Binding& binding, double direction) const {
        std::vector<std::uint32_t> triangles, patches;
        for (std::size_t t = 0; t < solid_.triangles.size(); t += 3) {
            const auto quad = static_cast<std::uint32_t>(t / 6);
            const double z = base_.length * (quad / sides + 0.5) / rows_;
            const double beta = 2 * std::numbers::pi * (quad % sides + 0.5) / sides;
            const double sector =
                2 + std::remainder(beta - direction, 2 * std::numbers::pi) / (30 * test::degree);
            const std::optional<std::uint32_t> joint = joint_near(z);
            if (!joint || !(sector >= 0 && sector < 4)) continue;
            patches.push_back(4 * *joint + static_cast<std::uint32_t>(sector));
            triangles.insert(triangles.end(), &solid_.triangles[t], &solid_.triangles[t] + 3);
        }
        const std::vector<glm::vec3> bent = posed(binding, body_.bent_further(direction));
        const fit::PatchChange change =
            fit::patch_change(fit::Geometry{solid_.positions, triangles}, bent, patches);
        CHECK(change.patches == 4 * (body_.arcs.size() - 1));
        return change.rms;
    }

private:
    static constexpr std::uint32_t sides = 32;

    [[nodiscard]] std::optional<std::uint32_t> joint_near(double z) const {
        double joint = 0;
        for (std::uint32_t i = 0; i + 1 < body_.arcs.size(); ++i) {
            joint += body_.arcs[i].length;
            if (std::abs(z - joint) < fold_length / 4) return i;
        }
        return std::nullopt;
    }

    const ArcBody& body_;
    fit::Cylinder base_;
    std::uint32_t rows_;
    test::Solid solid_;
};

}  // namespace

TEST_CASE(
    "folds over joints: chains keep their area, place by place, better than with folds that end at joints") {
    const TestChain chains[] = {
        {"spiral", 30, {30, 50, 80, 110, 130, 130}, std::vector<float>(6, 0), 2.4},
        {"S", 20, {70, 70}, {0, 180}, 1.6},
        {"worm", 24, std::vector<float>(8, 40), {0, 90, 180, 180, 270, 0, 0, 90}, 1.8},
    };
    for (const TestChain& chain : chains) {
        const ChainChange over = chain_change_of(chain, true), apart = chain_change_of(chain, false);
        MESSAGE(std::string(chain.name), ": local ", over.local, " % (all ", over.whole,
                " %), folds that end at joints ", apart.local, " % (", apart.whole, " %)");
        CHECK(over.local < chain.most);
        CHECK(over.local < apart.local);
        CHECK(std::abs(over.whole) < 2);
    }
}

TEST_CASE("folds over joints: between different arcs at rest they keep the area near joints better, too") {
    constexpr double degree = test::degree;
    const ArcBody bodies[] = {
        {"three", {{9, 60 * degree, 0}, {6, 100 * degree, 2}, {9, 40 * degree, 4}}},
        {"S", {{9, 90 * degree, 0}, {9, 90 * degree, 180 * degree}, {6, 60 * degree, 0}}},
        {"spiral", {{6, 20 * degree, 0}, {6, 50 * degree, 0}, {6, 80 * degree, 0}, {6, 110 * degree, 0}}},
    };
    for (const ArcBody& body : bodies) {
        const ArcSurface surface(body);
        const fit::Binding over = surface.bound(true), apart = surface.bound(false);
        for (const fit::RegionBinding& region : over.regions)
            REQUIRE(region.length == doctest::Approx(ArcSurface::fold_length * region.folds));
        double over_squares = 0, apart_squares = 0;
        for (const double direction : {0.0, 90 * degree, 180 * degree, 270 * degree}) {
            const double with = surface.change_at_joints(over, direction);
            const double without = surface.change_at_joints(apart, direction);
            over_squares += with * with, apart_squares += without * without;
        }
        const double with = 100 * std::sqrt(over_squares / 4), without = 100 * std::sqrt(apart_squares / 4);
        MESSAGE(std::string(body.name), ": local ", with, " % near joints, folds that end at joints ",
                without, " %");
        CHECK(with < 0.65 * without);
    }
}

TEST_CASE("folds over joints: they run on between folds of which one is at most three times as long") {
    std::mt19937 random(12);
    const test::Solid solid = test::cylinder({.columns = 12, .rows = 400}, random);
    for (const auto& [folds, runs_on] : {std::pair{17, true}, std::pair{19, false}}) {
        for (const bool longer_first : {false, true}) {
            fit::BindOptions options;
            options.regions = {{0.5, longer_first ? 6 : folds}, {0.5, longer_first ? folds : 6}};
            const fit::Binding binding = fit::bind(solid.geometry(), test::upright(), options);
            CHECK((binding.regions[0].blend > 0) == runs_on);
        }
    }
}

TEST_CASE("folds over joints: how far a body can be bent does not ask for its size") {
    std::mt19937 random(13);
    // Thick a little before the joint, where wrinkles of the region behind it reach, or a little behind it.
    for (const double thick : {4.5, 5.5}) {
        CAPTURE(thick);
        const test::Solid one =
            test::warped(test::cylinder({.columns = 24, .rows = 400}, random), [&](glm::dvec3 p) {
                const double away = p.z - thick, rho = 0.7 + 0.5 * std::exp(-16 * away * away);
                return glm::dvec3(rho * p.x, rho * p.y, p.z);
            });
        std::vector<double> angles, scales;
        for (const double size : {1.0, 0.1, 10.0}) {
            const test::Solid solid = test::placed(one, {.scale = size});
            fit::Cylinder cylinder = test::upright();
            cylinder.length *= size, cylinder.radius *= size;
            fit::BindOptions options;
            options.regions = {{0.5, {}}, {0.5, {}}};
            const fit::Binding binding = fit::bind(solid.geometry(), cylinder, options);
            REQUIRE(binding.regions[0].blend > 0);
            for (std::size_t r = 0; r < 2; ++r) {
                angles.push_back(static_cast<double>(binding.body.max_angle(r)));
                scales.push_back(binding.body.region_inputs()[r].max_scale);
            }
        }
        for (std::size_t i = 2; i < angles.size(); ++i) {
            CHECK(angles[i] == doctest::Approx(angles[i % 2]).epsilon(1e-4));
            CHECK(scales[i] == doctest::Approx(scales[i % 2]).epsilon(1e-4));
        }
    }
}

}  // namespace goffer
