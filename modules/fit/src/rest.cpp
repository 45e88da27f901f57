// SPDX-License-Identifier: MIT
#include "rest.hpp"

#include "parts.hpp"
#include "stretches.hpp"
#include "text.hpp"

#include <goffer/bend/rest_vertex.hpp>
#include <goffer/fit/normals.hpp>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace goffer::fit {
namespace {

bool usable_direction(const glm::dvec3& v) {
    const double length = glm::length(v);
    return std::isfinite(length) && length > 1e-12;
}

std::vector<bool> used_by_triangles(const Geometry& geometry) {
    std::vector<bool> used(geometry.positions.size(), false);
    for (const std::uint32_t vertex : geometry.triangles) used[vertex] = true;
    return used;
}

/// The vertices, straightened. One that no triangle uses is moved to within the ends, and to where numbers
/// are in the working range of a body.
std::vector<paper::Cylindrical> straightened(const Geometry& geometry, const Cylinder& cylinder,
                                             const Straightening& straightening,
                                             std::span<const RestRegion> regions,
                                             const std::vector<bool>& used) {
    std::vector<paper::Cylindrical> vertices;
    vertices.reserve(geometry.positions.size());
    const double slack = 1e-3 * cylinder.length, far = 1e3 * cylinder.radius;
    for (const glm::vec3& position : geometry.positions) {
        paper::Cylindrical at = straightening.vertex(position);
        if (at.z < -slack || at.z > cylinder.length + slack) {
            if (used[vertices.size()]) {
                throw Error("vertex " + std::to_string(vertices.size()) + " lies at z = " + text(at.z) +
                            ", outside the base cylinder's 0.." + text(cylinder.length) +
                            "; fit the cylinder to this mesh, or lengthen it");
            }
            at.z = std::clamp(at.z, 0.0, cylinder.length);
        }
        if (regions.size() > 1) {  // a thousandth of the body may be much of a region
            at.z = std::clamp(at.z, -5e-4 * regions.front().length,
                              cylinder.length + 5e-4 * regions.back().length);
        }
        if (!used[vertices.size()]) at.rho = std::min(at.rho, far);
        vertices.push_back(at);
    }
    return vertices;
}

/// Which part of its region a height is in: 0 within a blend of its beginning, 2 of its end, 1 between.
std::size_t part_of(std::span<const RestRegion> regions, std::size_t r, double z) {
    const RestRegion& region = regions[r];
    if (r > 0 && regions[r - 1].blend != 0 && z - region.start < regions[r - 1].blend) return 0;
    return region.blend != 0 && z - region.start > region.length - region.blend ? 2 : 1;
}

/// The geometry's vertices region by region, those near joints before and behind the others.
std::vector<std::uint32_t> region_order(std::span<const RestRegion> regions,
                                        std::span<const paper::Cylindrical> vertices,
                                        std::vector<std::size_t>& counts) {
    std::vector<std::size_t> place(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::size_t region = region_at(regions, vertices[i].z);
        place[i] = 3 * region + part_of(regions, region, vertices[i].z);
        ++counts[region];
    }
    std::vector<std::uint32_t> order(vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return place[i]; });
    return order;
}

bend::RestVector any_orthogonal(const bend::RestVector& n) {
    const glm::dvec3 tangent =
        glm::normalize(std::fabs(n.z) < 0.9 ? glm::dvec3(-n.beta, n.rho, 0) : glm::dvec3(0, -n.z, n.beta));
    return {tangent.x, tangent.y, tangent.z};
}

/// The normals of a geometry: its own, or made ones where it has none or one without length.
class Normals {
public:
    explicit Normals(const Geometry& geometry) : geometry_(geometry) {}

    [[nodiscard]] glm::dvec3 operator[](std::size_t vertex) {
        if (!geometry_.normals.empty()) {
            const glm::dvec3 own(geometry_.normals[vertex]);
            if (usable_direction(own)) return own;
        }
        if (made_.empty()) made_ = make_normals(geometry_.positions, geometry_.triangles);
        return made_[vertex];
    }

private:
    const Geometry& geometry_;
    std::vector<glm::vec3> made_;  // when first asked for
};

}  // namespace

