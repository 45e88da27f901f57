// SPDX-License-Identifier: MIT
#include "triangle.hpp"

#include <goffer/fit/geometry.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string_view>
#include <utility>

namespace goffer::fit {
namespace {

template <class Vector>
bool finite(const Vector& v) {
    for (int i = 0; i < Vector::length(); ++i) {
        if (!std::isfinite(v[i])) return false;
    }
    return true;
}

/// One value per vertex, all finite; an optional stream may be empty.
template <class Vector>
void check_stream(std::span<const Vector> stream, std::size_t vertices, std::string_view name) {
    if (!stream.empty() && stream.size() != vertices) {
        throw Error(std::string(name) + "s: " + std::to_string(stream.size()) + " for " +
                    std::to_string(vertices) + " vertices; give one per vertex or none");
    }
    const auto bad = std::ranges::find_if_not(stream, finite<Vector>);
    if (bad == stream.end()) return;
    throw Error(std::string(name) + " of vertex " + std::to_string(bad - stream.begin()) +
                " is NaN or infinite; repair the mesh where it was made");
}

void check_mask(std::span<const float> mask, std::size_t vertices) {
    if (!mask.empty() && mask.size() != vertices) {
        throw Error("wrinkle mask: " + std::to_string(mask.size()) + " values for " +
                    std::to_string(vertices) + " vertices; give one per vertex or none");
    }
    const auto bad = std::ranges::find_if_not(mask, [](float value) { return value >= 0 && value <= 1; });
    if (bad == mask.end()) return;
    throw Error("wrinkle mask of vertex " + std::to_string(bad - mask.begin()) +
                " is outside 0..1; give the share of its wrinkle that it follows");
}

void check_triangles(std::span<const std::uint32_t> triangles, std::size_t vertices) {
    if (triangles.empty()) {
        throw Error("the mesh has no triangles; points and lines cannot be bent, give it faces");
    }
    if (triangles.size() % 3 != 0) {
        throw Error("triangles: " + std::to_string(triangles.size()) +
                    " indices are not a multiple of 3; give three per triangle");
    }
    const auto bad = std::ranges::find_if(triangles, [vertices](std::uint32_t i) { return i >= vertices; });
    if (bad == triangles.end()) return;
    throw Error("triangle " + std::to_string((bad - triangles.begin()) / 3) + " uses vertex " +
                std::to_string(*bad) + ", but the mesh has " + std::to_string(vertices) +
                " vertices, counted from 0; correct the index or add the vertex");
}

/// The used vertex farthest out by `distance`, and how far.
template <class Distance>
std::pair<glm::dvec3, double> farthest(const Geometry& geometry, Distance distance) {
    std::pair<glm::dvec3, double> best{{}, -1};
    for (const std::uint32_t i : geometry.triangles) {
        const glm::dvec3 p = geometry.positions[i];
        const double d = distance(p);
        if (d > best.second) best = {p, d};
    }
    return best;
}

[[noreturn]] void throw_flat(const char* where, const char* mend, double reach) {
    std::ostringstream message;
    message << "all vertices are " << where << ", as far as floats at coordinates up to " << reach
            << " can tell; give a mesh with " << mend;
    throw Error(message.str());
}

/// Grows a point to a line, a plane and a solid, by the farthest vertex each time. A distance within a few
/// roundings of float at these coordinates counts as none: a plane that was rotated is still a plane.
void check_spread(const Geometry& geometry) {
    const glm::dvec3 a = geometry.positions[geometry.triangles[0]];
    const double reach = farthest(geometry, [](const glm::dvec3& p) { return glm::length(p); }).second;
    const double nothing = 4 * double{std::numeric_limits<float>::epsilon()} * reach;

    const auto from_point = [&](const glm::dvec3& p) { return glm::length(p - a); };
    const auto [b, length] = farthest(geometry, from_point);
    if (length <= nothing) throw_flat("in one point", "an extent", reach);

    const glm::dvec3 along = (b - a) / length;
    const auto from_line = [&](const glm::dvec3& p) { return glm::length(glm::cross(p - a, along)); };
    const auto [c, width] = farthest(geometry, from_line);
    if (width <= nothing) throw_flat("on one line", "a surface around that line", reach);

    const glm::dvec3 across = glm::normalize(glm::cross(along, (c - a) / width));
    const auto from_plane = [&](const glm::dvec3& p) { return std::abs(glm::dot(p - a, across)); };
    const double height = farthest(geometry, from_plane).second;
    if (height <= nothing) throw_flat("in one plane", "a thickness", reach);
}

}  // namespace

void check(const Geometry& geometry) {
    check_triangles(geometry.triangles, geometry.positions.size());
    check_stream(geometry.positions, geometry.positions.size(), "position");
    check_stream(geometry.normals, geometry.positions.size(), "normal");
    check_stream(geometry.tangents, geometry.positions.size(), "tangent");
    check_mask(geometry.wrinkle_mask, geometry.positions.size());
    check_spread(geometry);
}

double surface_area(std::span<const glm::vec3> positions, std::span<const std::uint32_t> triangles) {
    double area = 0;
    for (std::size_t t = 0; t + 2 < triangles.size(); t += 3)
        area += Triangle(positions, triangles.subspan(t, 3)).area();
    return area;
}

}  // namespace goffer::fit
