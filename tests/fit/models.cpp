// SPDX-License-Identifier: MIT
#include "support/models.hpp"

#include "synthetic.hpp"

#include <goffer/mesh/mesh.hpp>

#include <glm/trigonometric.hpp>

#include <cmath>
#include <numbers>

using namespace goffer;

namespace {

/// What is known of a model: of its surface, and what the fit has come to.
struct Known {
    glm::dvec3 axis;    // first principal axis of the surface, to two digits
    double slender;     // L / r of the straight fit
    double residual;    // of the straight fit
    double volume = 0;  // of the straight fit's cylinder, over what the surface encloses; 0 where it is open
    int capacity = 0;   // of folds
    double rest_angle = 0;    // in degrees
    double arc_residual = 1;  // of the straight one's
};

fit::Geometry geometry(const mesh::VertexArrays& records) {
    return {records.positions, records.triangles};
}

double volume(const mesh::VertexArrays& records) {
    double six = 0;
    for (std::size_t t = 0; t < records.triangles.size(); t += 3) {
        const auto at = [&](std::size_t i) {
            return glm::dvec3(records.positions[records.triangles[t + i]]) - glm::dvec3(records.positions[0]);
        };
        six += glm::dot(at(0), glm::cross(at(1), at(2)));
    }
    return std::abs(six) / 6;
}

void check_model(const char* name, const Known& known) {
    const std::filesystem::path path = test::model(name);
    if (path.empty()) return;
    const mesh::VertexArrays records = mesh::vertex_arrays(mesh::load(path));
    const fit::Cylinder fitted = fit::fit_cylinder(geometry(records), std::nullopt, fit::RestPose::straight);
    CHECK_NOTHROW(fit::check(fitted));
    CHECK(test::angle_between_lines(fitted.axis, known.axis) < std::numbers::pi / 180);
    CHECK(std::abs(fitted.length / fitted.radius / known.slender - 1) < 3e-4);
    CHECK(std::abs(fitted.residual / known.residual - 1) < 6e-4);
    if (known.volume > 0) {
        const double base = std::numbers::pi * fitted.radius * fitted.radius * fitted.length;
        CHECK(std::abs(base / volume(records) / known.volume - 1) < 8e-4);
    }
    CHECK(fit::folds_capacity(geometry(records), fitted) == known.capacity);
    const fit::Cylinder arc = fit::fit_cylinder(geometry(records), std::nullopt, fit::RestPose::automatic);
    CHECK(std::abs(arc.rest_angle * 180 / std::numbers::pi - known.rest_angle) < 0.01);
    CHECK(std::abs(arc.residual / fitted.residual - known.arc_residual) < 4e-4);
}

}  // namespace

TEST_CASE("models: wine_bottle.glb") {
    check_model("wine_bottle.glb",
                {.axis = {0, 1, 0}, .slender = 9.631, .residual = 0.2537, .volume = 1.015});
}

TEST_CASE("models: WaterBottle.gltf") {
    check_model("WaterBottle.gltf", {.axis = {0, 1, 0}, .slender = 5.704, .residual = 0.1981});
}

TEST_CASE("models: banana.obj") {
    check_model("banana.obj", {.axis = {0.34, 0.94, -0.01},
                               .slender = 10.804,
                               .residual = 0.3366,
                               .volume = 1.193,
                               .capacity = 3,
                               .rest_angle = 99.17,
                               .arc_residual = 0.5});
}

TEST_CASE("models: blub_open.obj") {
    check_model("blub_open.obj",
                {.axis = {0, -0.015, 1}, .slender = 5.652, .residual = 0.5052, .capacity = 1});
}

TEST_CASE("models: log_01.glb") {
    check_model(
        "log_01.glb",
        {.axis = {0.04, 1, -0.03}, .slender = 6.597, .residual = 0.1079, .volume = 1.017, .capacity = 1});
}

TEST_CASE("models: insect_leg.glb") {
    check_model("insect_leg.glb", {.axis = {0.97, -0.24, 0},
                                   .slender = 13.23,
                                   .residual = 0.556,
                                   .capacity = 1,
                                   .rest_angle = 136.12,
                                   .arc_residual = 0.92});
}

TEST_CASE("models: insect_leg.glb gets a chain, wherever the last joint comes to lie") {
    const std::filesystem::path path = test::model("insect_leg.glb");
    if (path.empty()) return;
    const mesh::VertexArrays records = mesh::vertex_arrays(mesh::load(path));
    // Surfaces that are off by less than a thousandth of the length are found with other arcs.
    for (int seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        mesh::VertexArrays moved = records;
        const auto phase = 0.7f * static_cast<float>(seed);
        for (glm::vec3& p : moved.positions) p += 1e-4f * glm::sin(150.0f * glm::vec3(p.y, p.z, p.x) + phase);
        const fit::Cylinder chain = fit::fit_cylinder(geometry(moved), std::nullopt, fit::RestPose::chain);
        CHECK(chain.arcs.size() >= 4);
        for (const fit::RestArc& arc : chain.arcs) CHECK(arc.length > chain.radius / 2);
    }
}

TEST_CASE("models: cushion_02.glb") {
    check_model("cushion_02.glb",
                {.axis = {1, 0, 0}, .slender = 7.102, .residual = 0.3566, .volume = 1.0745, .capacity = 1});
}

TEST_CASE("models: fuze.ply") {
    check_model("fuze.ply", {.axis = {0, 0, 1}, .slender = 7.082, .residual = 0.2219, .volume = 1.034});
}

TEST_CASE("models: koala.obj") {
    check_model(
        "koala.obj",
        {.axis = {0, 0.25, 0.97}, .slender = 6.2505, .residual = 0.4031, .volume = 1.107, .capacity = 2});
}

TEST_CASE("models: lh_trochanterfemur.stl") {
    check_model("lh_trochanterfemur.stl", {.axis = {0, 0.02, 1},
                                           .slender = 14.41,
                                           .residual = 0.2723,
                                           .volume = 1.0583,
                                           .capacity = 1,
                                           .rest_angle = 35.16,
                                           .arc_residual = 0.802});
}

TEST_CASE("models: l_arista.stl") {
    check_model(
        "l_arista.stl",
        {.axis = {0.04, 0.99, -0.12}, .slender = 17.01, .residual = 0.7533, .volume = 1.456, .capacity = 11});
}

TEST_CASE("models: softball.obj has no long axis, and is fitted along any that is given") {
    const std::filesystem::path path = test::model("softball.obj");
    if (path.empty()) return;
    const mesh::VertexArrays records = mesh::vertex_arrays(mesh::load(path));
    CHECK_THROWS_WITH_AS(
        static_cast<void>(fit::fit_cylinder(geometry(records), std::nullopt, fit::RestPose::straight)),
        doctest::Contains("give an axis"), fit::AxisError);
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(1, 1, 1)}) {
        const fit::Cylinder fitted = fit::fit_cylinder(geometry(records), axis);
        CHECK(fitted.length / fitted.radius == doctest::Approx(2 / std::sqrt(2.0 / 3)).epsilon(0.02));
    }
}
