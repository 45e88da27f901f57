// SPDX-License-Identifier: MIT
#include "support/models.hpp"

#include "synthetic.hpp"

#include <goffer/mesh/mesh.hpp>

#include <numbers>
#include <string>

using namespace goffer;

namespace {

struct Known {
    const char* name;
    glm::dvec3 axis;  // first principal axis of the surface, to two digits
    double slender;  // length over a quarter of the two widths: over 2 r of the box, so never below the fit's
    int capacity;    // at most
};

const Known known[] = {
    {"wine_bottle.glb", {0, 1, 0}, 8.2, 0},         {"WaterBottle.gltf", {0, 1, 0}, 4.8, 0},
    {"banana.obj", {0.34, 0.94, -0.01}, 6.9, 8},    {"blub_open.obj", {0, -0.015, 1}, 2.9, 4},
    {"log_01.glb", {0.04, 1, -0.03}, 5.2, 2},       {"insect_leg.glb", {0.97, -0.24, 0}, 7.8, 2},
    {"cushion_02.glb", {1, 0, 0}, 5.6, 2},          {"fuze.ply", {0, 0, 1}, 5.9, 2},
    {"koala.obj", {0, 0.25, 0.97}, 3.8, 8},         {"lh_trochanterfemur.stl", {0, 0.02, 1}, 10.0, 4},
    {"l_arista.stl", {0.04, 0.99, -0.12}, 6.4, 20},
};

mesh::VertexArrays read(const char* name) {
    const std::filesystem::path path = test::model(name);
    return path.empty() ? mesh::VertexArrays{} : mesh::vertex_arrays(mesh::load(path));
}

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

}  // namespace

TEST_CASE("real models: the long axis is found and the body is somewhat thinner than its box") {
    for (const Known& model : known) {
        CAPTURE(model.name);
        const mesh::VertexArrays records = read(model.name);
        if (records.positions.empty()) continue;
        const fit::Cylinder fitted = fit::fit_cylinder(geometry(records), std::nullopt, fit::Rest::straight);
        CHECK_NOTHROW(fit::check(fitted));
        CHECK(test::angle_between(fitted.axis, model.axis) < 2 * std::numbers::pi / 180);
        const double slender = fitted.length / fitted.radius;
        CHECK(slender > 0.98 * model.slender);
        CHECK(slender < 3 * model.slender);
        CHECK(fit::folds_capacity(geometry(records), fitted) <= model.capacity);
    }
}

TEST_CASE("real models, straight and round: L / r within 30 % of the box's") {
    for (const Known& model : known) {
        const std::string name = model.name;
        if (name != "wine_bottle.glb" && name != "WaterBottle.gltf" && name != "log_01.glb" &&
            name != "fuze.ply") {
            continue;
        }
        CAPTURE(model.name);
        const mesh::VertexArrays records = read(model.name);
        if (records.positions.empty()) continue;
        const fit::Cylinder fitted = fit::fit_cylinder(geometry(records), std::nullopt, fit::Rest::straight);
        CHECK(fitted.length / fitted.radius < 1.3 * model.slender);
    }
}

TEST_CASE("real models, closed: pi r^2 L is the enclosed volume within 15 %") {
    for (const char* name : {"wine_bottle.glb", "banana.obj", "log_01.glb", "cushion_02.glb", "fuze.ply",
                             "koala.obj", "lh_trochanterfemur.stl"}) {
        CAPTURE(name);
        const mesh::VertexArrays records = read(name);
        if (records.positions.empty()) continue;
        const fit::Cylinder fitted = fit::fit_cylinder(geometry(records), std::nullopt, fit::Rest::straight);
        const double base = std::numbers::pi * fitted.radius * fitted.radius * fitted.length;
        CHECK(base == doctest::Approx(volume(records)).epsilon(0.15));
    }
}

TEST_CASE("the softball has no long axis, and is fitted along any that is given") {
    const mesh::VertexArrays records = read("softball.obj");
    if (records.positions.empty()) return;
    CHECK_THROWS_WITH_AS(
        static_cast<void>(fit::fit_cylinder(geometry(records), std::nullopt, fit::Rest::straight)),
        doctest::Contains("--axis x|y|z|X,Y,Z"), fit::Error);
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(1, 1, 1)}) {
        const fit::Cylinder fitted = fit::fit_cylinder(geometry(records), axis);
        CHECK(fitted.length / fitted.radius == doctest::Approx(2 / std::sqrt(2.0 / 3)).epsilon(0.02));
    }
}
