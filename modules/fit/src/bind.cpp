// SPDX-License-Identifier: MIT
#include "text.hpp"

#include <goffer/fit/bind.hpp>
#include <goffer/paper/closed_form.hpp>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

namespace goffer::fit {
namespace {

/// The body frame in model space, and one vertex's own frame in it.
struct Frame {
    glm::dvec3 origin;
    glm::dmat3 axes;  // columns e1, e2, e3

    explicit Frame(const Cylinder& cylinder) : origin(cylinder.origin), axes(1) {
        axes[2] = glm::normalize(cylinder.axis);
        axes[0] = glm::normalize(cylinder.zero - glm::dot(cylinder.zero, axes[2]) * axes[2]);
        axes[1] = glm::cross(axes[2], axes[0]);
    }

    [[nodiscard]] paper::Cylindrical vertex(const glm::vec3& position) const {
        return paper::to_cylindrical(glm::transpose(axes) * (glm::dvec3(position) - origin));
    }

    /// Components of a unit vector along (e_rho, e_beta, e_z) at beta.
    [[nodiscard]] bend::RestVector direction(const glm::dvec3& vector, double beta) const {
        const glm::dvec3 local = glm::transpose(axes) * vector;
        const double c = std::cos(beta);
        const double s = std::sin(beta);
        return {c * local.x + s * local.y, c * local.y - s * local.x, local.z};
    }
};

bool usable_direction(const glm::dvec3& v) {
    const double length = glm::length(v);
    return std::isfinite(length) && length > 1e-12;
}

/// The vertices that no triangle uses: nobody's surface.
class Unused {
public:
    explicit Unused(const Geometry& geometry) : geometry_(geometry) {}

