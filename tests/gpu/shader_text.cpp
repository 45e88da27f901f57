// SPDX-License-Identifier: MIT
#include "support/accuracy.hpp"
#include "support/bound_case.hpp"

#include <goffer/bend/crowd.hpp>
#include <goffer/bend/kernel_input.hpp>
#include <goffer/gpu/source.hpp>
#include <goffer/gpu/vertices.hpp>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

/// The shader's text, compiled as C++, against the kernels and the closed form: what needs no GPU to be seen.

namespace goffer::test {
namespace {

namespace deform_shader {
using namespace glm;
namespace glsl {
#include <goffer/gpu/deform.glsl>
}  // namespace glsl

/// What goffer_row() reads.
const bend::Coefficients* coefficients = nullptr;

glm::vec4 glsl::goffer_row(int row) {
    glm::vec4 result;
    std::memcpy(&result, reinterpret_cast<const float*>(coefficients) + 4 * row, sizeof result);
    return result;
}

using namespace glsl;
}  // namespace deform_shader

/// The attributes of a vertex, read from its record as a GPU does.
class Attributes {
public:
    explicit Attributes(const bend::Body& body)
        : layout_(gpu::vertex_layout(body)), records_(body.vertex_count() * layout_.stride) {
        gpu::write_vertices(body, records_);
    }

    [[nodiscard]] deform_shader::GofferVertex vertex(std::size_t i) const {
        deform_shader::GofferVertex vertex{};
        vertex.column = at(i, layout_.column, 4);
        vertex.wrinkle = at(i, layout_.wrinkle, 4);
        vertex.normal = at(i, layout_.normal, 3);
        vertex.shape = at(i, layout_.shape, 4);
        vertex.tangent = at(i, layout_.tangent, 4);
        vertex.joint = at(i, layout_.joint, 4);
        return vertex;
    }

private:
    [[nodiscard]] glm::vec4 at(std::size_t i, std::size_t offset, std::size_t count) const {
        glm::vec4 value(0, 0, 0, 1);
        if (offset != gpu::VertexLayout::none)
            std::memcpy(&value, &records_[i * layout_.stride + offset], count * sizeof(float));
        return value;
    }

