// SPDX-License-Identifier: MIT
#pragma once

#include "support/angles.hpp"

#include <goffer/bend/body_input.hpp>
#include <goffer/bend/job.hpp>
#include <goffer/engine/columns.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/paper/closed_form.hpp>

#include <glm/geometric.hpp>
#include <glm/mat4x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>
#include <span>
#include <utility>
#include <vector>

/// Random bodies and the double reference of their deformation.

namespace goffer::test {

using Random = std::mt19937;

inline double uniform(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

inline glm::dmat3 random_rotation(Random& random) {
    const auto direction = [&] {
        std::normal_distribution<double> normal;
        return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    };
    const glm::dvec3 z = direction();
    const glm::dvec3 x = glm::normalize(glm::cross(direction(), z));
    return {x, glm::cross(z, x), z};
}

/// A mesh in memory with its base cylinder. Bumpy skin, both caps, some inner vertices, vertices on the axis,
/// on the outer line and at mid-height: everywhere where the map is special.
struct TestMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;
    std::vector<std::uint32_t> triangles;
    fit::Cylinder cylinder;

    [[nodiscard]] fit::Geometry geometry() const { return {positions, triangles, normals, tangents}; }
};

inline void add_vertex(TestMesh& test_mesh, Random& random, const glm::dmat3& axes, double beta, double z,
                       double rho) {
    const glm::dvec3 local(rho * std::cos(beta), rho * std::sin(beta), z);
    test_mesh.positions.emplace_back(test_mesh.cylinder.origin + axes * local);
    // Any normal will do: the map does not ask where it comes from.
    const glm::dmat3 frame = random_rotation(random);
    test_mesh.normals.emplace_back(frame[0]);
    test_mesh.tangents.emplace_back(glm::vec3(frame[1]), random() % 2 == 0 ? 1.0f : -1.0f);
}

/// `slenderness` is L / r; `scale` the length. At least 8 x 9 vertices on the skin, and about `extra`
/// elsewhere.
inline TestMesh random_mesh(Random& random, double slenderness, double scale, int columns = 24, int rows = 33,
                            int extra = 100) {
    TestMesh test_mesh;
    const glm::dmat3 axes = random_rotation(random);
    fit::Cylinder& c = test_mesh.cylinder;
    c.length = scale;
    c.radius = scale / slenderness;
    c.axis = axes[2];
    c.zero = axes[0];
    c.origin = scale * glm::dvec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double beta = 2 * std::numbers::pi * column / columns;
            add_vertex(test_mesh, random, axes, beta, scale * row / (rows - 1),
                       c.radius * uniform(random, 0.9, 1.1));
            if (row + 1 == rows) continue;
            const auto index = [&](int r, int k) {
                return static_cast<std::uint32_t>(r * columns + k % columns);
            };
            const std::uint32_t a = index(row, column), b = index(row, column + 1),
                                d = index(row + 1, column);
            test_mesh.triangles.insert(test_mesh.triangles.end(),
                                       {a, b, d, b, index(row + 1, column + 1), d});
        }
    }
    for (int i = 0; i < extra; ++i) {
        const double rho = i % 10 == 0 ? 0 : c.radius * uniform(random, 0, 1.1);
        const double z = i % 7 == 0 ? scale / 2 : i % 11 == 0 ? 0 : scale * uniform(random, 0, 1);
        add_vertex(test_mesh, random, axes, uniform(random, -4, 4), z, rho);
    }
    return test_mesh;
}

/// Any profile.
inline paper::Profile random_profile(Random& random) {
    const paper::Profile even{paper::Profile::Kind::even, uniform(random, 0, 0.5)};
    const paper::Profile profiles[] = {paper::Profile::damped, paper::Profile::smooth, even};
    return profiles[random() % 3];
}

/// Vertices that no mesh need have, for tests that ask where values go: heights up to 1, up to `widest` from
/// the axis.
struct LooseVertices {
    std::vector<bend::RestVertex> vertices;
    std::vector<bend::RestVector> normals, tangents;
    std::vector<float> signs;

