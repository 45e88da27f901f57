// SPDX-License-Identifier: MIT
#include "depth.hpp"
#include "factors.hpp"
#include "girths.hpp"
#include "mask.hpp"
#include "parts.hpp"
#include "profile.hpp"
#include "rest.hpp"
#include "share.hpp"
#include "text.hpp"
#include "triangle.hpp"

#include <goffer/bend/body_input.hpp>
#include <goffer/fit/bind.hpp>
#include <goffer/paper/wave.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace goffer::fit {
namespace {

void check_range(const WrinkleRange& range) {
    if (range.first >= 0 && range.first < range.last && range.last <= 1) return;
    throw Error("wrinkle range: " + text(range.first) + " to " + text(range.last) +
                " is not a stretch of the body; give two shares of its length, such as 0 and 0.8");
}

void check_options(const BindOptions& options, const Cylinder& cylinder, double onset) {
    if (!options.regions.empty()) check(options.regions);
    if (!(onset >= 0 && onset <= 1))
        throw Error("onset: " + text(onset) + " is outside 0..1; give a squeeze, such as 0.001");
    check_range(options.wrinkle_range);
    check(options.profile);
    const int most =
        options.profile.kind == Profile::Kind::even ? 2 * BindOptions::max_folds : BindOptions::max_folds;
    for (const RegionOptions& region : regions_of(options)) {
        if (region.folds && (*region.folds < 0 || *region.folds > most))
            throw Error("folds: " + std::to_string(*region.folds) + " is outside 0.." + std::to_string(most));
    }
    const bool whole = options.wrinkle_range.whole();
    if (options.amplitude == paper::Amplitude::area && (cylinder.bent() || onset != 0 || !whole)) {
        throw Error(std::string("amplitude: area cannot be had for a body ") +
                    (cylinder.bent() ? "that is bent at rest"
                     : whole         ? "with an onset"
                                     : "with a wrinkle range") +
                    "; use mesh");
    }
}

/// Folds of such a length have a length that double holds, whatever the radius.
void check_fold_length(double radii) {
    if (radii >= 1e-40 && radii <= 1e40) return;
    throw Error("fold_length: " + text(radii) + " is not a length; give a number of radii above 0");
}

/// The regions' places on the axis, and how many folds each has and can carry.
std::vector<RegionBinding> plan(const Geometry& geometry, const Cylinder& cylinder,
                                const BindOptions& options, double onset, std::vector<RestRegion>& rest) {
    std::vector<RegionBinding> found;
    const Rows rows(geometry, cylinder);
    const bool even = options.profile.kind == Profile::Kind::even;
    for (const RegionOptions& region : regions_of(options)) {
        const Cylinder stretch = stretch_of(cylinder, region.share * cylinder.length);
        const double start = rest.empty() ? 0 : rest.back().start + rest.back().length;
        const int capacity = rows.folds(options.profile, start, start + stretch.length);
        std::optional<int> asked = region.folds;
        if (options.amplitude == paper::Amplitude::none) asked = 0;
        if (!asked && !even)
            asked = sensible_folds(stretch, std::min(capacity, BindOptions::max_folds), options.fold_length);
        FoldPlan plan = plan_folds(cylinder, rows, options, start, stretch.length, asked);
        rest.push_back(
            {start, stretch.length, plan.folds, plan.shape, 0, rest_of(cylinder, start, stretch.length)});
        found.push_back({stretch.length, plan.folds, capacity, std::move(plan.shape), plan.folds});
        if (even && !options.wrinkle_range.whole()) {
            // Any mesh will do where it stays smooth.
            const double low = std::max(options.wrinkle_range.first * cylinder.length, start);
            const double high =
                std::min(options.wrinkle_range.last * cylinder.length, start + stretch.length);
            const double smooth = 1 - std::max(high - low, 0.0) / stretch.length;
            found.back().folds_capacity = static_cast<int>(std::ceil(smooth * rest.back().folds.count)) +
                                          (low < high ? rows.folds(options.profile, low, high) : 0);
        }
    }
    if (even && options.folds_over_joints && options.amplitude != Amplitude::area) {
        join_folds(rest, cylinder.radius, onset);
        for (std::size_t r = 0; r < rest.size(); ++r)
            found[r].wave = rest[r].folds, found[r].blend = rest[r].blend;
    }
    return found;
}

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

/// The base that `options` ask for.
Cylinder base_of(const Geometry& geometry, const Cylinder& cylinder, const BindOptions& options) {
    if (!has_one_radius(cylinder, options))
        return cylinder.radii.empty() ? fit_shape(geometry, cylinder) : cylinder;
    Cylinder base = with_one_radius(cylinder);
    check(base);
    return base;
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

/// A region to be bound, and what its largest angle depends on.
struct Plan {
    const Cylinder& cylinder;
    const BindOptions& options;
    const RestRegion& rest;
    double largest_rho;
    Girths girths;  // of a region with a shape
    double scale_beyond;
    double blend_gain;

    /// The largest angle with wrinkles `factor` times as deep. It is never less than the rest arc's: there is
    /// no wrinkle at rest. In bodies that are thousands of radii long it is the largest that a body can have.
    [[nodiscard]] double max_angle(double factor) const {
        const double largest =
            rest.shape ? largest_angle(girths, options.profile, options.amplitude, rest.folds, factor)
                       : largest_angle(options.profile, options.amplitude, rest.folds, rest.length,
                                       cylinder.radius, largest_rho, factor);
        return std::min(std::max(rest.rest.angle, largest), bend::WorkingRange::max_angle);
    }
};

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
    // Between the heights that a shape was looked at it may be thicker by a trace.
    region.max_scale =
        rest.shape ? std::max(1.0, 1.001 * std::max(rest.shape->max_scale(), plan.scale_beyond)) : 1;
    region.blend = rest.blend;
    region.blend_gain = plan.blend_gain;
    region.table = make_wrinkle_table(options.profile, options.amplitude, rest.folds, rest.length, radius,
                                      region.max_angle, options.table_rows, region.max_scale);
    return region;
}

double largest_factor(const bend::FactorTable& factors) {
    float square = 1;
    for (const auto& row : factors.rows) square = std::max(square, *std::ranges::max_element(row));
    return std::sqrt(static_cast<double>(square));
}

/// Throws Error where Body::check finds a fault.
bend::Body make(const Cylinder& cylinder, std::span<const bend::RegionInput> regions, const RestMesh& mesh) {
    bend::BodyInput input;
    input.origin = cylinder.origin;
    input.axes = axes_of(cylinder);
    input.radius = cylinder.radius;
    input.regions = regions;
    input.vertices = mesh.vertices;
    input.normals = mesh.normals;
    input.tangents = mesh.tangents;
    input.tangent_signs = mesh.tangent_signs;
    std::optional<bend::Body> body = bend::Body::make(input);
    if (!body) throw Error(std::string("cannot bind: ") + bend::describe(bend::Body::check(input)).c_str());
    return std::move(*body);
}

/// All that a body is made from.
struct Draft {
    RestMesh mesh;
    std::vector<Plan> plans;  // of the regions
    std::vector<bend::RegionInput> regions;

