// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/fit/cylinder.hpp>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

/// Bodies whose axis, length and radius are known, as a mesh and as the truth about it.

namespace goffer::test {

struct Solid {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> triangles;

    [[nodiscard]] fit::Geometry geometry() const { return {positions, triangles}; }
};

/// A cylinder as a grid of columns and rows about z, r = 1, from z = 0 to `length`.
struct Recipe {
    int columns = 32;
    int rows = 48;  // of quads
    double length = 10;
    bool closed = true;
    double dense = 1;       // rows at the tip are this much denser than at the base
    double dense_beta = 1;  // columns at beta = 0 are this much denser than at pi
    double jitter = 0;      // of inner vertices in z and of all in beta, in spacings; below 0.5
    double noise = 0;       // standard deviation of rho
};

/// u in 0..1, spaced so that the density grows evenly from one end to `dense` times that at the other.
inline double spaced(double u, double dense) {
    if (dense == 1) return u;
    return (std::sqrt(1 + u * (dense * dense - 1)) - 1) / (dense - 1);
}

inline Solid cylinder(const Recipe& recipe, std::mt19937& random) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto [columns, rows, length, closed, dense, dense_beta, jitter, noise] = recipe;
    Solid solid;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const double at = (i + jitter * uniform(random)) / columns;
            const double half = std::abs(2 * at - 1);  // 1 at beta = 0
            const double beta = std::numbers::pi * (1 + std::copysign(spaced(half, dense_beta), 2 * at - 1));
            const double shift = j == 0 || j == rows ? 0 : jitter * uniform(random);
            const double z = length * (1 - spaced(1 - (j + shift) / rows, 1 / dense));
            const double rho = 1 + noise * normal(random);
            solid.positions.emplace_back(rho * std::cos(beta), rho * std::sin(beta), z);
        }
    }
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        solid.triangles.insert(solid.triangles.end(), {a, b, c, a, c, d});
    };
    const auto n = static_cast<std::uint32_t>(columns);
    const auto last = static_cast<std::uint32_t>(rows) * n;
    for (std::uint32_t j = 0; j < last; j += n) {
        for (std::uint32_t i = 0; i < n; ++i) quad(j + i, j + (i + 1) % n, j + n + (i + 1) % n, j + n + i);
    }
    if (!closed) return solid;
    const auto base = static_cast<std::uint32_t>(solid.positions.size());
    solid.positions.emplace_back(0, 0, 0);
    solid.positions.emplace_back(0, 0, length);
    for (std::uint32_t i = 0; i < n; ++i) {
        solid.triangles.insert(solid.triangles.end(), {base, (i + 1) % n, i});
        solid.triangles.insert(solid.triangles.end(), {base + 1, last + i, last + (i + 1) % n});
    }
    return solid;
}

/// The same, open, as a tube without noise.
inline Solid tube(int columns = 32) {
    std::mt19937 random(1);
    return cylinder({.columns = columns, .closed = false}, random);
}

/// The base cylinder of tube(), with the zero of beta along x.
inline fit::Cylinder upright() {
    fit::Cylinder cylinder;
    cylinder.length = 10;
    cylinder.radius = 1;
    return cylinder;
}

/// The surface of a base of radius 1 at rest, open: a ring of `sides` vertices at each of rows + 1 heights,
/// from the zero of beta on, and the triangles between two rings behind those between the two before.
inline Solid surface_of(const fit::Cylinder& cylinder, std::uint32_t rows = 160, std::uint32_t sides = 16) {
    std::vector<fit::BasePoint> points;
    for (std::uint32_t i = 0; i < (rows + 1) * sides; ++i)
        points.push_back(
            {2 * std::numbers::pi * (i % sides) / sides, cylinder.length * (i / sides) / rows, 1});
    Solid solid;
    for (const glm::dvec3& place : fit::places_on_base(cylinder, points)) solid.positions.emplace_back(place);
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t c = 0; c < sides; ++c) {
            const std::uint32_t a = sides * row + c, b = sides * row + (c + 1) % sides;
            solid.triangles.insert(solid.triangles.end(), {a, b, a + sides, b, b + sides, a + sides});
        }
    }
    return solid;
}

/// Turned, then scaled, then moved.
struct Placing {
    glm::dmat3 turn{1};
    double scale = 1;
    glm::dvec3 move{0};

    [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& p) const { return scale * (turn * p) + move; }
};

/// A rotation without a preferred direction, a scale of 1e-4..1e4 and a move of up to `reach` in the body's
/// units.
inline Placing random_placing(double reach, std::mt19937& random) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto direction = [&] { return glm::dvec3{normal(random), normal(random), normal(random)}; };
    const glm::dvec3 e3 = glm::normalize(direction());
    const glm::dvec3 e1 = glm::normalize(glm::cross(direction(), e3));
    const double scale = std::pow(10.0, 4 * uniform(random));
    return {glm::dmat3(e1, glm::cross(e3, e1), e3), scale, scale * reach * glm::normalize(direction())};
}

inline Solid placed(Solid solid, const Placing& placing) {
    for (glm::vec3& p : solid.positions) p = placing(p);
    return solid;
}

/// Every vertex where `map` takes it.
inline Solid warped(Solid solid, const std::function<glm::dvec3(glm::dvec3)>& map) {
    for (glm::vec3& p : solid.positions) p = map(p);
    return solid;
}

/// The same surface with a vertex for every corner, as in an STL.
inline Solid soup(const Solid& solid) {
    Solid loose;
    for (const std::uint32_t i : solid.triangles) {
        loose.triangles.push_back(static_cast<std::uint32_t>(loose.positions.size()));
        loose.positions.push_back(solid.positions[i]);
    }
    return loose;
}

/// Straight or an arc, whichever it is.
inline fit::Cylinder fit_to(const Solid& solid, std::optional<glm::dvec3> axis = std::nullopt) {
    return fit::fit_cylinder(solid.geometry(), axis, fit::RestPose::automatic);
}

/// How many folds it carries in its own fit.
inline int capacity(const Solid& solid) {
    return fit::folds_capacity(solid.geometry(), fit::fit_cylinder(solid.geometry()));
}

inline bool near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-6) {
    return glm::length(a - b) <= tolerance;
}

/// Angle between two lines, whatever their signs.
inline double angle_between_lines(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), std::abs(glm::dot(a, b)));
}

/// The same surface with no vertex shared by two triangles, in another order, with some triangles flipped and
/// one vertex that none uses.
inline Solid scrambled(const Solid& solid) {
    Solid other;
    other.positions.emplace_back(1e30f, -1e30f, 1e30f);
    for (std::size_t t = solid.triangles.size(); t > 0; t -= 3) {
        for (const std::size_t i : {t - 1, t - 3, t - 2}) {
            other.triangles.push_back(static_cast<std::uint32_t>(other.positions.size()));
            other.positions.push_back(solid.positions[solid.triangles[i]]);
        }
        if (t % 2 == 0) std::swap(other.triangles.back(), other.triangles[other.triangles.size() - 2]);
    }
    return other;
}

}  // namespace goffer::test
