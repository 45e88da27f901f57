// SPDX-License-Identifier: MIT
#include "not_finite.hpp"
#include "support/bodies.hpp"

#include <goffer/bend/body_input.hpp>
#include <goffer/bend/job.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// The working range: whatever Body::check accepts, outputs are finite.

namespace goffer::test {
namespace {

using bend::WorkingRange;

/// 10^low..10^high, evenly over the exponents.
double power(Random& random, double low, double high) {
    return std::pow(10, uniform(random, low, high));
}

double random_sign(Random& random) {
    return random() % 2 == 0 ? -1 : 1;
}

/// A region and its vertices, of which some numbers are as large or as small as is allowed, or larger.
struct Wild {
    double radius = 1;
    bend::RegionInput region;
    std::vector<bend::RestVertex> vertices;
    std::vector<bend::RestVector> normals, tangents;
    std::vector<float> signs;

    explicit Wild(Random& random) {
        radius = power(random, -12, 12);
        region.length = power(random, -12, 12);
        const double most = std::min(region.length / (2 * radius), WorkingRange::max_angle);
        region.max_angle = random() % 2 == 0 ? most : most * power(random, -3, 0);
        if (random() % 2 == 0) region.rest_angle = region.max_angle * uniform(random, 0, 1);
        if (random() % 8 == 0) region.rest_angle = WorkingRange::max_rest * region.max_angle;
        region.rest_direction = uniform(random, -4, 4);
        if (random() % 3 == 0) region.onset = power(random, -13, 0);
        add_table(random);
        for (int i = 0; i < 20; ++i) add_vertex(random);
        region.vertex_count = vertices.size();
    }

    [[nodiscard]] std::optional<bend::Body> body() const {
        bend::BodyInput input;
        input.origin = {WorkingRange::max_origin, 0, -1};
        input.radius = radius;
        input.regions = {&region, 1};
        input.vertices = vertices;
        input.normals = normals;
        input.tangents = tangents;
        input.tangent_signs = signs;
        return bend::Body::make(input);
    }

private:
    void add_table(Random& random) {
        region.table.max_angle = static_cast<float>(region.max_angle);
        region.table.rows.resize(2 + random() % 20);
        const double depth = std::min(region.length, 1e37) * power(random, -3, 1),
                     fall = power(random, -2, 0);
        for (bend::WrinkleRow& row : region.table.rows) {
            double size = depth;
            for (float& coefficient : row) {
                coefficient = static_cast<float>(size * uniform(random, -1, 1));
                size *= fall;
            }
        }
        if (random() % 2 == 0) return;
        region.factors.max_angle = region.table.max_angle;
        region.factors.rows.resize(2);
        for (auto& row : region.factors.rows) row.fill(static_cast<float>(power(random, -2, 4)));
    }

    void add_vertex(Random& random) {
        bend::RestVertex v;
        v.beta = random() % 5 == 0 ? region.rest_direction : uniform(random, -4, 4);
        v.z = region.length * uniform(random, 0, 1);
        v.rho = random() % 9 == 0 ? 0 : std::min(radius * power(random, -2, 3), WorkingRange::max_length);
        v.wrinkle = random_sign(random) * power(random, -3, 1) / radius;
        v.slope = random_sign(random) * power(random, -3, 2) / region.length;
        vertices.push_back(v);
        const glm::dmat3 frame = random_rotation(random);
        normals.push_back({frame[0].x, frame[0].y, frame[0].z});
        tangents.push_back({frame[1].x, frame[1].y, frame[1].z});
        signs.push_back(1);
    }
};

/// How many outputs of `job` are not finite, or, of directions, longer than 1.
std::size_t bad_outputs(const bend::DeformJob& job, const Output& out) {
    bend::run(job);
    std::size_t bad = 0;
    for (std::size_t i = 0; i < job.body->vertex_count(); ++i) {
        bad += finite(out.position(i)) ? 0 : 1;
        for (const glm::dvec3& direction : {out.normal(i), out.tangent(i)})
            bad += finite(direction) && glm::length(direction) < 1.001 ? 0 : 1;
    }
    return bad;
}

}  // namespace

TEST_CASE("whatever a body is made of, within the working range its outputs are finite") {
    Random random(91);
    int made = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const Wild wild(random);
        const std::optional<bend::Body> body = wild.body();
        if (!body) continue;
        ++made;
        Output out(body->vertex_count());
        for (const Isa isa : isas_here()) {
            for (const float share : {0.0f, 1e-6f, -0.01f, 0.4f, 1.0f}) {
                const bend::Pose pose{share * body->max_angle(),
                                      static_cast<float>(uniform(random, -1000, 1000))};
                bend::DeformJob job = make_job(*body, pose, isa, out);
                job.transform = glm::mat4x3(trial % 2 == 0 ? 1.0f : 1e6f);
                CAPTURE(trial);
                CAPTURE(share);
                CHECK(bad_outputs(job, out) == 0);
            }
        }
    }
    MESSAGE(made, " bodies of 4000 are within the range");
    CHECK(made > 200);
}

TEST_CASE("bodies from the smallest to the largest keep their shape") {
    for (const double slenderness : {2.0, 20.0, 1e4}) {
        const double max_angle = std::min(0.99 * slenderness / 2, 6.0);
        for (const bool bent : {false, true}) {
            std::vector<std::vector<glm::dvec3>> shapes;
            for (const double length : {1.0, 1e-7, 1e-3, 1e6, 1e11}) {
                bend::RegionInput region;
                region.length = length;
                region.max_angle = max_angle;
                region.rest_angle = bent ? max_angle / 3 : 0;
                region.onset = bent ? 1e-3 : 0;
                region.table = fit::make_wrinkle_table(paper::Profile::damped, paper::Amplitude::paper, 1,
                                                       length, length / slenderness, max_angle, 64);
                std::vector<bend::RestVertex> vertices;
                for (int i = 0; i < 64; ++i) {
                    const double radius = length / slenderness;
                    vertices.push_back({0.1 * i, length * i / 63, radius, std::sin(0.5 * i) / radius, 0});
                }
                const std::vector<bend::RestVector> normals(vertices.size(), {1, 0, 0});
                region.vertex_count = vertices.size();
                bend::BodyInput input;
                input.radius = length / slenderness;
                input.regions = {&region, 1};
                input.vertices = vertices;
                input.normals = normals;
                CAPTURE(length);
                CAPTURE(slenderness);
                const bend::BodyFault fault = bend::Body::check(input);
                CAPTURE(std::string(bend::describe(fault).c_str()));
                REQUIRE(fault.none());
                const bend::Body body = std::move(bend::Body::make(input).value());
                Output out(body.vertex_count());
                bend::DeformJob job = make_job(body, {0.9f * body.max_angle(), 1}, Isa::automatic, out);
                bend::run(job);
                std::vector<glm::dvec3>& shape = shapes.emplace_back();
                for (std::size_t i = 0; i < vertices.size(); ++i) shape.push_back(out.position(i) / length);
                for (std::size_t i = 0; i < vertices.size(); ++i)
                    REQUIRE(glm::distance(shape[i], shapes[0][i]) < 1e-6);
            }
        }
    }
}

}  // namespace goffer::test