    /// `places` must stay where they are.
    Draft(const Geometry& geometry, const Cylinder& cylinder, const BindOptions& options, double onset,
          std::span<const RestRegion> places, const Parts* parts)
        : mesh(rest_mesh(geometry, cylinder, options.profile, places, parts)) {
        std::size_t first = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const std::size_t count = mesh.counts[i];
            const double beyond = scale_beyond(places, i);
            plans.push_back({cylinder, options, places[i], largest_rho(mesh, first, count),
                             places[i].shape
                                 ? girths_of(places[i], options.profile, mesh, first, count, beyond)
                                 : Girths{},
                             beyond, i + 1 < places.size() ? gain_at_joint(places[i], places[i + 1]) : 1});
            regions.push_back(region_input(plans[i], onset, count));
            first += count;
        }
    }
};

constexpr double right_angle = std::numbers::pi / 2;

/// Lowers factors on a region's wrinkle, at equal steps from end to end, so that in a body that is bent by a
/// right angle it is nowhere deeper than a share of the radius there. Lowers none in a region bent at rest.
void keep_shallow(double body_length, const RestRegion& rest, const bend::RegionInput& input, Profile profile,
                  std::vector<double>& factors) {
    constexpr double most_depth = 0.23;
    if (input.rest_angle != 0) return;
    const WrinkleDepth depth(rest, input.radius, profile, right_angle, body_length);
    for (std::size_t i = 0; i < factors.size(); ++i) {
        const double z = rest.length * static_cast<double>(i) / static_cast<double>(factors.size() - 1);
        const double scale = rest.shape ? rest.shape->scale(z) : 1, deep = depth(z);
        if (deep > 0) factors[i] = std::min(factors[i], most_depth * scale * input.radius / deep);
    }
}

/// Whether nobody has said how long folds are to be.
bool chooses_folds(const BindOptions& options) {
    const std::vector<RegionOptions> regions = regions_of(options);
    return !options.fold_length && std::ranges::none_of(regions, [](const RegionOptions& region) {
        return region.folds.has_value();
    });
}

