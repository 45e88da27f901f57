// SPDX-License-Identifier: MIT
#include "refusals.hpp"
#include "support/bodies.hpp"
#include "support/worst.hpp"
#include "synthetic.hpp"

#include <goffer/fit/bind.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>
#include <vector>

/// The wrinkle table against eq 7's own solution, the largest angle against its definition, and bind's
/// refusals.

namespace goffer::test {
namespace {

using paper::Amplitude;
using paper::Profile;

/// Amplitude of the column at T = 1 + cos(beta - theta), as a kernel computes it.
double table_amplitude(const bend::WrinkleTable& table, double angle, double kappa, double t) {
    const bend::WrinkleRow row = table.at(static_cast<float>(angle));
    double sum = 0;
    for (std::size_t n = row.size(); n-- > 0;) sum = sum * t + static_cast<double>(row[n]);
    return std::sqrt(kappa * t) * sum;
}

}  // namespace

TEST_CASE("the table's amplitudes are eq 7's, at every angle between the rows") {
    constexpr double length = 12, radius = 1.1;
    double worst = 0;
    for (const Profile profile : {Profile::damped, Profile::smooth}) {
        for (const int folds : {1, 3, 5, 12, 40}) {
            const double limit = fit::largest_angle(profile, Amplitude::paper, folds, length, radius, radius);
            const bend::WrinkleTable table =
                fit::make_wrinkle_table(profile, Amplitude::paper, folds, length, radius, limit);
            for (int i = 1; i < 40; ++i) {
                const double angle = limit * i * i / 1600.0;
                const double kappa = angle * radius / length;
                for (const double t : {0.02, 0.6, 1.4, 2.0}) {
                    const double expected = paper::amplitude(profile, folds, length, kappa * t);
                    worst = std::max(worst,
                                     std::fabs(table_amplitude(table, angle, kappa, t) - expected) / length);
                }
            }
        }
    }
    MESSAGE("amplitude within ", worst, " L");
    CHECK(worst < 3e-7);
}

TEST_CASE("no table is made of a cylinder without length or radius") {
    const auto error = [](double length, double radius) {
        return error_of(
            [=] { (void)fit::make_wrinkle_table(Profile::damped, Amplitude::paper, 5, length, radius, 1); });
    };
    CHECK(error(10, 1).empty());
    for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
        CHECK(error(wrong, 1).starts_with("length: "));
        CHECK(error(10, wrong).starts_with("radius: "));
    }
}

TEST_CASE("with amplitude `area` the table holds the base's lateral area") {
    constexpr double length = 10, radius = 1;
    for (const int folds : {3, 6, 10}) {
        const double limit =
            fit::largest_angle(Profile::damped, Amplitude::area, folds, length, radius, radius);
        const bend::WrinkleTable table =
            fit::make_wrinkle_table(Profile::damped, Amplitude::area, folds, length, radius, limit);
        const bend::WrinkleTable plain =
            fit::make_wrinkle_table(Profile::damped, Amplitude::paper, folds, length, radius, limit);
        for (const double degrees : {5.0, 30.0, 90.0, 180.0}) {
            const double angle = degrees * std::numbers::pi / 180;
            const double factor =
                table_amplitude(table, angle, 0.1, 1) / table_amplitude(plain, angle, 0.1, 1);
            CHECK(std::fabs(paper::lateral_area(Profile::damped, folds, length, radius, angle, factor) - 1) <
                  2e-7);
        }
    }
}

TEST_CASE("64 rows are made in under 50 ms") {
    for (const Amplitude amplitude : {Amplitude::paper, Amplitude::area}) {
        for (const int folds : {5, 12}) {
            double best = std::numeric_limits<double>::infinity();
            for (int attempt = 0; attempt < 5; ++attempt) {
                const std::clock_t start = std::clock();  // this process's own time: the machine may be busy
                const double limit = fit::largest_angle(Profile::damped, amplitude, folds, 10, 1, 1.1);
                const bend::WrinkleTable table =
                    fit::make_wrinkle_table(Profile::damped, amplitude, folds, 10, 1, limit, 64);
                REQUIRE(table.rows.size() == 64);
                best = std::min(best, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
            }
            MESSAGE(folds, " folds, ", std::string(amplitude == Amplitude::area ? "area: " : "paper: "), best,
                    " ms");
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__)
            CHECK(best < 50);
#endif
        }
    }
}

