// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

/// What is measured: a bumpy cylinder of any number of vertices.

namespace goffer::bench {

/// The size that the method's table is made for: L / r = 10, five folds.
inline constexpr double length = 10;
inline constexpr double radius = 1;
inline constexpr int folds = 5;

/// What the body is like: each is another way through the kernels.
enum class Shape {
    plain,      ///< one region, straight at rest
    regions,    ///< eight regions of a fold each
    joints,     ///< eight with even folds that run on over their joints
    regions16,  ///< sixteen without folds
    arc,        ///< bent at rest by one radian
    taper,      ///< straight, 1.4 times as thick at one end as in the middle, 0.6 times at the other
};

/// The vertices' places: columns about the axis, about four times as many rows along it.
struct Grid {
    std::size_t columns, rows;

    /// Makes a grid of exactly `vertices` vertices; the number of its columns divides them.
    explicit Grid(std::size_t vertices);

    [[nodiscard]] double beta(std::size_t column) const;
    [[nodiscard]] double z(std::size_t row) const;
    [[nodiscard]] static double rho(double beta, double z);
};

/// The body as a mesh, with tangents about the axis, or where they were before it was bent. Bind makes the
/// normals.
struct Model {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec4> tangents;
    std::vector<std::uint32_t> triangles;
    Shape shape;

    explicit Model(std::size_t vertices, Shape like = Shape::plain);
};

[[nodiscard]] bend::Body bind_model(const Model& model);

/// bind_model of Model(vertices, shape).
[[nodiscard]] bend::Body make_body(std::size_t vertices, Shape shape);

}  // namespace goffer::bench
