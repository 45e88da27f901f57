// SPDX-License-Identifier: MIT
#include "support/accuracy.hpp"
#include "support/bodies.hpp"
#include "support/output_buffer.hpp"

#include <goffer/bend/bounds.hpp>
#include <goffer/bend/rest_vertex.hpp>

#include <doctest/doctest.h>

#include <string>
#include <vector>

/// An instance's transform: positions as a matrix takes them, normals and tangents as a surface's.

namespace goffer::test {
namespace {

struct Named {
    std::string name;
    glm::dmat3 linear;
};

std::vector<Named> transforms(Random& random) {
    const glm::dmat3 turn = random_rotation(random), other = random_rotation(random);
    const auto scale = [](double x, double y, double z) { return glm::dmat3(x, 0, 0, 0, y, 0, 0, 0, z); };
    const glm::dmat3 shear(1, 0, 0, 0.7, 1, 0, -0.4, 0.3, 1);
    return {{"rotation", turn},
            {"scale 1e-3", turn * scale(1e-3, 1e-3, 1e-3)},
            {"scale 1e3", turn * scale(1e3, 1e3, 1e3)},
            {"uneven scale", other * scale(0.2, 1, 3) * turn},
            {"very uneven scale", other * scale(0.02, 1, 1) * turn},
            {"shear", turn * shear},
            {"mirror", scale(-1, 1, 1)},
            {"mirror, uneven and turned", other * scale(0.5, -2, 1) * turn},
            {"point mirror", scale(-1, -1, -1)}};
}

/// Positions: of the output's size.
Worst compare_moved(const Output& moved, const Output& still, const glm::mat4x3& transform,
                    std::size_t count) {
    const glm::dmat3 linear{glm::dvec3(transform[0]), glm::dvec3(transform[1]), glm::dvec3(transform[2])};
    const glm::dvec3 offset(transform[3]);
    const glm::dmat3 of_normals = glm::transpose(glm::inverse(linear));
    double size = 0;
    for (std::size_t i = 0; i < count; ++i)
        size = std::max(size, glm::length(linear * still.position(i) + offset));
    Worst worst;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 expected = linear * still.position(i) + offset;
        take_worst(worst.position, glm::length(moved.position(i) - expected) / size);
        take_worst(worst.normal, angle_between(moved.normal(i), of_normals * still.normal(i)));
        take_worst(worst.tangent, angle_between(moved.tangent(i), linear * still.tangent(i)));
        take_worst(worst.unit, std::fabs(glm::length(moved.normal(i)) - 1));
        take_worst(worst.unit, std::fabs(glm::length(moved.tangent(i)) - 1));
    }
    return worst;
}

}  // namespace

TEST_CASE("a transform does to every stream what it would do to the surface") {
    Random random(71);
    Worst worst;
    for (int trial = 0; trial < 12; ++trial) {
        const TestMesh test_mesh =
            random_mesh(random, uniform(random, 3, 30), std::pow(10, uniform(random, -2, 2)));
        const fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder);
        const std::size_t count = test_mesh.positions.size();
        Output still(count), moved(count);
        const auto limit = static_cast<double>(binding.body.max_angle());
        const bend::Pose pose{static_cast<float>(uniform(random, -limit, limit)),
                              static_cast<float>(uniform(random, -9, 9))};
        for (const Isa isa : isas_here()) {
            bend::run(make_job(binding.body, pose, isa, still));
            for (const Named& transform : transforms(random)) {
                const glm::dmat3& linear = transform.linear;
                CAPTURE(transform.name);
                CAPTURE(name(isa));
                bend::DeformJob job = make_job(binding.body, pose, isa, moved);
                const glm::dvec3 offset =
                    glm::length(linear[1]) * test_mesh.cylinder.length * glm::dvec3(0.3, -1, 0.5);
                job.transform = {glm::vec3(linear[0]), glm::vec3(linear[1]), glm::vec3(linear[2]),
                                 glm::vec3(offset)};
                REQUIRE(bend::validate(job).none());
                bend::run(job);
                const Worst one = compare_moved(moved, still, job.transform, count);
                CHECK(one.position <= 2e-6);
                CHECK(one.normal <= 1e-3);
                CHECK(one.tangent <= 6e-4);
                CHECK(one.unit <= 1e-6);
                const bool mirrors = glm::determinant(linear) < 0;
                for (std::size_t i = 0; i < count; ++i)
                    REQUIRE(moved.columns[9][i] == (mirrors ? -1 : 1) * still.columns[9][i]);
                worst.add(one);
            }
        }
    }
    MESSAGE("position ", worst.position, " of the size, normal ", worst.normal, " deg, tangent ",
            worst.tangent, " deg, unit ", worst.unit);
}