std::size_t knots_along(double length, double radius, std::size_t least) {
    constexpr double most_steps = 256;
    const double quarters = std::ceil(4 * length / radius);
    return static_cast<std::size_t>(std::clamp(quarters, static_cast<double>(least - 1), most_steps)) + 1;
}

std::shared_ptr<const paper::Shape> weighted(const RestRegion& region, double radius,
                                             const std::vector<double>& factors) {
    paper::Shape::Knots knots = region.shape ? region.shape->knots() : paper::Shape::Knots{};
    const std::vector<double> own = knots.weight.empty() ? std::vector<double>{1, 1} : knots.weight;
    const std::size_t count = std::max(own.size(), slice_knots);
    const paper::Spline before(1, own), by_height(1, factors);
    std::vector<double> weight;
    for (std::size_t i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count - 1);
        const double value = own.size() == count ? own[i] : before(share);  // a spline would smooth its own
        weight.push_back(std::max(value * by_height(share), 0.0));
    }
    knots.weight = std::move(weight);
    return std::make_shared<const paper::Shape>(region.length, radius, knots);
}

paper::Pose rest_of(const Cylinder& cylinder, double start, double length) {
    if (cylinder.arcs.empty())
        return {cylinder.rest_angle * length / cylinder.length, cylinder.rest_direction};
    double end = 0;
    for (const RestArc& arc : cylinder.arcs) {
        end += arc.length;
        if (start < end - 1e-6 * cylinder.length) return {arc.angle, arc.direction};
    }
    return {};
}

BindOptions with_regions_of(const Cylinder& cylinder, const BindOptions& given) {
    BindOptions options = given;
    if (cylinder.arcs.empty()) return options;
    if (!given.regions.empty() && given.regions.size() != cylinder.arcs.size())
        throw Error("regions: there are " + std::to_string(given.regions.size()) +
                    ", and the cylinder is a chain of " + std::to_string(cylinder.arcs.size()) +
                    " arcs, which are the regions; give none, or one for each");
    options.regions.resize(cylinder.arcs.size());
    const auto folds_before = [&](double z) { return std::lround(*given.folds * z / cylinder.length); };
    double start = 0;
    for (std::size_t i = 0; i < cylinder.arcs.size(); ++i) {
        const double end = start + cylinder.arcs[i].length;
        RegionOptions& region = options.regions[i];
        region.share = cylinder.arcs[i].length / cylinder.length;
        if (given.folds && !region.folds) region.folds = folds_before(end) - folds_before(start);
        start = end;
    }
    return options;
}

std::vector<double> radii_at(const Cylinder& cylinder, double start, double length, std::size_t count) {
    if (cylinder.radii.empty()) return std::vector<double>(count, cylinder.radius);
    const paper::Spline whole(cylinder.length, cylinder.radii);
    std::vector<double> radii;
    for (std::size_t i = 0; i < count; ++i)
        radii.push_back(whole(start + length * static_cast<double>(i) / static_cast<double>(count - 1)));
    return radii;
}

std::vector<double> radii_of(const Cylinder& cylinder, double start, double length) {
    if (cylinder.radii.empty() || (start == 0 && length == cylinder.length)) return cylinder.radii;
    return radii_at(cylinder, start, length, knots_along(length, cylinder.radius, fewest_knots));
}

double radius_of(const Cylinder& cylinder, double start, double length) {
    const std::vector<double> radii = radii_of(cylinder, start, length);
    return radii.empty() ? cylinder.radius : paper::Spline(length, radii).mean();
}

double thickest_of(const Cylinder& cylinder, double start, double length) {
    const std::vector<double> radii = radii_of(cylinder, start, length);  // a spline is within its values
    return radii.empty() ? cylinder.radius : *std::ranges::max_element(radii);
}

Cylinder with_one_radius(const Cylinder& cylinder) {
    Cylinder plain = cylinder;
    plain.radii.clear();
    if (cylinder.radii.empty() || cylinder.arcs.empty()) return plain;
    plain.length = 0;
    double start = 0;
    for (RestArc& arc : plain.arcs) {
        const double own = radius_of(cylinder, start, arc.length);
        start += arc.length;
        arc.length += arc.angle * (plain.radius - own);
        plain.length += arc.length;
    }
    return plain;
}