TEST_CASE("the largest angle lies just below where the outermost vertex meets the arc's center") {
    for (const int folds : {0, 2, 6}) {
        for (const double rho_max : {1.0, 1.3, 3.0}) {
            const double limit = fit::largest_angle(Profile::damped, Amplitude::paper, folds, 10, 1, rho_max);
            const auto room = [&](double alpha) {
                const double lift =
                    folds ? paper::amplitude(Profile::damped, folds, 10, std::min(0.2 * alpha, 0.999)) : 0;
                return 10 / alpha - 1 - rho_max - lift;
            };
            CHECK(limit < 5);
            CHECK(room(limit) > 0);
            CHECK(room(limit * 1.003) < 0);
        }
    }
    // With the factor of `area` at the limit, the outermost vertex just has room.
    const double limit = fit::largest_angle(Profile::damped, Amplitude::area, 2, 10, 1, 3),
                 factor = paper::area_factor(Profile::damped, 2, 10, 1, limit),
                 with_factor = fit::largest_angle(Profile::damped, Amplitude::paper, 2, 10, 1, 3, factor);
    CHECK(std::fabs(factor - 1) > 0.02);
    CHECK(limit <= with_factor);
    CHECK(limit > 0.999 * with_factor);
}

TEST_CASE("a vertex that no triangle uses does not limit the angle, wherever it is") {
    for (const fit::ShapeMode shape : {fit::ShapeMode::automatic, fit::ShapeMode::cylinder}) {
        std::vector<float> limits;
        for (const double away : {0.5, 3.0, 500.0, 1e6, 1e15}) {
            Random random(7);
            TestMesh test_mesh = random_mesh(random, 10, 10);
            const fit::Cylinder& c = test_mesh.cylinder;
            add_vertex(test_mesh, random, {c.zero, glm::cross(c.axis, c.zero), c.axis}, 1, 5, away);
            fit::BindOptions options;
            options.shape = shape;
            limits.push_back(fit::bind(test_mesh.geometry(), c, options).body.max_angle());
        }
        CHECK(limits.front() > 1);
        for (const float limit : limits) CHECK(limit == limits.front());
    }
}

TEST_CASE("within the largest angle nothing folds through itself") {
    Random random(21);
    for (int trial = 0; trial < 10; ++trial) {
        TestMesh test_mesh = random_mesh(random, uniform(random, 4, 20), 1);
        if (trial % 3 == 0) add_radii(test_mesh, random);
        fit::BindOptions options;
        options.profile = random_profile(random);
        const fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
        const paper::ClosedForm map(parameters_of(binding, options, 0),
                                    {static_cast<double>(binding.body.max_angle()), 0});
        // The arc's parameter grows along every column: each step goes forward along the bent center line.
        double largest = 0;
        for (const glm::vec3& position : test_mesh.positions) {
            const glm::dvec3 from = glm::dvec3(position) - test_mesh.cylinder.origin;
            test::take_worst(largest, glm::length(glm::cross(from, test_mesh.cylinder.axis)));
        }
        for (const double rho : {largest, 0.7 * largest, 0.2 * largest}) {
            for (int i = 0; i < 200; ++i) {
                const double z = i / 200.0, step = 1e-4;
                const glm::dvec3 a = map.position({0, z, rho});
                const glm::dvec3 b = map.position({0, z + step, rho});
                const auto& shape = binding.regions[0].shape;
                const auto curvature = static_cast<double>(binding.body.max_angle());
                const double phi = curvature * (z - (shape ? curvature * shape->drift(z) : 0));
                REQUIRE(glm::dot(b - a, glm::dvec3(std::sin(phi), 0, std::cos(phi))) > 0);
            }
        }
    }
}