TEST_CASE("the unit transform changes no bit") {
    Random random(72);
    const bend::Body body = loose_body(random, 300);
    constexpr std::string_view picture = "x y z u v w a b c d p q r 123";
    for (const Isa isa : isas_here()) {
        OutputBuffer plain(picture, 300), unit(picture, 300);
        bend::DeformJob job{.body = &body, .pose = {1.3f, 2}, .isa = isa};
        plain.attach(job);
        bend::run(job);
        job.transform = job.previous_transform = glm::mat4x3(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0);
        unit.attach(job);
        bend::run(job);
        CHECK(unit.fault(plain) == "");
    }
}

TEST_CASE("outward stays outward") {
    std::vector<bend::RestVertex> vertices;
    std::vector<bend::RestVector> normals;
    for (int i = 0; i < 64; ++i) {
        vertices.push_back({i * 0.1, 0.015 * i, 0.1, 0, 0});
        normals.push_back({1, 0, 0});
    }
    const bend::Body body = bare_body(vertices, normals);
    Random random(73);
    Output out(64);
    for (const Isa isa : isas_here()) {
        for (const Named& transform : transforms(random)) {
            const glm::dmat3& linear = transform.linear;
            CAPTURE(transform.name);
            bend::DeformJob job = make_job(body, bend::Pose{}, isa, out);
            job.transform = {glm::vec3(linear[0]), glm::vec3(linear[1]), glm::vec3(linear[2]), glm::vec3(0)};
            bend::run(job);
            for (std::size_t i = 0; i < 64; ++i) {
                const glm::dvec3 axis = linear * glm::dvec3(0, 0, vertices[i].z);
                REQUIRE(glm::dot(out.normal(i), out.position(i) - axis) > 0);
            }
        }
    }
}

TEST_CASE("transforms that flatten, and of any size, give no NaN") {
    Random random(74);
    const bend::Body body = loose_body(random, 200);
    const glm::mat3 turn(random_rotation(random));
    const auto diagonal = [](float x, float y, float z) { return glm::mat3(x, 0, 0, 0, y, 0, 0, 0, z); };
    std::vector<glm::mat3> matrices{diagonal(0, 0, 0), diagonal(1, 1, 0), diagonal(0, 0, 1),
                                    turn * diagonal(1, 0, 1) * turn, glm::mat3(1, 2, 3, 1, 2, 3, 1, 2, 3)};
    for (const float size : {1e-40f, 1e-30f, 1e-18f, 1e-14f, 1e-11f, 1e-6f, 1e6f, 1e11f, 1e18f}) {
        matrices.push_back(size * turn);
        matrices.push_back(diagonal(size, 1, 1));
        matrices.push_back(diagonal(size, size, 1));
    }
    const std::size_t singular = 5;
    for (const Isa isa : isas_here()) {
        for (std::size_t m = 0; m < matrices.size(); ++m) {
            const glm::mat3& linear = matrices[m];
            CAPTURE(linear[0].x);
            CAPTURE(linear[1].y);
            CAPTURE(linear[2].z);
            CAPTURE(name(isa));
            OutputBuffer out("x y z u v w a b c d 123", 200);
            bend::DeformJob job{.body = &body, .pose = {1.5f, 0.5f}, .isa = isa};
            job.transform = {linear[0], linear[1], linear[2], glm::vec3(0.5f)};
            out.attach(job);
            REQUIRE(bend::validate(job).none());
            bend::Bounds box;
            job.bounds = &box;
            bend::run(job);
            double longest = 0, shortest = 1;
            for (std::size_t i = 0; i < 200; ++i) {
                for (const char c : {'x', 'y', 'z', 'u', 'v', 'w', 'a', 'b', 'c'})
                    REQUIRE(std::isfinite(out.value(c, i)));
                const glm::dvec3 normal(out.value('u', i), out.value('v', i), out.value('w', i));
                const glm::dvec3 tangent(out.value('a', i), out.value('b', i), out.value('c', i));
                longest = std::max({longest, glm::length(normal), glm::length(tangent)});
                shortest = std::min({shortest, glm::length(normal), glm::length(tangent)});
            }
            for (int axis = 0; axis < 3; ++axis)
                CHECK((std::isfinite(box.high[axis] - box.low[axis]) && box.low[axis] <= box.high[axis]));
            CHECK(longest <= 1 + 1e-6);
            const glm::dmat3 columns(linear);
            const double least =
                std::min({glm::length(columns[0]), glm::length(columns[1]), glm::length(columns[2])});
            const double size = std::fabs(glm::determinant(columns));
            if (m >= singular && (size > 1e-34 || least > 5e-15) && size < 1e34) CHECK(shortest >= 1 - 1e-6);
        }
    }
}

}  // namespace goffer::test