Straightening::Straightening(const Cylinder& cylinder)
    : origin_(cylinder.origin), to_body_(glm::transpose(axes_of(cylinder))) {
    if (cylinder.arcs.empty()) add_piece(cylinder, 0, cylinder.length);
    double start = 0;
    for (const RestArc& arc : cylinder.arcs) {
        add_piece(cylinder, start, arc.length);
        start += arc.length;
    }
}

void Straightening::add_piece(const Cylinder& cylinder, double start, double length) {
    Piece piece{start, length, cylinder.radius, rest_of(cylinder, start, length), nullptr, {}};
    const std::vector<double> radii = radii_of(cylinder, start, length);
    if (!radii.empty() && cylinder.bent()) {
        piece.shape = std::make_shared<const paper::Shape>(length, cylinder.radius,
                                                           paper::Shape::Knots{.radius = radii});
        piece.radius = piece.shape->radius();
    }
    if (!pieces_.empty()) {
        const Piece& before = pieces_.back();
        const paper::Parameters body{.length = before.length, .radius = before.radius};
        piece.frame = paper::end_frame(before.frame, body, before.rest);
    }
    pieces_.push_back(std::move(piece));
}

paper::Cylindrical Straightening::Piece::straightened(const glm::dvec3& in_body) const {
    const glm::dvec3 local = glm::transpose(frame.axes) * (in_body - frame.origin);
    paper::Cylindrical at = paper::to_cylindrical(local, length, radius, rest);
    if (shape) at.z = shape->unshifted(at.z, rest.angle / length);
    return at;
}

/// Takes the piece whose center line is nearest, if the body is bent along a chain. Beyond the base and the
/// tip the first and the last one go on.
paper::Cylindrical Straightening::vertex(const glm::dvec3& position) const {
    const glm::dvec3 place = in_body(position);
    if (pieces_.size() == 1) return pieces_[0].straightened(place);
    paper::Cylindrical nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const Piece& piece : pieces_) {
        paper::Cylindrical at = piece.straightened(place);
        const auto [z, far] =
            seen_from(at.z, at.rho, piece.length, &piece == &pieces_.front(), &piece == &pieces_.back());
        if (!(far < least)) continue;
        least = far;
        at.z = piece.start + z;
        nearest = at;
    }
    return nearest;
}

double Straightening::height(const glm::dvec3& position) const {
    return pieces_.size() == 1 && pieces_[0].rest.angle == 0 ? in_body(position).z : vertex(position).z;
}

bool Straightening::leads_along(const glm::dvec3& middle, double from, double to, double slack) const {
    const double z = height(middle);
    return z >= std::min(from, to) - slack && z <= std::max(from, to) + slack;
}

const Straightening::Piece& Straightening::piece_at(double z) const {
    return pieces_[stretch_at(std::span(pieces_), z)];
}

namespace {

paper::Cylindrical moved_down(paper::Cylindrical at, double by) {
    at.z -= by;
    return at;
}

}  // namespace

bend::RestVector Straightening::normal(const glm::dvec3& vector, const paper::Cylindrical& at) const {
    const Piece& piece = piece_at(at.z);
    const auto [rho, beta, z] = paper::straightened_normal(
        glm::transpose(piece.frame.axes) * (to_body_ * vector), moved_down(at, piece.start), piece.length,
        piece.radius, piece.rest, piece.shape.get());
    return {rho, beta, z};
}

bend::RestVector Straightening::tangent(const glm::dvec3& vector, const paper::Cylindrical& at) const {
    const Piece& piece = piece_at(at.z);
    const auto [rho, beta, z] = paper::straightened_tangent(
        glm::transpose(piece.frame.axes) * (to_body_ * vector), moved_down(at, piece.start), piece.length,
        piece.radius, piece.rest, piece.shape.get());
    return {rho, beta, z};
}

glm::dvec3 Straightening::bent(const paper::Cylindrical& at) const {
    const Piece& piece = piece_at(at.z);
    const paper::Parameters body{.length = piece.length, .radius = piece.radius, .shape = piece.shape};
    const glm::dvec3 local = paper::ClosedForm(body, piece.rest).position(moved_down(at, piece.start));
    return origin_ + glm::transpose(to_body_) * (piece.frame.origin + piece.frame.axes * local);
}