    [[nodiscard]] bool operator[](std::size_t vertex) {
        if (used_.empty()) {
            used_.resize(geometry_.positions.size());
            for (const std::uint32_t i : geometry_.triangles) used_[i] = true;
        }
        return !used_[vertex];
    }

private:
    const Geometry& geometry_;
    std::vector<bool> used_;  // made when first asked for
};

[[noreturn]] void refuse_outside(std::size_t vertex, double z, double length) {
    throw Error("vertex " + std::to_string(vertex) + " lies at z = " + text(z) +
                ", outside the base cylinder's 0.." + text(length) +
                "; fit the cylinder to this mesh, or lengthen it");
}

bend::RestVertex rest_vertex(const paper::Cylindrical& at, const Cylinder& cylinder, paper::Profile profile,
                             int folds) {
    bend::RestVertex rest{at.beta, at.z, at.rho, 0, 0};
    if (folds == 0) return rest;
    const double u = std::min(std::fabs(2 * at.z / cylinder.length - 1), 1.0);
    const double weight = paper::depth_weight(at.rho, cylinder.radius);
    const double weight_by_rho = at.rho > 1e-9 * cylinder.radius ? weight / at.rho : 2 / cylinder.radius;
    rest.wrinkle = weight_by_rho * paper::shape(profile, folds, u);
    rest.slope = weight * paper::shape_slope_z(profile, folds, cylinder.length, at.z);
    return rest;
}

std::vector<bend::RestVertex> rest_vertices(const Geometry& geometry, const Cylinder& cylinder,
                                            const Frame& frame, paper::Profile profile, int folds) {
    std::vector<bend::RestVertex> rest;
    rest.reserve(geometry.positions.size());
    Unused unused(geometry);
    const double slack = 1e-3 * cylinder.length;
    for (const glm::vec3& position : geometry.positions) {
        paper::Cylindrical at = frame.vertex(position);
        if (at.z < -slack || at.z > cylinder.length + slack) {
            if (!unused[rest.size()]) refuse_outside(rest.size(), at.z, cylinder.length);
            at.z = std::clamp(at.z, 0.0, cylinder.length);
        }
        rest.push_back(rest_vertex(at, cylinder, profile, folds));
    }
    return rest;
}

std::vector<bend::RestVector> rest_normals(const Geometry& geometry, const Frame& frame,
                                           std::span<const bend::RestVertex> rest) {
    std::vector<glm::vec3> made;
    const auto made_normal = [&](std::size_t i) {
        if (made.empty()) made = make_normals(geometry.positions, geometry.triangles);
        return glm::dvec3(made[i]);
    };
    std::vector<bend::RestVector> normals(rest.size());
    for (std::size_t i = 0; i < rest.size(); ++i) {
        glm::dvec3 normal = geometry.normals.empty() ? made_normal(i) : glm::dvec3(geometry.normals[i]);
        if (!usable_direction(normal)) normal = made_normal(i);
        normals[i] = frame.direction(glm::normalize(normal), rest[i].beta);
    }
    return normals;
}

bend::RestVector any_orthogonal(const bend::RestVector& n) {
    const glm::dvec3 normal(n.rho, n.beta, n.z);
    const glm::dvec3 other = std::fabs(n.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 tangent = glm::normalize(glm::cross(other, normal));
    return {tangent.x, tangent.y, tangent.z};
}

std::vector<bend::RestVector> rest_tangents(const Geometry& geometry, const Frame& frame,
                                            std::span<const bend::RestVertex> rest,
                                            std::span<const bend::RestVector> normals) {
    std::vector<bend::RestVector> tangents(geometry.tangents.size());
    for (std::size_t i = 0; i < tangents.size(); ++i) {
        const glm::dvec3 tangent(geometry.tangents[i]);
        tangents[i] = usable_direction(tangent) ? frame.direction(glm::normalize(tangent), rest[i].beta)
                                                : any_orthogonal(normals[i]);
    }
    return tangents;
}

std::vector<float> tangent_signs(const Geometry& geometry) {
    std::vector<float> signs(geometry.tangents.size());
    std::transform(geometry.tangents.begin(), geometry.tangents.end(), signs.begin(),
                   [](const glm::vec4& tangent) { return tangent.w < 0 ? -1.0f : 1.0f; });
    return signs;
}

double largest_rho(std::span<const bend::RestVertex> rest) {
    const auto by_rho = [](const bend::RestVertex& a, const bend::RestVertex& b) { return a.rho < b.rho; };
    return std::max_element(rest.begin(), rest.end(), by_rho)->rho;
}

}  // namespace

Bound bind(const Geometry& geometry, const Cylinder& cylinder, const BindOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    check(geometry);
    check(cylinder);
    if (cylinder.rest_angle != 0)
        throw Error("rest_angle: bodies bent at rest can't be bound; give 0 or fit again");
    const int capacity = folds_capacity(geometry, cylinder);
    const bool none = options.amplitude == paper::Amplitude::none;
    const int folds = none ? 0 : options.folds.value_or(sensible_folds(cylinder, capacity));

    const Frame frame(cylinder);
    const std::vector<bend::RestVertex> vertices =
        rest_vertices(geometry, cylinder, frame, options.profile, folds);
    const std::vector<bend::RestVector> normals = rest_normals(geometry, frame, vertices);
    const std::vector<bend::RestVector> tangents = rest_tangents(geometry, frame, vertices, normals);
    const std::vector<float> signs = tangent_signs(geometry);

    bend::BodyInput input;
    input.origin = frame.origin;
    input.axes = frame.axes;
    input.length = cylinder.length;
    input.radius = cylinder.radius;
    input.max_angle = largest_angle(options.profile, options.amplitude, folds, cylinder.length,
                                    cylinder.radius, largest_rho(vertices));
    input.table = make_wrinkle_table(options.profile, options.amplitude, folds, cylinder.length,
                                     cylinder.radius, input.max_angle, options.table_rows);
    input.vertices = vertices;
    input.normals = normals;
    input.tangents = tangents;
    input.tangent_signs = signs;
    std::optional<bend::Body> body = bend::Body::make(input);
    if (!body) throw Error("cannot bind: " + std::string(bend::describe(bend::Body::check(input))));

    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
    return {std::move(*body), folds, capacity, taken.count()};
}

}  // namespace goffer::fit
