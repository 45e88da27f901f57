// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/view/picture.hpp>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

/// Shapes to take pictures of, and ways to compare the pictures.

namespace goffer::test {

struct Shape {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> triangles;
    std::vector<glm::vec3> normals;
    glm::vec4 color{0.7f, 0.3f, 0.2f, 1};

    [[nodiscard]] view::Model model() const { return {positions, triangles, normals, {}, color}; }
};

/// A sphere with its poles on z, outside out. `bumps` > 0 gives it meridional folds of that depth.
inline Shape sphere(const glm::vec3& center, float radius, int columns = 192, int rows = 96,
                    float bumps = 0) {
    constexpr float pi = std::numbers::pi_v<float>;
    Shape s;
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const float theta = pi * static_cast<float>(row) / static_cast<float>(rows);
            const float phi = 2 * pi * static_cast<float>(column) / static_cast<float>(columns);
            const glm::vec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                              std::cos(theta));
            s.positions.push_back(center + radius * (1 + bumps * std::sin(theta) * std::sin(12 * phi)) * n);
            if (bumps == 0) s.normals.push_back(n);
        }
    const auto at = [&](int row, int column) {
        return static_cast<std::uint32_t>(row * columns + column % columns);
    };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const std::uint32_t a = at(row, column), b = at(row + 1, column);
            const std::uint32_t c = at(row + 1, column + 1), d = at(row, column + 1);
            s.triangles.insert(s.triangles.end(), {a, b, c, a, c, d});
        }
    return s;
}

/// A square in the xy plane.
inline Shape square(const glm::vec3& center, float half) {
    Shape s;
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)})
        s.positions.push_back(center + half * glm::vec3(corner, 0));
    s.triangles = {0, 1, 2, 0, 2, 3};
    return s;
}

inline view::Picture render(std::initializer_list<Shape> shapes, const view::Settings& settings,
                            const view::Camera& camera = {}) {
    std::vector<view::Model> models;
    for (const Shape& shape : shapes) models.push_back(shape.model());
    return view::render(models, camera, settings);
}

inline glm::ivec3 pixel(const view::Picture& picture, int x, int y) {
    const std::uint8_t* p = &picture.rgb[3 * (static_cast<std::size_t>(y) * picture.width + x)];
    return {p[0], p[1], p[2]};
}

/// On squares, along their normal.
inline constexpr view::Camera from_above{{0, 0, -1}, {0, 1, 0}, 0.5f};

/// The share of pixels that differ by more than `tolerance` in a channel.
inline double difference(const view::Picture& a, const view::Picture& b, int tolerance) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
        int most = 0;
        for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a.rgb[i + c] - b.rgb[i + c]));
        if (most > tolerance) ++count;
    }
    return static_cast<double>(count) / static_cast<double>(a.rgb.size() / 3);
}

}  // namespace goffer::test