/// Weighs what parts bear of the wrinkles of `regions`: in a body that is bent by a right angle, but so that
/// surfaces stay in order in any pose.
void weigh(Parts& parts, const Cylinder& cylinder, std::span<const RestRegion> regions, Profile profile) {
    std::vector<WrinkleDepth> depths, deepest;
    for (const RestRegion& region : regions) {
        depths.emplace_back(region, cylinder.radius, profile, right_angle, cylinder.length);
        // Beyond it the mesh reaches past the center of the arc.
        const double outermost = parts.outermost(region.start, region.start + region.length);
        const double largest = region.length / (cylinder.radius + outermost);
        deepest.emplace_back(region, cylinder.radius, profile, std::max(largest, right_angle), region.length);
    }
    const auto of = [regions](const std::vector<WrinkleDepth>& all) -> Parts::Depth {
        return [regions, &all](double z) {
            const std::size_t r = region_at(regions, z);
            return all[r](z - regions[r].start);
        };
    };
    parts.weigh(of(depths), of(deepest));
}

/// Lets factors on both sides of a joint be the same, so that a wrinkle of one depth runs over it. None: 1.
void meet(std::vector<double>& factors, std::vector<double>& next) {
    constexpr double least = 0.1;  // so that neither side's wrinkle is lost in the other's
    double* const sides[] = {factors.empty() ? nullptr : &factors.back(),
                             next.empty() ? nullptr : &next.front()};
    double sum = 0;
    for (const double* side : sides) sum += side != nullptr ? *side : 1;
    const bool both = sides[0] != nullptr && sides[1] != nullptr;
    for (double* side : sides)
        if (side != nullptr) *side = both ? std::max(sum / 2, least) : 1;
}

/// Gives each region the weights m(z) with which the slices of the mesh keep their area, as far as shallow
/// wrinkles can, unless long ones were asked for.
void weigh_slices(const bend::Body& body, const Geometry& geometry, const BindOptions& options,
                  const RestMesh& mesh, std::vector<RestRegion>& places, std::vector<RegionBinding>& found,
                  const Share& share) {
    std::vector<double> heights;
    for (std::size_t r = 0; r < places.size(); ++r) {
        for (std::size_t i = body.regions()[r].first; i < body.regions()[r].last; ++i)
            heights.push_back(places[r].start + mesh.vertices[i].z);
    }
    constexpr int least_folds =
        4;  // of a region whose wave runs on: fewer have no room to change their depth
    std::vector<std::vector<double>> factors(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const paper::FoldRange& folds = places[i].folds;
        if (!folds.whole() && folds.count < least_folds) continue;
        factors[i] =
            solve_weights(body, geometry, mesh.order, heights, i, folds.count, share.step(i, places.size()));
        if (factors[i].empty() || options.fold_length || regions_of(options)[i].folds) continue;
        keep_shallow(body.length(), places[i], body.region_inputs()[i], options.profile, factors[i]);
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i].blend != 0) meet(factors[i], factors[i + 1]);
        if (!factors[i].empty())
            places[i].shape = found[i].shape = weighted(places[i], body.radius(), factors[i]);
    }
}

/// What bind() tells BindOptions::progress: its parts, and how much of the time each takes of a large mesh.
struct BindParts {
    Share draft, weights, weighted_draft, factors;

    BindParts(const std::function<void(double)>& listener, Amplitude amplitude)
        : draft(listener, 0, amplitude == Amplitude::mesh ? 0.15 : 1),
          weights(listener, 0.15, 0.35),
          weighted_draft(listener, 0.35, 0.45),
          factors(listener, 0.45, 1) {}
};

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

std::vector<std::uint32_t> triangles_within(const Geometry& geometry, const Cylinder& cylinder,
                                            const WrinkleRange& range) {
    check(geometry);
    check(cylinder);
    check_range(range);
    const Straightening straightening(cylinder);
    std::vector<std::uint32_t> within;
    for (std::size_t t = 0; t < geometry.triangles.size(); t += 3) {
        const auto corners = geometry.triangles.subspan(t, 3);
        const double share = std::clamp(
            straightening.height(Triangle(geometry.positions, corners).centroid()) / cylinder.length, 0.0,
            1.0);
        if (share >= range.first && share <= range.last && may_wrinkle(geometry, corners))
            within.insert(within.end(), corners.begin(), corners.end());
    }
    return within;
}

