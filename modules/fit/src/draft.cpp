// SPDX-License-Identifier: MIT
#include "draft.hpp"

#include <goffer/fit/bind.hpp>

#include <algorithm>
#include <cstddef>

namespace goffer::fit {
namespace {

/// How thick a body is near the joints of a region, in the regions beyond them, over the radius of that
/// region: the wrinkles of the region reach there.
double scale_beyond(std::span<const RestRegion> regions, std::size_t r) {
    double scale = 0;
    const auto look = [&](const RestRegion& beyond, double z) {
        if (regions[r].shape && beyond.shape)
            scale =
                std::max(scale, beyond.shape->scale(z) * beyond.shape->radius() / regions[r].shape->radius());
    };
    for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        if (r > 0 && regions[r - 1].blend != 0)
            look(regions[r - 1], regions[r - 1].length - part * regions[r - 1].blend);
        if (regions[r].blend != 0) look(regions[r + 1], part * regions[r].blend);
    }
    return scale;
}

/// Calls visit(vertex) for each vertex of a region that begins with vertex `first`, but for those that no
/// triangle uses: they cannot fold through each other.
template <class Visit>
void each_used(const RestMesh& mesh, std::size_t first, std::size_t count, const Visit& visit) {
    for (std::size_t i = first; i < first + count; ++i)
        if (mesh.used[i]) visit(mesh.vertices[i]);
}

double largest_rho(const RestMesh& mesh, std::size_t first, std::size_t count) {
    double largest = 0;
    each_used(mesh, first, count,
              [&](const bend::RestVertex& vertex) { largest = std::max(largest, vertex.rho); });
    return largest;
}

/// The slices of a region with a shape. `scale_beyond`: see the function; where it is 0 it limits nothing.
Girths girths_of(const RestRegion& rest, paper::Profile profile, const RestMesh& mesh, std::size_t first,
                 std::size_t count, double scale_beyond) {
    constexpr std::size_t slices = 64;
    Girths girths{rest.length, rest.shape->radius(), std::vector<Girth>(slices)};
    for (std::size_t i = 0; i < slices; ++i) {
        Girth& girth = girths.slices[i];
        for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            const double z = rest.length * (static_cast<double>(i) + part) / slices;
            girth.scale = std::max(girth.scale, rest.shape->scale(z));
            girth.depth = std::max(girth.depth, rest.shape->depth(z) * profile.crest());
        }
        girth.rho = girth.scale * girths.radius;
    }
    each_used(mesh, first, count, [&](const bend::RestVertex& vertex) {
        const double slice = std::clamp(vertex.z / rest.length * slices, 0.0, slices - 1.0);
        Girth& girth = girths.slices[static_cast<std::size_t>(slice)];
        girth.rho = std::max(girth.rho, vertex.rho);
    });
    girths.slices.push_back({scale_beyond, scale_beyond * girths.radius, 0});
    return girths;
}

/// The thickest part of a region or what reaches into it, over the region's radius. Between the heights that
/// a shape was looked at it may be thicker by a trace, as far as `max_angle` has room for that.
double max_scale_of(const Plan& plan, double max_angle) {
    constexpr double trace = 1e-3, nearly = 1 - 1e-5;
    const RestRegion& rest = plan.rest;
    if (!rest.shape) return 1;
    const double thickest = std::max({1.0, rest.shape->max_scale(), plan.scale_beyond});
    const double room = nearly * rest.length / (2 * rest.shape->radius() * max_angle);
    return std::max(thickest, std::min((1 + trace) * thickest, room));
}

bend::RegionInput region_input(const Plan& plan, double onset, std::size_t vertex_count) {
    const RestRegion& rest = plan.rest;
    const Cylinder& cylinder = plan.cylinder;
    const BindOptions& options = plan.options;
    const double radius = rest.shape ? rest.shape->radius() : cylinder.radius;
    bend::RegionInput region;
    region.length = rest.length;
    region.vertex_count = vertex_count;
    region.onset = rest.folds.count == 0 ? 0 : onset;
    region.rest_angle = rest.rest.angle;
    region.rest_direction = rest.rest.direction;
    region.max_angle = plan.max_angle(1);
    region.radius = radius;
    region.max_scale = max_scale_of(plan, region.max_angle);
    region.blend = rest.blend;
    region.blend_gain = plan.blend_gain;
    region.table = make_wrinkle_table(options.profile, options.amplitude, rest.folds, rest.length, radius,
                                      region.max_angle, options.table_rows, region.max_scale);
    return region;
}

}  // namespace

double Plan::max_angle(double factor) const {
    const double largest = rest.shape
                               ? largest_angle(girths, options.profile, options.amplitude, rest.folds, factor)
                               : largest_angle(options.profile, options.amplitude, rest.folds, rest.length,
                                               cylinder.radius, largest_rho, factor);
    return std::min(std::max(rest.rest.angle, largest), bend::WorkingRange::max_angle);
}

Draft::Draft(const Geometry& geometry, const Cylinder& cylinder, const BindOptions& options, double onset,
             std::span<const RestRegion> places, const Parts* parts)
    : mesh(rest_mesh(geometry, cylinder, options.profile, places, parts)) {
    std::size_t first = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::size_t count = mesh.counts[i];
        const double beyond = scale_beyond(places, i);
        plans.push_back(
            {cylinder, options, places[i], largest_rho(mesh, first, count),
             places[i].shape ? girths_of(places[i], options.profile, mesh, first, count, beyond) : Girths{},
             beyond, i + 1 < places.size() ? gain_at_joint(places[i], places[i + 1]) : 1});
        regions.push_back(region_input(plans[i], onset, count));
        first += count;
    }
}

}  // namespace goffer::fit
