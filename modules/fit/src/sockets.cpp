// SPDX-License-Identifier: MIT
#include "mask.hpp"
#include "parts.hpp"
#include "rest.hpp"
#include "text.hpp"
#include "triangle.hpp"

#include <goffer/fit/sockets.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace goffer::fit {
namespace {

bend::Socket placed(const Binding& binding, const paper::Cylindrical& at) {
    const std::vector<RestRegion> regions = rest_regions(binding);
    bend::Socket socket;
    socket.region = region_at(regions, at.z);
    socket.vertex = rest_vertex(at, regions[socket.region], binding.cylinder.radius, binding.profile);
    if (binding.parts) apply(binding.parts->at(at), socket.vertex);
    return socket;
}

/// The point of a triangle nearest to `p`: its foot on the plane where that lies inside, else the nearest
/// point of its edges.
glm::dvec3 nearest_on(const Triangle& triangle, const glm::dvec3& p) {
    const auto& corner = triangle.corner;
    const glm::dvec3 normal = triangle.normal();
    const double area = glm::dot(normal, normal);
    if (area > 0) {
        const glm::dvec3 foot = p - glm::dot(p - corner[0], normal) / area * normal;
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 edge = corner[(i + 1) % 3] - corner[i];
            inside = inside && glm::dot(glm::cross(edge, foot - corner[i]), normal) >= 0;
        }
        if (inside) return foot;
    }
    glm::dvec3 nearest = corner[0];
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 edge = corner[(i + 1) % 3] - corner[i];
        const double squared = glm::dot(edge, edge);
        const double t = squared > 0 ? std::clamp(glm::dot(p - corner[i], edge) / squared, 0.0, 1.0) : 0;
        const glm::dvec3 point = corner[i] + t * edge;
        if (glm::distance(p, point) < glm::distance(p, nearest)) nearest = point;
    }
    return nearest;
}

/// The mask at a point of a triangle, given by its three vertices.
MaskValue mask_on(const Mask& mask, const Geometry& geometry, std::span<const std::uint32_t> corners,
                  const glm::dvec3& point) {
    const Triangle triangle(geometry.positions, corners);
    const glm::dvec3 normal = triangle.normal();
    MaskValue sum{0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 &b = triangle.corner[(i + 1) % 3], &c = triangle.corner[(i + 2) % 3];
        const double share = glm::dot(glm::cross(c - b, point - b), normal) / glm::dot(normal, normal);
        const MaskValue own = mask.at(corners[i]);
        sum.value += share * own.value;
        sum.slope += share * own.slope;
    }
    return sum;
}

}  // namespace

bend::Socket socket_at(const Binding& binding, double z, double beta, double rho) {
    const double length = binding.cylinder.length;
    if (!(z >= 0 && z <= length))
        throw Error("socket: z = " + text(z) + " is outside the body's 0.." + text(length));
    if (!(rho >= 0) || !std::isfinite(rho))
        throw Error("socket: rho = " + text(rho) + " is not a distance; give 0 or more");
    if (!std::isfinite(beta))
        throw Error("socket: beta = " + text(beta) + " is not an angle; give finite radians");
    return placed(binding, {beta, z, rho});
}

bend::Socket socket_near(const Binding& binding, const Geometry& geometry, const glm::dvec3& point) {
    check(geometry);
    if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z))
        throw Error("socket: the point is not finite; give finite coordinates");
    glm::dvec3 nearest(0), normal(0);
    std::span<const std::uint32_t> triangle;
    double distance = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t + 2 < geometry.triangles.size(); t += 3) {
        const Triangle here(geometry.positions, geometry.triangles.subspan(t, 3));
        const glm::dvec3 own = here.normal();
        const glm::dvec3 on = nearest_on(here, point);
        if (!(glm::distance(on, point) < distance) || !(glm::length(own) > 0)) continue;
        distance = glm::distance(on, point);
        nearest = on;
        triangle = geometry.triangles.subspan(t, 3);
        normal = glm::normalize(own);
    }
    if (triangle.empty()) throw Error("socket: no triangle has an area; give the mesh that was bound");
    const Straightening straightening(binding.cylinder);
    paper::Cylindrical at = straightening.vertex(nearest);
    at.z = std::clamp(at.z, 0.0, binding.cylinder.length);
    bend::Socket socket = placed(binding, at);
    const Mask mask(geometry, binding.cylinder);
    if (!mask.empty()) apply(mask_on(mask, geometry, triangle, nearest), socket.vertex);
    socket.normal = straightening.normal(normal, at);
    // Toward the tip, in the plane; on a cap, whose plane has no such direction, away from the axis.
    const glm::dvec3 across(socket.normal.rho, socket.normal.beta, socket.normal.z);
    const glm::dvec3 wished = std::fabs(across.z) < 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 tangent = glm::normalize(wished - glm::dot(wished, across) * across);
    socket.tangent = {tangent.x, tangent.y, tangent.z};
    return socket;
}

}  // namespace goffer::fit