Binding bind(const Geometry& geometry, const Cylinder& given, const BindOptions& given_options) {
    const auto start = std::chrono::steady_clock::now();
    check(geometry);
    check(given);
    check_fold_length(given_options.fold_length.value_or(1));
    const Cylinder cylinder = base_of(geometry, given, given_options);
    const BindOptions options = with_regions_of(cylinder, given_options);
    const double gentle = cylinder.bent() ? BindOptions::gentle_onset : 0;
    const double onset = options.onset.value_or(gentle);
    check_options(options, cylinder, onset);

    std::vector<RestRegion> places;
    std::vector<RegionBinding> found = plan(geometry, cylinder, options, onset, places);
    const bool even = options.profile.kind == Profile::Kind::even;
    std::shared_ptr<Parts> parts_found;
    const bool wrinkles =
        std::ranges::any_of(places, [](const RestRegion& region) { return region.folds.count > 0; });
    if (even && wrinkles && options.shape == ShapeMode::automatic && options.amplitude != Amplitude::area &&
        chooses_folds(options)) {
        parts_found = std::make_shared<Parts>(geometry, cylinder);
        weigh(*parts_found, cylinder, places, options.profile);
    }
    std::optional<Draft> draft(std::in_place, geometry, cylinder, options, onset, places, parts_found.get());
    bend::Body body = make(cylinder, draft->regions, draft->mesh);
    const BindParts parts(options.progress, options.amplitude);
    parts.draft.tell(1, 1);
    if (options.amplitude == paper::Amplitude::mesh) {
        if (even) {
            weigh_slices(body, geometry, options, draft->mesh, places, found, parts.weights);
            if (parts_found) weigh(*parts_found, cylinder, places, options.profile);
            draft.emplace(geometry, cylinder, options, onset, places, parts_found.get());
            body = make(cylinder, draft->regions, draft->mesh);
            parts.weighted_draft.tell(1, 1);
        }
        auto& [mesh, plans, regions] = *draft;
        Geometry wrinkled = geometry;  // what is to keep its area
        wrinkled.wrinkle_mask = {};
        std::vector<std::uint32_t> triangles;
        if (!options.wrinkle_range.whole()) {
            triangles = triangles_within(wrinkled, cylinder, options.wrinkle_range);
            wrinkled.triangles = triangles;
        }
        solve_factors(body, wrinkled, mesh.order, regions, parts.factors);
        for (std::size_t i = 0; i < regions.size(); ++i)
            regions[i].max_angle =
                std::min(regions[i].max_angle, plans[i].max_angle(largest_factor(regions[i].factors)));
        body = make(cylinder, regions, mesh);
    }
    if (!geometry.wrinkle_mask.empty()) {  // of the wrinkles that there are without it
        apply_mask(geometry, cylinder, draft->mesh);
        body = make(cylinder, draft->regions, draft->mesh);
    }
    return {std::move(body), std::move(found),  std::move(draft->mesh.order), cylinder,
            options.profile, options.amplitude, std::move(parts_found),       milliseconds_since(start)};
}

std::vector<std::uint32_t> Binding::vertices_in_body() const {
    if (!order.empty()) return places_in_body(order);
    std::vector<std::uint32_t> vertices(body.vertex_count());
    std::iota(vertices.begin(), vertices.end(), 0u);
    return vertices;
}

Binding bind_level(const Geometry& level, const Binding& rig) {
    const auto start = std::chrono::steady_clock::now();
    check(level);
    if (rig.body.empty() || rig.body.region_count() != rig.regions.size())
        throw Error("rig: its body is empty or does not have its regions; give what bind returned");
    const std::vector<RestRegion> places = rest_regions(rig);
    RestMesh mesh = rest_mesh(level, rig.cylinder, rig.profile, places, rig.parts.get());
    apply_mask(level, rig.cylinder, mesh);
    const std::span<const bend::RegionInput> own = rig.body.region_inputs();
    std::vector<bend::RegionInput> regions(own.begin(), own.end());
    std::vector<RegionBinding> found = rig.regions;
    const Rows rows(level, rig.cylinder);
    for (std::size_t i = 0; i < regions.size(); ++i) {
        regions[i].vertex_count = mesh.counts[i];
        const double from = places[i].start;
        found[i].folds_capacity = rows.folds(rig.profile, from, from + found[i].length);
    }
    bend::Body body = make(rig.cylinder, regions, mesh);
    return {std::move(body), std::move(found), std::move(mesh.order),    rig.cylinder, rig.profile,
            rig.amplitude,   rig.parts,        milliseconds_since(start)};
}

}  // namespace goffer::fit
