// SPDX-License-Identifier: MIT
#include "gl.hpp"
#include "support/accuracy.hpp"
#include "support/bound_case.hpp"

#include <goffer/bend/crowd.hpp>
#include <goffer/bend/kernel_input.hpp>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <memory>
#include <span>
#include <string>
#include <vector>

/// The shader, run by OpenGL, against the kernels: crowds of bodies of every kind.

namespace goffer::test {
namespace {

/// Some instances of a body, in columns.
struct Crowd {
    static constexpr std::size_t instances = 7;

    const bend::Body& body;
    std::vector<bend::Pose> poses;
    std::vector<glm::mat4x3> transforms;
    std::vector<float> weights;

    Crowd(Random& random, const BoundCase& one) : body(one.binding.body) {
        for (std::size_t i = 0; i < instances; ++i) {
            const std::vector<bend::Pose> own = random_poses(random, body);
            poses.insert(poses.end(), own.begin(), own.end());
            glm::mat4x3 transform = random_transform(random, 1);
            for (int c = 0; c < 3; ++c) transform[c] /= glm::length(transform[c]);
            transforms.push_back(transform);
            weights.push_back(i % 3 == 1 ? 0.0f : static_cast<float>(uniform(random, 0, 1)));
        }
    }

    [[nodiscard]] bend::Batch batch() const {
        bend::Batch batch{.body = &body, .count = instances};
        batch.poses = {.data = poses.data(),
                       .count = instances,
                       .stride = static_cast<std::uint32_t>(body.region_count() * sizeof(bend::Pose))};
        batch.transforms = strided(std::span(transforms));
        batch.wrinkle_weights = strided(std::span(weights));
        return batch;
    }

    /// What the kernels make of it.
    [[nodiscard]] std::vector<GlVertex> deformed() const {
        std::vector<GlVertex> result(instances * body.vertex_count());
        bend::Batch batch = this->batch();
        batch.positions = interleaved<3>(result[0].position, result.size(), sizeof(GlVertex));
        batch.normals = interleaved<3>(result[0].normal, result.size(), sizeof(GlVertex));
        batch.tangents = interleaved<4>(result[0].tangent, result.size(), sizeof(GlVertex));
        batch.vertex_step = body.vertex_count();
        const bend::CrowdJob job{.batches = {&batch, 1}};
        REQUIRE(bend::validate(job).none());
        bend::run(job);
        return result;
    }

    [[nodiscard]] std::vector<GlVertex> deformed_by(GlDeformer& shader) const {
        const gpu::VertexLayout layout = gpu::vertex_layout(body);
        std::vector<std::byte> vertices(body.vertex_count() * layout.stride);
        gpu::write_vertices(body, vertices);
        std::vector<bend::Coefficients> coefficients(instances * body.region_count(), unset());
        bend::set_up(batch(), coefficients);
        const std::span<const float> rows(reinterpret_cast<const float*>(coefficients.data()),
                                          coefficients.size() * 4 * bend::coefficient_rows);
        return shader.run(vertices, layout, body.vertex_count(), rows, instances);
    }
};

glm::dvec3 vector(const float (&from)[3]) {
    return {from[0], from[1], from[2]};
}

void twins_agree(GlApi api, unsigned seed) {
    std::string why;
    const std::unique_ptr<GlDeformer> shader = GlDeformer::make(api, why);
    if (!shader) {
        MESSAGE("skipped: ", why);
        return;
    }
    Random random(seed);
    double position = 0, direction_of_arcs = 0, direction_of_others = 0;
    for (int trial = 0; trial < 12; ++trial) {
        CAPTURE(trial);
        const bool arcs = trial % 4 == 3;
        const BoundCase one =
            arcs ? random_arcs(random, 2 + random() % 4, {.folds = 20})
                 : random_case(random, 1 + static_cast<std::size_t>(trial) % 5, trial % 3 == 0);
        const Crowd crowd(random, one);
        const std::vector<GlVertex> expected = crowd.deformed(), is = crowd.deformed_by(*shader);
        const double length = one.test_mesh.cylinder.length;
        double direction = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const GlVertex &a = expected[i], &b = is[i];
            // Where an instance stands is in its transform, and in the rounding.
            const double size = length + glm::length(vector(a.position));
            take_worst(position, glm::distance(vector(a.position), vector(b.position)) / size);
            take_worst(direction, angle_between(vector(a.normal), vector(b.normal)));
            const glm::dvec3 along(a.tangent[0], a.tangent[1], a.tangent[2]);
            take_worst(direction, angle_between(along, {b.tangent[0], b.tangent[1], b.tangent[2]}));
            REQUIRE(a.tangent[3] == b.tangent[3]);
        }
        REQUIRE(position <= 5e-6);
        // The slope of a wrinkle with an onset jumps where it begins.
        REQUIRE(direction <= (arcs ? 0.05 : 0.02));
        take_worst(arcs ? direction_of_arcs : direction_of_others, direction);
    }
    MESSAGE(shader->device(), ": position ", position, " L, normals and tangents ", direction_of_others,
            " deg, of chains of arcs ", direction_of_arcs, " deg");
}

}  // namespace

TEST_CASE("shader: OpenGL 3.3, a vertex shader deforms as the kernels do") {
    twins_agree(GlApi::core, 95);
}

TEST_CASE("shader: OpenGL ES 3.0, a vertex shader deforms as the kernels do") {
    twins_agree(GlApi::embedded, 96);
}

TEST_CASE("shader: OpenGL 4.3, a compute shader deforms as the kernels do") {
    twins_agree(GlApi::compute, 97);
}

}  // namespace goffer::test
