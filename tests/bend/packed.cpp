// SPDX-License-Identifier: MIT
#include "support/accuracy.hpp"
#include "support/bodies.hpp"
#include "support/output_buffer.hpp"
#include "support/unpacked.hpp"

#include <goffer/bend/bounds.hpp>
#include <goffer/bend/crowd.hpp>
#include <goffer/bend/packed.hpp>
#include <goffer/bend/rest_vertex.hpp>

#include <doctest/doctest.h>

#include <span>
#include <vector>

/// The packed stream, as the GPU's side reads it: decoded by the same text that shaders include. Where it is
/// written is layouts.cpp's matter.

namespace goffer::test {
namespace {

namespace hlsl {
using namespace glm;
using float2 = vec2;
using float3 = vec3;
using uint3 = uvec3;
#include <goffer/bend/packed.hlsl>
}  // namespace hlsl

/// What a GPU makes of R16G16B16A16_UNORM and R16G16_SNORM.
glm::vec3 unorm(const std::uint16_t (&steps)[3]) {
    return glm::vec3(steps[0], steps[1], steps[2]) / 65535.0f;
}
glm::vec2 snorm(const std::int16_t (&steps)[2]) {
    return glm::max(glm::vec2(steps[0], steps[1]) / 32767.0f, -1.0f);
}

/// Between what is decoded and what the planes hold: positions beyond half a step of the bounds, of `size`,
/// the output's numbers, which is what floats round by.
Worst compare_decoded(std::span<const bend::PackedVertex> packed, const bend::Bounds& box,
                      const Output& planes, double size) {
    Worst worst;
    std::size_t different = 0;  // by the way on which a shader gets them
    for (std::size_t i = 0; i < packed.size(); ++i) {
        const glm::vec3 position = shader::goffer_position(words(packed[i]), box.low, box.high);
        const glm::vec3 normal = shader::goffer_normal(words(packed[i]));
        if (shader::goffer_position(unorm(packed[i].position), box.low, box.high) != position ||
            hlsl::goffer_position(words(packed[i]), box.low, box.high) != position ||
            shader::goffer_normal(snorm(packed[i].normal)) != normal ||
            hlsl::goffer_normal(words(packed[i])) != normal ||
            hlsl::goffer_normal(snorm(packed[i].normal)) != normal)
            ++different;
        const glm::dvec3 decoded(position);
        for (int axis = 0; axis < 3; ++axis) {
            const double half_step = static_cast<double>(box.high[axis] - box.low[axis]) / 131070;
            take_worst(worst.position,
                       (std::fabs(decoded[axis] - planes.position(i)[axis]) - half_step) / size);
        }
        take_worst(worst.normal, angle_between(glm::dvec3(normal), planes.normal(i)));
    }
    CHECK(different == 0);
    return worst;
}

/// Length of the body and distance from the origin, in the outputs' space.
double size_of(const bend::Body& body, const glm::mat4x3& transform) {
    double size = 0;
    for (int c = 0; c < 3; ++c)
        size = std::max(size,
                        glm::length(glm::dvec3(transform[c])) * (body.length() + glm::length(body.origin())));
    return size + glm::length(glm::dvec3(transform[3]));
}

/// Planes and packed vertices of one run of `job`.
Worst run(bend::DeformJob job, Output& planes, bend::Stores stores) {
    const std::size_t count = job.body->vertex_count();
    std::vector<bend::PackedVertex> packed(count);
    bend::Bounds box;
    job.tangents = {};
    job.packed = {packed.data(), sizeof(bend::PackedVertex), count};
    job.bounds = &box;
    const bend::Batch batch = bend::batch_of(job);
    const bend::CrowdJob crowd{.batches = {&batch, 1}, .stores = stores, .isa = job.isa};
    REQUIRE(bend::validate(crowd).none());
    bend::run(crowd);
    for (const bend::PackedVertex& vertex : packed) REQUIRE(vertex.unused == 0);
    return compare_decoded(packed, box, planes, size_of(*job.body, job.transform));
}

}  // namespace

TEST_CASE("packed vertices decode to the positions and normals of planes") {
    Random random(51);
    Worst worst;
    for (int trial = 0; trial < 30; ++trial) {
        const TestMesh test_mesh =
            random_mesh(random, uniform(random, 3, 40), std::pow(10, uniform(random, -3, 3)));
        fit::BindOptions options;
        options.folds = static_cast<int>(random() % 13);
        const fit::Binding binding = fit::bind(test_mesh.geometry(), test_mesh.cylinder, options);
        Output out(test_mesh.positions.size());
        for (int k = 0; k < 5; ++k) {
            const auto limit = static_cast<double>(binding.body.max_angle());
            const bend::Pose pose{static_cast<float>(uniform(random, -limit, limit)),
                                  static_cast<float>(uniform(random, -9, 9))};
            for (const Isa isa : isas_here()) {
                bend::DeformJob job = make_job(binding.body, pose, isa, out);
                if (k > 0) job.transform = random_transform(random, test_mesh.cylinder.length);
                const Worst one =
                    run(job, out, k % 2 == 0 ? bend::Stores::cached : bend::Stores::non_temporal);
                INFO("trial ", trial, " angle ", pose.angle, " ", name(isa));
                CHECK(one.position <= 1e-6);
                CHECK(one.normal <= 0.004);
                worst.add(one);
            }
        }
    }
    MESSAGE("position beyond half a step: ", worst.position, " of the size, normal ", worst.normal, " deg");
}

TEST_CASE("normals along axes and edges of the octahedron are packed as well") {
    std::vector<bend::RestVertex> vertices;
    std::vector<bend::RestVector> normals;
    for (int code = 0; code < 27; ++code) {
        const glm::dvec3 n(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
        if (code == 13) continue;
        const glm::dvec3 unit = glm::normalize(n);
        normals.push_back({unit.x, unit.y, unit.z});
        vertices.push_back({0, 0.5, 0.1, 0, 0});
    }
    const bend::Body body = bare_body(vertices, normals);
    Output out(vertices.size());
    for (const Isa isa : isas_here()) {
        const Worst worst = run(make_job(body, bend::Pose{}, isa, out), out, bend::Stores::cached);
        CHECK(worst.position <= 1e-6);
        CHECK(worst.normal <= 0.004);
        for (std::size_t i = 0; i < normals.size(); ++i) {
            REQUIRE(angle_between(out.normal(i), {normals[i].rho, normals[i].beta, normals[i].z}) < 1e-5);
        }
    }
}

TEST_CASE("bodies that are flat, or flattened, keep their places") {
    Random random(52);
    std::vector<bend::RestVertex> vertices(100);
    const std::vector<bend::RestVector> normals(100, {0, 0, 1});
    for (bend::RestVertex& v : vertices)
        v = {uniform(random, -4, 4), 0.5 + 1e-6 * uniform(random, 0, 1), uniform(random, 0, 0.1), 0, 0};
    const bend::Body flat = bare_body(vertices, normals);
    const bend::Body round = loose_body(random, 100);
    Output out(100);
    for (const Isa isa : isas_here()) {
        for (const float depth : {1.0f, 1e-3f, 1e-7f, 0.0f}) {
            const glm::mat4x3 transform(1, 0, 0, 0, depth, 0, 0, 0, 1, 0, 0, 0);
            bend::DeformJob job = make_job(flat, bend::Pose{}, isa, out);
            job.transform = transform;
            CHECK(run(job, out, bend::Stores::cached).position <= 1e-6);
            job = make_job(round, {1.5f, 0.5f}, isa, out);
            job.transform = transform;
            CHECK(run(job, out, bend::Stores::cached).position <= 1e-6);
        }
    }
}

TEST_CASE("packed: a box that is too thin or too long for float to count its steps") {
    Random random(5);
    const bend::Body body = loose_body(random, 40);
    for (const Isa isa : isas_here()) {
        for (const float size : {1e-36f, 1e-34f, 1e-32f, 1e36f, 1e38f, 3.4e38f}) {
            CAPTURE(name(isa));
            CAPTURE(size);
            std::vector<bend::PackedVertex> packed(body.vertex_count());
            bend::Bounds box;
            bend::DeformJob job{.body = &body, .pose = {.angle = 1}, .isa = isa};
            for (int axis = 0; axis < 3; ++axis) job.transform[axis][axis] = size;
            job.packed = {packed.data(), sizeof(bend::PackedVertex), packed.size()};
            job.bounds = &box;
            bend::run(job);
            const bool counted = box.high.x - box.low.x > 1e-33f && box.high.x - box.low.x < 1e38f;
            std::uint16_t largest = 0;
            for (const bend::PackedVertex& vertex : packed) largest = std::max(largest, vertex.position[0]);
            CHECK((largest > 30000) == counted);
            const glm::vec3 decoded = shader::goffer_position(words(packed[0]), box.low, box.high);
            CHECK((std::isfinite(decoded.x) || !std::isfinite(box.high.x - box.low.x)));
        }
    }
}

}  // namespace goffer::test