    LooseVertices(Random& random, std::size_t count, double widest)
        : vertices(count), normals(count), tangents(count), signs(count) {
        for (std::size_t i = 0; i < count; ++i) {
            const double rho = i % 10 == 3 ? 0 : uniform(random, 0, widest);
            const double depth = rho < 0.05 ? 20 : 1 / rho;
            vertices[i] = {uniform(random, -4, 4), uniform(random, 0, 1), rho, depth * uniform(random, -1, 1),
                           uniform(random, -20, 20)};
            const glm::dmat3 frame = random_rotation(random);
            normals[i] = {frame[0].x, frame[0].y, frame[0].z};
            tangents[i] = {frame[1].x, frame[1].y, frame[1].z};
            signs[i] = random() % 2 == 0 ? 1.0f : -1.0f;
        }
    }

    /// Gives them the shape of a body that no mesh need have, up to max_scale times as thick.
    void add_shape(Random& random) {
        const double roughness = random() % 2 == 0 ? 0.01 : 0;
        for (bend::RestVertex& v : vertices) {
            v.scale = uniform(random, 0.3, max_scale);
            v.scale_slope = uniform(random, -1, 1);
            v.drift = 0.1 * v.z * (1 - v.z) + roughness * uniform(random, -1, 1);
        }
    }
    static constexpr double max_scale = 1.4;

    /// A body of them. Radius 0.1.
    [[nodiscard]] bend::Body body(std::span<const bend::RegionInput> regions) const {
        bend::BodyInput input;
        input.radius = 0.1;
        input.regions = regions;
        input.vertices = vertices;
        input.normals = normals;
        input.tangents = tangents;
        input.tangent_signs = signs;
        return std::move(bend::Body::make(input).value());
    }
};

/// A region of length 1 with three folds.
inline bend::RegionInput loose_region(std::size_t vertex_count) {
    static const bend::WrinkleTable table =
        fit::make_wrinkle_table(paper::Profile::damped, paper::Amplitude::paper, 3, 1, 0.1, 4.9, 32);
    return {.length = 1, .max_angle = 4.9, .table = table, .vertex_count = vertex_count};
}

/// Such a region of vertices with a shape.
inline bend::RegionInput loose_shaped_region(std::size_t vertex_count) {
    static const bend::WrinkleTable table = fit::make_wrinkle_table(
        paper::Profile::even, paper::Amplitude::paper, 6, 1, 0.1, 3.5, 32, LooseVertices::max_scale);
    bend::RegionInput region{.length = 1, .max_angle = 3.5, .table = table, .vertex_count = vertex_count};
    region.max_scale = LooseVertices::max_scale;
    return region;
}

/// The same as loose_body, with a shape.
inline bend::Body loose_shaped_body(Random& random, std::size_t count, double widest = 0.11) {
    bend::RegionInput region = loose_shaped_region(count);
    if (random() % 3 == 0) region.rest_angle = uniform(random, 0.1, 2);
    LooseVertices loose(random, count, widest);
    loose.add_shape(random);
    return loose.body({&region, 1});
}

/// A body of one region of any vertices at all. Length 1, radius 0.1, three folds.
inline bend::Body loose_body(Random& random, std::size_t count, double widest = 0.11) {
    const bend::RegionInput region = loose_region(count);
    return LooseVertices(random, count, widest).body({&region, 1});
}

/// Lets wrinkles pass over some joints of `regions`, of length 1, and sorts the vertices as these ask for.
inline void blend_some(Random& random, std::span<bend::RegionInput> regions,
                       std::span<bend::RestVertex> vertices) {
    for (std::size_t r = 0; r + 1 < regions.size(); ++r) {
        const bend::RegionInput &own = regions[r], &next = regions[r + 1];
        const auto compares = [](const bend::RegionInput& region) {
            return region.rest_angle != 0 || region.onset != 0;
        };
        if (random() % 3 == 0 || compares(own) != compares(next)) continue;
        regions[r].blend = uniform(random, 0.1, 0.5);
        regions[r].blend_gain = uniform(random, 0.5, 2);
    }
    for (const bend::RegionInput& region : regions) {
        std::ranges::sort(vertices.first(region.vertex_count), {}, &bend::RestVertex::z);
        vertices = vertices.subspan(region.vertex_count);
    }
}