TEST_CASE("folds that nobody asked for are never more than bind takes") {
    Random random(24);
    const auto folds = [&](double slenderness) {
        const TestMesh mesh = random_mesh(random, slenderness, 1, 3, static_cast<int>(9 * slenderness), 0);
        REQUIRE(fit::folds_capacity(mesh.geometry(), mesh.cylinder) > fit::BindOptions::max_folds);
        fit::BindOptions damped;
        damped.profile = Profile::damped;
        CHECK(fit::bind(mesh.geometry(), mesh.cylinder).folds() == 2 * fit::BindOptions::max_folds);
        return fit::bind(mesh.geometry(), mesh.cylinder, damped).folds();
    };
    CHECK(folds(1280) == fit::BindOptions::max_folds);
    CHECK(folds(2200) == 0);  // 512 of the 1100 that suit it would reach past the axis
}

TEST_CASE("bodies that are thousands of radii long bend by as much as a body can") {
    Random random(26);
    const TestMesh mesh = random_mesh(random, 4000, 1, 3, 500, 0);
    CHECK(fit::bind(mesh.geometry(), mesh.cylinder).body.max_angle() == bend::WorkingRange::max_angle);
}

TEST_CASE("bind refuses what it cannot use, and names it") {
    Random random(22);
    const TestMesh good = random_mesh(random, 10, 1, 12, 17, 0);
    const auto refused = [&](auto change) {
        TestMesh test_mesh = good;
        fit::BindOptions options;
        change(test_mesh, options);
        return error_of([&] { (void)fit::bind(test_mesh.geometry(), test_mesh.cylinder, options); });
    };
    CHECK(refused([](TestMesh&, fit::BindOptions&) {}).empty());
    using Options = fit::BindOptions;
    CHECK(refused([](TestMesh&, Options& o) { o.folds = 1025; }).find("folds") != std::string::npos);
    CHECK(refused([](TestMesh&, Options& o) {
              o.profile = Profile::damped;
              o.folds = 513;
          }).find("folds: 513 is outside 0..512") != std::string::npos);
    for (const double bad : {-0.1, 0.6, std::nan("")}) {
        const auto rounded = [&](TestMesh&, Options& o) { o.profile.roundness = bad; };
        CHECK(refused(rounded).find("roundness") == 0);
        CHECK(refused([&](TestMesh& mesh, Options& o) {
                  mesh = random_mesh(random, 10, 1, 12, 161, 0);  // with rows for folds by itself
                  rounded(mesh, o);
              }).find("roundness") == 0);
    }
    for (const double bad : {0.0, 1e-300, 1e300, HUGE_VAL})
        CHECK(refused([&](TestMesh&, Options& o) { o.fold_length = bad; }).find("fold_length") == 0);
    CHECK(refused([](TestMesh& s, Options&) { s.cylinder.radii = {1}; }).find("radii") != std::string::npos);
    CHECK(refused([](TestMesh& s, Options&) {
              s.cylinder.radii = {1, 2};
          }).find("radii have the mean 1.5") != std::string::npos);
    for (const int bad : {-1, 1025, std::numeric_limits<int>::max()}) {
        for (const auto amplitude : {fit::Amplitude::paper, fit::Amplitude::none})
            CHECK(refused([&](TestMesh&, Options& o) {
                      o.folds = bad, o.amplitude = amplitude;
                  }).find("folds: " + std::to_string(bad) + " is outside 0..1024") == 0);
    }
    CHECK(refused([](TestMesh& s, Options&) {
              s.cylinder.radii = {0.01, 0.19};
              s.cylinder.rest_angle = 4;
          }).find("too thick for the rest_angle of 4") != std::string::npos);
    CHECK(refused([](TestMesh&, Options& o) { o.table_rows = 1; }).find("table_rows") != std::string::npos);
    CHECK(refused([](TestMesh& s, Options&) { s.cylinder.length = 0.5; }).find("vertex") !=
          std::string::npos);
    CHECK(refused([](TestMesh& s, Options&) { s.cylinder.rest_angle = 60; }).find("rest_angle") !=
          std::string::npos);
    CHECK(refused([](TestMesh& s, Options&) {
              const glm::dvec3 origin = s.cylinder.origin;
              for (glm::vec3& p : s.positions) p = 1e-15f * glm::vec3(glm::dvec3(p) - origin);
              s.cylinder.origin = glm::dvec3(0);
              s.cylinder.length *= 1e-15;
              s.cylinder.radius *= 1e-15;
          }).find("cannot bind: radius: out of range") == 0);
    CHECK(refused([](TestMesh& s, Options&) { s.cylinder.radius = -1; }).find("radius") != std::string::npos);
    CHECK(refused([](TestMesh& s, Options&) { s.normals.pop_back(); }).find("normals") != std::string::npos);
    CHECK(refused([](TestMesh& s, Options&) { s.triangles.clear(); }).find("triangles") != std::string::npos);
}