glm::dvec3 Straightening::in_body(const glm::dvec3& position) const {
    return to_body_ * (position - origin_);
}

glm::dmat3 axes_of(const Cylinder& cylinder) {
    glm::dmat3 axes(1);
    axes[2] = glm::normalize(cylinder.axis);
    axes[0] = glm::normalize(cylinder.zero - glm::dot(cylinder.zero, axes[2]) * axes[2]);
    axes[1] = glm::cross(axes[2], axes[0]);
    return axes;
}

std::vector<RestRegion> rest_regions(const Binding& binding) {
    std::vector<RestRegion> places;
    double start = 0;
    for (const RegionBinding& region : binding.regions) {
        places.push_back({start, region.length, region.wave, region.shape, region.blend,
                          rest_of(binding.cylinder, start, region.length)});
        start += region.length;
    }
    return places;
}

std::size_t region_at(std::span<const RestRegion> regions, double z) {
    return stretch_at(regions, z);
}

bend::RestVertex rest_vertex(const paper::Cylindrical& at, const RestRegion& region, double radius,
                             paper::Profile profile) {
    const double z = at.z - region.start;
    bend::RestVertex rest{at.beta, z, at.rho, 0, 0};
    if (region.shape) {
        rest.scale = region.shape->scale(z);
        rest.scale_slope = region.shape->scale_slope(z);
        rest.drift = region.shape->drift(z);
        radius = region.shape->radius() * rest.scale;
    }
    if (region.folds.count == 0) return rest;
    const auto [wave, slope] = paper::wave_at(region.shape.get(), profile, region.folds, region.length, z);
    const double weight = paper::depth_weight(at.rho, radius);
    const double weight_by_rho = at.rho > 1e-9 * radius ? weight / at.rho : 2 / radius;
    rest.wrinkle = weight_by_rho * wave;
    rest.slope = weight * slope;
    // The weight of an inner vertex depends on the radius there.
    if (at.rho < radius / 2) rest.slope -= weight * wave * rest.scale_slope / rest.scale;
    return rest;
}

std::vector<std::uint32_t> places_in_body(std::span<const std::uint32_t> order) {
    constexpr std::uint32_t none = ~std::uint32_t{0};
    std::vector<std::uint32_t> places(order.size(), none);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::uint32_t vertex = order[i];
        if (vertex >= places.size() || places[vertex] != none)
            throw Error(
                "order[" + std::to_string(i) + "]: vertex " + std::to_string(vertex) +
                (vertex >= places.size() ? " of " + std::to_string(places.size()) : " a second time") +
                "; give the order that bind returned");
        places[vertex] = static_cast<std::uint32_t>(i);
    }
    return places;
}

RestMesh rest_mesh(const Geometry& geometry, const Cylinder& cylinder, paper::Profile profile,
                   std::span<const RestRegion> regions, const Parts* parts) {
    const Straightening straightening(cylinder);
    const std::vector<bool> used = used_by_triangles(geometry);
    const std::vector<paper::Cylindrical> at = straightened(geometry, cylinder, straightening, regions, used);
    RestMesh mesh;
    mesh.counts.resize(regions.size());
    const std::vector<std::uint32_t> order = region_order(regions, at, mesh.counts);
    Normals normals(geometry);
    for (const std::uint32_t i : order) {
        const RestRegion& region = regions[region_at(regions, at[i].z)];
        mesh.vertices.push_back(rest_vertex(at[i], region, cylinder.radius, profile));
        if (parts != nullptr) apply(parts->at(at[i]), mesh.vertices.back());
        mesh.used.push_back(used[i]);
        mesh.normals.push_back(straightening.normal(glm::normalize(normals[i]), at[i]));
        if (geometry.tangents.empty()) continue;
        const glm::dvec3 tangent(geometry.tangents[i]);
        mesh.tangents.push_back(usable_direction(tangent)
                                    ? straightening.tangent(glm::normalize(tangent), at[i])
                                    : any_orthogonal(mesh.normals.back()));
        mesh.tangent_signs.push_back(geometry.tangents[i].w < 0 ? -1.0f : 1.0f);
    }
    if (!std::ranges::is_sorted(order)) mesh.order = order;
    return mesh;
}

}  // namespace goffer::fit