/// The same of a region for each of `counts`, with so many vertices. Some regions are bent at rest, some have
/// an onset or factors of their own, and some wrinkle over their joints.
inline bend::Body loose_chain(Random& random, std::span<const std::size_t> counts) {
    std::vector<bend::RegionInput> regions;
    std::size_t sum = 0;
    for (const std::size_t count : counts) {
        bend::RegionInput& region = regions.emplace_back(loose_region(count));
        if (random() % 3 == 0) region.rest_angle = uniform(random, 0.1, 3);
        if (random() % 3 == 0) region.rest_direction = uniform(random, -3, 3);
        if (random() % 3 == 0) region.onset = uniform(random, 0, 0.1);
        if (random() % 3 == 0) {
            region.factors.max_angle = 4.9f;
            region.factors.rows.resize(8);
            for (auto& row : region.factors.rows) {
                for (float& square : row) square = static_cast<float>(uniform(random, -0.2, 2));
            }
        }
        sum += count;
    }
    LooseVertices loose(random, sum, 0.11);
    blend_some(random, regions, loose.vertices);
    return loose.body(regions);
}

/// What a body of these is made from. All but the radius must outlive it.
inline bend::BodyInput input_of(std::span<const bend::RegionInput> regions,
                                std::span<const bend::RestVertex> vertices,
                                std::span<const bend::RestVector> normals, double radius = 0.1) {
    bend::BodyInput input;
    input.radius = radius;
    input.regions = regions;
    input.vertices = vertices;
    input.normals = normals;
    return input;
}

/// A body of these vertices, without wrinkles. Length 1, radius 0.1.
inline bend::Body bare_body(std::span<const bend::RestVertex> vertices,
                            std::span<const bend::RestVector> normals) {
    const bend::RegionInput region{.length = 1, .max_angle = 4, .vertex_count = vertices.size()};
    return std::move(bend::Body::make(input_of({&region, 1}, vertices, normals)).value());
}

/// A rotation, scaled, sheared and mirrored or not; `distance` from the origin at most.
inline glm::mat4x3 random_transform(Random& random, double distance) {
    glm::dmat3 linear = random_rotation(random);
    if (random() % 2 == 0) linear *= std::pow(10, uniform(random, -1, 1));
    if (random() % 3 == 0) {
        for (int c = 0; c < 3; ++c) linear[c] *= uniform(random, 0.3, 3) * (random() % 4 == 0 ? -1 : 1);
        linear = random_rotation(random) * linear;
    }
    const glm::dvec3 offset =
        distance * glm::dvec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    return {glm::vec3(linear[0]), glm::vec3(linear[1]), glm::vec3(linear[2]), glm::vec3(offset)};
}

/// The instruction sets that are built and run here.
inline std::vector<Isa> isas_here() {
    std::vector<Isa> result;
    std::ranges::copy_if(built_isas(), std::back_inserter(result), runs_here);
    return result;
}

/// Planar output of every stream, with room to see writes out of bounds.
struct Output {
    Columns columns;

    explicit Output(std::size_t count) : columns(10, count) {}

    [[nodiscard]] glm::dvec3 vector(std::size_t first, std::size_t i) const {
        return {columns[first][i], columns[first + 1][i], columns[first + 2][i]};
    }
    [[nodiscard]] glm::dvec3 position(std::size_t i) const { return vector(0, i); }
    [[nodiscard]] glm::dvec3 normal(std::size_t i) const { return vector(3, i); }
    [[nodiscard]] glm::dvec3 tangent(std::size_t i) const { return vector(6, i); }
};