TEST_CASE("broken normals and tangents are replaced, missing normals are made, stray vertices tolerated") {
    Random random(23);
    TestMesh test_mesh = random_mesh(random, 10, 1, 12, 17, 0);
    test_mesh.normals[3] = glm::vec3(0);
    test_mesh.tangents[5] = glm::vec4(0);
    test_mesh.positions.emplace_back(test_mesh.cylinder.origin +
                                     5.0 * test_mesh.cylinder.axis);  // no triangle uses it
    test_mesh.normals.emplace_back(1, 0, 0);
    test_mesh.tangents.emplace_back(0, 1, 0, -1);
    const fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder);
    Output out(test_mesh.positions.size());
    bend::run(make_job(binding.body, {1, 1}, Isa::automatic, out));
    for (std::size_t i = 0; i < test_mesh.positions.size(); ++i) {
        REQUIRE(glm::length(out.normal(i)) == doctest::Approx(1));
        REQUIRE(glm::length(out.tangent(i)) == doctest::Approx(1));
    }
    test_mesh.normals.clear();
    CHECK_NOTHROW((void)fit::bind(test_mesh.geometry(), test_mesh.cylinder));
}

TEST_CASE("vertices a little beyond the ends belong to the first and the last region, however short") {
    Random random(25);
    TestMesh test_mesh = random_mesh(random, 10, 1, 12, 17, 0);
    fit::Cylinder& cylinder = test_mesh.cylinder;
    cylinder.origin += 8e-4 * cylinder.axis;
    cylinder.length /= 1.0016;
    for (const std::size_t count : {1u, 2u, 8u}) {
        fit::BindOptions options;
        options.regions.assign(count, {.share = 1.0 / static_cast<double>(count)});
        const fit::Binding binding = fit::bind(test_mesh.geometry(), cylinder, options);
        CHECK_NOTHROW((void)fit::bind_level(test_mesh.geometry(), binding));
        Output out(test_mesh.positions.size());
        const std::vector<bend::Pose> rest = binding.body.rest_poses();
        bend::DeformJob job = make_job(binding.body, {}, Isa::automatic, out);
        job.poses = rest;
        bend::run(job);
        const std::vector<std::uint32_t> place = binding.vertices_in_body();
        for (std::size_t i = 0; i < test_mesh.positions.size(); ++i)
            REQUIRE(glm::length(out.position(place[i]) - glm::dvec3(test_mesh.positions[i])) < 1e-3);
    }
}

TEST_CASE("tangents that replace broken ones are orthogonal to the normals, whichever way these point") {
    Random random(24);
    const Solid solid = tube();
    std::vector<glm::vec3> normals;
    for (std::size_t i = 0; i < solid.positions.size(); ++i) normals.emplace_back(random_rotation(random)[0]);
    for (int axis = 0; axis < 3; ++axis) normals[static_cast<std::size_t>(axis)] = glm::mat3(1)[axis];
    const std::vector<glm::vec4> broken(normals.size());
    const fit::Binding binding = fit::bind({solid.positions, solid.triangles, normals, broken}, upright());
    Output out(normals.size());
    bend::run(make_job(binding.body, {}, Isa::automatic, out));
    for (std::size_t i = 0; i < normals.size(); ++i) {
        REQUIRE(glm::length(out.tangent(i)) == doctest::Approx(1));
        REQUIRE(std::fabs(glm::dot(out.normal(i), out.tangent(i))) < 1e-6);
    }
}

}  // namespace goffer::test
