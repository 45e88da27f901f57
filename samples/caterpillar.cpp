// SPDX-License-Identifier: MIT

// Writes a plush caterpillar, a soft model for the demo: about 10,000 vertices, 1 m long, 0.1 m thick. It
// lies along +z with its tail at the origin and its face at the far end; +y is up. The trunk with the head is
// one watertight skin; eyes, feet and the rest are closed pieces that are stuck into it.

#include <goffer/mesh/mesh.hpp>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>

namespace {

using glm::vec3;
using goffer::mesh::Mesh;

constexpr float pi = std::numbers::pi_v<float>;

constexpr float radius = 0.1f;
constexpr int segments = 10;
constexpr float segment = 0.08f;
constexpr float neck = segments * segment;
constexpr vec3 head{0, 0, 0.88f};
constexpr float head_radius = 0.118f;

enum Paint { leaf, stripe, face, white, black, rose, horn, shoe, spot, paints };

const std::array<goffer::mesh::Material, paints> materials{{
    {"leaf", {0.22f, 0.50f, 0.10f, 1}},
    {"stripe", {0.52f, 0.70f, 0.16f, 1}},
    {"face", {0.86f, 0.62f, 0.16f, 1}},
    {"white", {0.90f, 0.90f, 0.86f, 1}},
    {"black", {0.025f, 0.02f, 0.025f, 1}},
    {"rose", {0.85f, 0.25f, 0.16f, 1}},
    {"horn", {0.30f, 0.13f, 0.06f, 1}},
    {"shoe", {0.75f, 0.30f, 0.08f, 1}},
    {"spot", {0.93f, 0.75f, 0.22f, 1}},
}};

float square(float x) {
    return x * x;
}

/// The mesh while it grows: faces are kept by paint, so that every paint becomes one part.
struct Plush {
    Mesh mesh;
    std::array<std::vector<std::uint32_t>, paints> corners;
};

/// Adds a closed skin: `rings` rings of `columns` vertices between two poles. `point(u, v)` is a place on it,
/// where u goes once around and v from pole to pole. Faces look outward if u goes counterclockwise, seen from
/// the last pole. The texture runs up one side and down the other, so there is no seam.
template <class Point, class PaintAt>
void add_skin(Plush& plush, int columns, int rings, const Point& point, const PaintAt& paint_at) {
    Mesh& mesh = plush.mesh;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto add = [&](float u, float v) {
        mesh.positions.push_back(point(u, v));
        mesh.uvs[0].values.emplace_back(1 - std::abs(2 * u - 1), v);
    };
    const auto at = [&](int ring, int column) -> std::uint32_t {
        if (ring < 0) return first;
        if (ring == rings) return first + 1;
        return first + 2 + static_cast<std::uint32_t>(ring * columns + column % columns);
    };

    add(0.5f, 0);
    add(0.5f, 1);
    for (int ring = 0; ring < rings; ++ring)
        for (int column = 0; column < columns; ++column)
            add(static_cast<float>(column) / columns, (ring + 1.0f) / (rings + 1.0f));
    for (int ring = -1; ring < rings; ++ring)
        for (int column = 0; column < columns; ++column) {
            auto& corners = plush.corners[paint_at((ring + 1.5f) / (rings + 1.0f))];
            const std::uint32_t a = at(ring, column), b = at(ring, column + 1);
            const std::uint32_t c = at(ring + 1, column + 1), d = at(ring + 1, column);
            if (a != b) corners.insert(corners.end(), {a, b, c});
            if (c != d) corners.insert(corners.end(), {a, c, d});
        }
}

/// Adds an ellipsoid. The columns of `axes` are its half-axes, right-handed; the last one points from pole to
/// pole.
void add_ball(Plush& plush, int columns, int rings, const vec3& center, const glm::mat3& axes, Paint paint) {
    const auto point = [&](float u, float v) {
        return center + axes * vec3(std::sin(pi * v) * std::cos(2 * pi * u),
                                    std::sin(pi * v) * std::sin(2 * pi * u), -std::cos(pi * v));
    };
    add_skin(plush, columns, rings, point, [&](float) { return paint; });
}

/// Half-axes of a round button that faces along `normal`.
glm::mat3 button(const vec3& normal, float width, float height) {
    const vec3 across = glm::normalize(glm::cross(vec3(0, 1, 0.1f), normal));
    return {width * across, width * glm::cross(normal, across), height * normal};
}

/// Adds a round rod along `curve(t)`, t in 0..1, with round ends. `side` must never be along the rod.
template <class Curve>
void add_rod(Plush& plush, int columns, int rings, const Curve& curve, const vec3& side, float thickness,
             Paint paint) {
    const auto point = [&](float u, float v) {
        const float t = (1 - std::cos(pi * v)) / 2;
        const vec3 along = glm::normalize(curve(t + 0.01f) - curve(t - 0.01f));
        const vec3 a = glm::normalize(glm::cross(side, along)), b = glm::cross(along, a);
        const float wide = thickness * std::pow(std::max(0.0f, std::sin(pi * v)), 0.6f);
        return curve(t) + wide * (std::cos(2 * pi * u) * a + std::sin(2 * pi * u) * b);
    };
    add_skin(plush, columns, rings, point, [&](float) { return paint; });
}

/// Radius of the trunk's outline: a round tail, plump segments, a ball of a head.
float outline(float z) {
    const float in_segment = 2 * (z / segment - std::floor(z / segment)) - 1;
    const float plump = z < neck ? 1 - 0.12f * std::pow(std::abs(in_segment), 3.0f) : 0.88f;
    const float tail = std::sqrt(std::max(0.0f, 1 - square(std::max(0.0f, 1 - z / 0.13f))));
    const float throat = std::sqrt(std::max(0.0f, 1 - square(std::max(0.0f, (z - neck) / 0.05f))));
    const float body = radius * plump * tail * throat * (1 + 0.05f * std::sin(pi * z / neck));
    const float skull = std::sqrt(std::max(0.0f, square(head_radius) - square(z - head.z)));
    return std::max(body, skull);
}

/// Heights of the trunk's rows, poles included, at even steps along the outline: even in z but for the round
/// ends.
std::vector<float> even_rows(int rows) {
    constexpr int fine = 20000;
    const float top = head.z + head_radius;
    std::vector<float> way(fine + 1, 0.0f);
    const auto z = [&](int i) { return top * (1 - std::cos(pi * static_cast<float>(i) / fine)) / 2; };
    for (int i = 1; i <= fine; ++i)
        way[i] = way[i - 1] + std::hypot(z(i) - z(i - 1), outline(z(i)) - outline(z(i - 1)));
    std::vector<float> heights;
    for (int row = 0; row < rows; ++row) {
        const float wanted = way[fine] * static_cast<float>(row) / static_cast<float>(rows - 1);
        heights.push_back(z(static_cast<int>(std::ranges::lower_bound(way, wanted) - way.begin())));
    }
    heights.back() = top;
    return heights;
}

void add_trunk(Plush& plush) {
    constexpr int columns = 44, rings = 160;
    const std::vector<float> heights = even_rows(rings + 2);
    const auto height = [&](float v) { return heights[std::lround(v * (rings + 1))]; };
    const auto point = [&](float u, float v) {
        const float z = height(v), rho = outline(z);
        const float x = rho * std::sin(2 * pi * u), y = -rho * std::cos(2 * pi * u);  // u = 0 is the belly
        return vec3(x, y < 0 ? 0.94f * y : y, z);
    };
    const auto paint = [&](float v) {
        const float z = heights[static_cast<int>(v * (rings + 1))];
        if (z > neck) return face;
        return static_cast<int>(z / segment) % 2 == 0 ? leaf : stripe;
    };
    add_skin(plush, columns, rings, point, paint);
}

/// Adds feet and spots on both sides of every segment but the tail.
void add_feet_and_spots(Plush& plush) {
    for (int i = 1; i < segments; ++i)
        for (const float side : {-1.0f, 1.0f}) {
            const float z = (static_cast<float>(i) + 0.5f) * segment;
            const vec3 down = glm::normalize(vec3(0.62f * side, -0.78f, 0));
            const vec3 aside = glm::cross(vec3(0, 0, 1), down);
            const glm::mat3 foot{0.024f * aside, vec3(0, 0, -0.026f), 0.036f * down};
            add_ball(plush, 12, 7, vec3(0, 0, z) + 0.96f * outline(z) * down, foot, shoe);
            const vec3 up = glm::normalize(vec3(0.66f * side, 0.75f, 0));
            add_ball(plush, 12, 4, vec3(0, 0, z) + 0.985f * outline(z) * up, button(up, 0.017f, 0.008f),
                     spot);
        }
}

void add_face(Plush& plush) {
    const auto on_head = [](const vec3& direction) { return head + head_radius * glm::normalize(direction); };
    for (const float side : {-1.0f, 1.0f}) {
        const vec3 look = glm::normalize(vec3(0.46f * side, 0.36f, 0.80f));
        const vec3 eye = on_head(look) - 0.006f * look;
        const vec3 gaze = glm::normalize(look + vec3(-0.25f * side, 0.05f, 0.25f));
        const vec3 glint = glm::normalize(gaze + vec3(0.18f, 0.26f, 0));
        add_ball(plush, 18, 11, eye, button(look, 0.035f, 0.035f), white);
        add_ball(plush, 18, 5, eye + 0.0295f * gaze, button(gaze, 0.020f, 0.008f), black);
        add_ball(plush, 8, 4, eye + 0.036f * glint, button(glint, 0.006f, 0.003f), white);

        const vec3 cheek = glm::normalize(vec3(0.72f * side, -0.20f, 0.66f));
        add_ball(plush, 16, 4, on_head(cheek), button(cheek, 0.022f, 0.006f), rose);

        const auto feeler = [side](float t) {
            return vec3(side * (0.035f + 0.040f * t * t), 0.095f + 0.085f * t,
                        head.z + 0.005f + 0.035f * t * t);
        };
        add_rod(plush, 8, 10, feeler, vec3(1, 0, 0), 0.008f, horn);
        add_ball(plush, 12, 7, feeler(1), glm::mat3(0.016f), rose);
    }
    const auto smile = [&](float t) {
        const float x = 2 * t - 1;
        return on_head(vec3(0.36f * x, -0.42f + 0.20f * x * x, 0.90f));
    };
    add_rod(plush, 8, 14, smile, vec3(0, 0, 1), 0.006f, horn);
}

void join_parts(Plush& plush) {
    Mesh& mesh = plush.mesh;
    mesh.materials.assign(materials.begin(), materials.end());
    for (int paint = 0; paint < paints; ++paint) {
        const auto& corners = plush.corners[paint];
        const auto count = static_cast<std::uint32_t>(corners.size() / 3);
        mesh.parts.push_back(
            {materials[paint].name, paint, static_cast<std::uint32_t>(mesh.faces.size()), count});
        mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
        mesh.faces.insert(mesh.faces.end(), count, 3);
    }
}

void add_normals(Mesh& mesh) {
    auto& normals = mesh.normals.values;
    normals.assign(mesh.positions.size(), vec3(0));
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
        const vec3 a = mesh.positions[mesh.corners[i]];
        const vec3 b = mesh.positions[mesh.corners[i + 1]], c = mesh.positions[mesh.corners[i + 2]];
        for (int k = 0; k < 3; ++k) normals[mesh.corners[i + k]] += glm::cross(b - a, c - a);
    }
    for (vec3& normal : normals) normal = glm::normalize(normal);
}

Mesh caterpillar() {
    Plush plush;
    plush.mesh.uvs.resize(1);
    add_trunk(plush);
    add_feet_and_spots(plush);
    add_face(plush);
    join_parts(plush);
    add_normals(plush.mesh);
    return std::move(plush.mesh);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: goffer_caterpillar OUT.(glb|gltf|obj|ply|stl)\n");
        return 2;
    }
    try {
        goffer::mesh::save(caterpillar(), argv[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "goffer_caterpillar: %s\n", error.what());
        return 1;
    }
    return 0;
}