inline bend::DeformJob make_job(const bend::Body& body, const bend::Pose& pose, Isa isa, Output& out) {
    bend::DeformJob job;
    job.body = &body;
    job.pose = pose;
    job.isa = isa;
    job.positions = planar(out.columns[0], out.columns[1], out.columns[2]);
    job.normals = planar(out.columns[3], out.columns[4], out.columns[5]);
    if (body.has_tangents()) {
        job.tangents = planar(out.columns[6], out.columns[7], out.columns[8], out.columns[9]);
    }
    return job;
}

/// What the reference takes for a region of a bound body.
inline paper::Parameters parameters_of(const fit::Binding& binding, const fit::BindOptions& options,
                                       std::size_t region) {
    const fit::RegionBinding& found = binding.regions[region];
    const fit::Cylinder& cylinder = binding.cylinder;
    paper::Parameters body{found.length, found.shape ? found.shape->radius() : cylinder.radius, found.wave,
                           options.profile, options.amplitude};
    body.rest_angle = cylinder.rest_angle * body.length / cylinder.length;
    body.rest_direction = cylinder.rest_direction;
    if (!cylinder.arcs.empty()) {
        body.rest_angle = cylinder.arcs[region].angle;
        body.rest_direction = cylinder.arcs[region].direction;
    }
    body.onset = static_cast<double>(binding.body.regions()[region].onset);
    body.shape = found.shape;
    return body;
}

/// Gives the base of `test_mesh` radii of its own, from 0.3 to 1.7 of its radius.
inline void add_radii(TestMesh& test_mesh, Random& random) {
    fit::Cylinder& c = test_mesh.cylinder;
    const double taper = uniform(random, -0.6, 0.6), wave = uniform(random, 0, 0.1);
    constexpr int knots = 13;
    for (int i = 0; i < knots; ++i) {
        const double t = 2.0 * i / (knots - 1) - 1;
        c.radii.push_back(c.radius * (1 + taper * t + wave * uniform(random, -1, 1)));
    }
    c.radius = paper::Spline(c.length, c.radii).mean();
}

/// The closed form of `test_mesh`'s deformation in double, in model space, from the positions as float holds
/// them.
class Reference {
public:
    Reference(const TestMesh& test_mesh, const fit::BindOptions& options, const fit::Binding& binding,
              const bend::Pose& pose)
        : test_mesh_(test_mesh),
          axes_(test_mesh.cylinder.zero, glm::cross(test_mesh.cylinder.axis, test_mesh.cylinder.zero),
                test_mesh.cylinder.axis),
          map_(parameters_of(binding, options, 0),
               {static_cast<double>(pose.angle), static_cast<double>(pose.direction)}) {}

    [[nodiscard]] glm::dvec3 position(std::size_t i) const {
        return test_mesh_.cylinder.origin + axes_ * map_.position(rest(i));
    }
    [[nodiscard]] glm::dvec3 normal(std::size_t i) const {
        return axes_ * map_.normal(rest(i), components(glm::dvec3(test_mesh_.normals[i]), rest(i).beta));
    }
    [[nodiscard]] glm::dvec3 tangent(std::size_t i) const {
        return axes_ * map_.tangent(rest(i), components(glm::dvec3(test_mesh_.tangents[i]), rest(i).beta));
    }

private:
    [[nodiscard]] paper::Cylindrical rest(std::size_t i) const {
        return paper::to_cylindrical(glm::transpose(axes_) *
                                     (glm::dvec3(test_mesh_.positions[i]) - test_mesh_.cylinder.origin));
    }
    [[nodiscard]] paper::CylindricalVector components(const glm::dvec3& vector, double beta) const {
        const glm::dvec3 v = glm::transpose(axes_) * glm::normalize(vector);
        const double c = std::cos(beta), s = std::sin(beta);
        return {c * v.x + s * v.y, c * v.y - s * v.x, v.z};
    }

    const TestMesh& test_mesh_;
    glm::dmat3 axes_;
    paper::ClosedForm map_;
};

}  // namespace goffer::test