    gpu::VertexLayout layout_;
    std::vector<std::byte> records_;
};

/// The shader's results in place of the kernels'.
Output shaded(const bend::DeformJob& job) {
    const std::size_t count = job.body->vertex_count();
    const Attributes attributes(*job.body);
    std::vector<bend::Coefficients> coefficients(job.body->region_count(), unset());
    bend::set_up(batch_of(job), coefficients, job.isa);
    deform_shader::coefficients = coefficients.data();
    Output out(count);
    for (std::size_t i = 0; i < count; ++i) {
        const deform_shader::GofferBent bent = deform_shader::goffer_deform(attributes.vertex(i), 0);
        for (int c = 0; c < 3; ++c) {
            const auto column = static_cast<std::size_t>(c);
            out.columns[column][i] = bent.position[c];
            out.columns[3 + column][i] = bent.normal[c];
            out.columns[6 + column][i] = bent.tangent[c];
        }
        out.columns[9][i] = bent.tangent.w;
    }
    return out;
}

}  // namespace

TEST_CASE("the shader's text agrees with the double closed form, for bodies of every kind") {
    Random random(91);
    Worst worst;
    for (int trial = 0; trial < 24; ++trial) {
        CAPTURE(trial);
        const bool arcs = trial % 4 == 3;
        const BoundCase one = arcs ? random_arcs(random, 2 + random() % 4, {.folds = 20})
                                   : random_case(random, 1 + random() % 6, trial % 3 == 0);
        const std::size_t count = one.test_mesh.positions.size();
        const std::vector<bend::Pose> poses = random_poses(random, one.binding.body);
        const Expected expected(ChainReference(one.test_mesh, one.options, one.binding, poses), count);
        Output out(count);
        const Output shader = shaded(make_job(one.binding.body, poses, Isa::automatic, out));
        const Worst here(expected, shader, one.test_mesh.cylinder.length);
        CHECK(here.position <= 5e-6);
        const double most = arcs ? 0.05 : 0.01;  // the slope jumps where a wrinkle with an onset begins
        CHECK(here.normal <= most);
        CHECK(here.tangent <= most);
        CHECK(here.unit <= 1e-6);
        worst.add(here);
    }
    MESSAGE("position ", worst.position, " L, normal ", worst.normal, " deg, tangent ", worst.tangent,
            " deg");
}

TEST_CASE("the shader's text agrees with the kernels, under transforms and with weights") {
    Random random(92);
    for (int trial = 0; trial < 48; ++trial) {
        CAPTURE(trial);
        const BoundCase one = random_case(random, 1 + random() % 3, trial % 3 == 0);
        const std::size_t count = one.test_mesh.positions.size();
        std::vector<bend::Pose> poses = random_poses(random, one.binding.body);
        // As far as a body goes, beyond half a turn and a whole one.
        if (poses.size() == 1)
            poses[0].angle = static_cast<float>(uniform(random, 0.8, 1)) * one.binding.body.max_angle();
        Output kernels(count);
        bend::DeformJob job = make_job(one.binding.body, poses, Isa::automatic, kernels);
        const double length = one.test_mesh.cylinder.length;
        job.transform = random_transform(random, 2 * length);
        job.wrinkle_weight = trial % 4 == 0 ? 0.0f : static_cast<float>(uniform(random, 0, 1));
        bend::run(job);
        const Output shader = shaded(job);
        double size = 0;
        for (int c = 0; c < 3; ++c) size = std::max(size, static_cast<double>(glm::length(job.transform[c])));
        for (std::size_t i = 0; i < count; ++i) {
            REQUIRE(glm::distance(kernels.position(i), shader.position(i)) <= 5e-6 * size * length);
            // A transform may press two directions together by 1 : 10, and what rounding does with them.
            REQUIRE(angle_between(kernels.normal(i), shader.normal(i)) <= 0.02);
            REQUIRE(angle_between(kernels.tangent(i), shader.tangent(i)) <= 0.02);
            REQUIRE(kernels.columns[9][i] == shader.columns[9][i]);
        }
    }
}

TEST_CASE("a vertex has what its body has, and no more") {
    Random random(93);
    const bend::Body plain = loose_body(random, 20);
    gpu::VertexLayout expected{.stride = 60, .tangent = 44};
    CHECK(gpu::vertex_layout(plain) == expected);
    expected = {.stride = 76, .shape = 44, .tangent = 60};
    CHECK(gpu::vertex_layout(loose_shaped_body(random, 20)) == expected);
    expected = {.stride = 76, .tangent = 44, .joint = 60};
    bend::RegionInput regions[] = {loose_region(10), loose_region(10)};
    LooseVertices loose(random, 20, 0.11);
    std::ranges::sort(std::span(loose.vertices).first(10), {}, &bend::RestVertex::z);
    std::ranges::sort(std::span(loose.vertices).last(10), {}, &bend::RestVertex::z);
    regions[0].blend = 0.2;
    CHECK(gpu::vertex_layout(loose.body(regions)) == expected);
    const std::vector<bend::RestVertex> vertices(5, bend::RestVertex{.z = 0.5, .rho = 0.1});
    const std::vector<bend::RestVector> normals(5, bend::RestVector{1, 0, 0});
    CHECK(gpu::vertex_layout(bare_body(vertices, normals)) == gpu::VertexLayout());
}

TEST_CASE("set_up: every instance, whatever the masks say, and previous poses") {
    Random random(94);
    const std::size_t counts[] = {7, 9, 5};
    const bend::Body body = loose_chain(random, counts);
    constexpr std::size_t instances = 37;
    std::vector<bend::Pose> poses(3 * instances), previous(3 * instances);
    for (std::vector<bend::Pose>* column : {&poses, &previous}) {
        for (bend::Pose& pose : *column)
            pose = {static_cast<float>(uniform(random, -3, 3)), static_cast<float>(uniform(random, -4, 4))};
    }
    const std::vector<std::uint8_t> hidden(instances, 0);
    std::vector<std::uint32_t> backward(instances);
    for (std::uint32_t i = 0; i < instances; ++i) backward[i] = instances - 1 - i;
    bend::Batch batch{.body = &body, .count = instances, .indices = backward};
    batch.poses = {.data = poses.data(), .count = instances, .stride = 3 * sizeof(bend::Pose)};
    batch.previous_poses = {.data = previous.data(), .count = instances, .stride = 3 * sizeof(bend::Pose)};
    batch.visible = strided(std::span(hidden));
    std::vector<float> weights(instances);
    std::vector<glm::mat4x3> transforms(instances);
    for (std::size_t i = 0; i < instances; ++i) {
        weights[i] = i % 4 == 0 ? 0.0f : static_cast<float>(uniform(random, 0, 1));
        transforms[i] = random_transform(random, 1);
    }
    batch.wrinkle_weights = strided(std::span(weights));
    batch.transforms = batch.previous_transforms = strided(std::span(transforms));
    std::vector<bend::Coefficients> now(3 * instances, unset()), before(3 * instances, unset()), one(3);
    bend::set_up(batch, now);
    for (const bend::Coefficients& k : now) {  // zeros follow the vectors of the matrices
        for (const std::size_t last : {3u, 7u, 11u})
            CHECK((k.matrix[last] == 0 && k.normal_matrix[last] == 0));
        CHECK(k.offset[3] == 0);
    }
    bend::set_up_previous(batch, before);
    for (std::size_t i = 0; i < instances; ++i) {
        CAPTURE(i);
        const std::size_t element = instances - 1 - i;
        bend::DeformJob job{.body = &body, .poses = std::span(poses).subspan(3 * element, 3)};
        job.wrinkle_weight = weights[element];
        job.transform = transforms[element];
        bend::set_up(batch_of(job), one);
        REQUIRE(std::memcmp(one.data(), &now[3 * i], 3 * sizeof one[0]) == 0);
        job.poses = std::span(previous).subspan(3 * element, 3);
        bend::set_up(batch_of(job), one);
        REQUIRE(std::memcmp(one.data(), &before[3 * i], 3 * sizeof one[0]) == 0);
    }
}

TEST_CASE("the library has the text of the file") {
    std::ifstream file(GOFFER_SOURCE_DIR "/modules/gpu/include/goffer/gpu/deform.glsl");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    CHECK(!text.empty());
    CHECK(gpu::deform_glsl() == text);
    CHECK(gpu::deform_glsl().data()[text.size()] == '\0');
}

}  // namespace goffer::test
