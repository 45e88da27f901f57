// SPDX-License-Identifier: MIT
#include "depth.hpp"
#include "draft.hpp"
#include "factors.hpp"
#include "mask.hpp"
#include "parts.hpp"
#include "profile.hpp"
#include "rest.hpp"
#include "share.hpp"
#include "text.hpp"
#include "triangle.hpp"

#include <goffer/bend/body_input.hpp>
#include <goffer/fit/bind.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
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
    const int most = max_folds(options.profile);
    const auto check_folds = [most](std::optional<int> folds) {
        if (folds && (*folds < 0 || *folds > most))
            throw Error("folds: " + std::to_string(*folds) + " is outside 0.." + std::to_string(most));
    };
    check_folds(options.folds);
    for (const RegionOptions& region : options.regions) check_folds(region.folds);
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
        // Folds that are each as long as the rows there need may be more than folds of one length.
        if (even && !asked) found.back().folds_capacity = std::max(found.back().folds_capacity, plan.folds);
    }
    if (even && options.folds_over_joints && options.amplitude != Amplitude::area) {
        join_folds(rest, cylinder.radius, onset);
        for (std::size_t r = 0; r < rest.size(); ++r)
            found[r].wave = rest[r].folds, found[r].blend = rest[r].blend;
    }
    return found;
}

/// The base that `options` ask for.
Cylinder base_of(const Geometry& geometry, const Cylinder& cylinder, const BindOptions& options) {
    if (!has_one_radius(cylinder, options))
        return cylinder.radii.empty() ? fit_shape(geometry, cylinder) : cylinder;
    Cylinder base = with_one_radius(cylinder);
    check(base);
    return base;
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
/// surfaces stay in order in any pose. `ease`: as Parts::weigh() has it.
void weigh(Parts& parts, const Cylinder& cylinder, std::span<const RestRegion> regions, Profile profile,
           double ease) {
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
    parts.weigh(of(depths), of(deepest), ease);
}

/// Lets factors on both sides of a joint be the same, so that a wrinkle of one depth runs over it. No list
/// counts as 1.
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
    // Of a region whose wave runs on: fewer have no room to change their depth.
    constexpr int least_folds = 4;
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

/// The parts of the body, not weighed yet; null where all bear all.
std::unique_ptr<const Parts> parts_of(const Geometry& geometry, const Cylinder& cylinder,
                                      const BindOptions& options, std::span<const RestRegion> places) {
    const bool wrinkles =
        std::ranges::any_of(places, [](const RestRegion& region) { return region.folds.count > 0; });
    if (!wrinkles || options.profile.kind != Profile::Kind::even || options.shape != ShapeMode::automatic ||
        options.amplitude == Amplitude::area || !chooses_folds(options))
        return nullptr;
    return std::make_unique<const Parts>(geometry, cylinder);
}

/// Solves the factors with which `body`, made from `draft`, keeps the area of what may wrinkle, and lowers
/// the largest angles where wrinkles become deeper by them. Returns what solve_factors() does.
double keep_area(const bend::Body& body, const Geometry& geometry, const Cylinder& cylinder,
                 const WrinkleRange& range, Draft& draft, const Share& share) {
    Geometry wrinkled = geometry;
    wrinkled.wrinkle_mask = {};  // wrinkles are those that there would be without it
    std::vector<std::uint32_t> triangles;
    if (!range.whole()) {
        triangles = triangles_within(wrinkled, cylinder, range);
        wrinkled.triangles = triangles;
    }
    auto& [mesh, plans, regions] = draft;
    const double missing = solve_factors(body, wrinkled, mesh.order, regions, share);
    for (std::size_t i = 0; i < regions.size(); ++i)
        regions[i].max_angle =
            std::min(regions[i].max_angle, plans[i].max_angle(largest_factor(regions[i].factors)));
    return missing;
}

/// What bind() tells BindOptions::progress: its parts, and how much of the time each takes of a large mesh.
struct BindShares {
    Share draft, weights, weighted_draft, factors;

    BindShares(const std::function<void(double)>& listener, Amplitude amplitude)
        : draft(listener, 0, amplitude == Amplitude::mesh ? 0.15 : 1),
          weights(listener, 0.15, 0.35),
          weighted_draft(listener, 0.35, 0.45),
          factors(listener, 0.45, 1) {}
};

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// A body, with what is solved on it.
class Attempt {
public:
    /// The first three must outlive the attempt. `parts`: as parts_of() has them. `ease`: as Parts::weigh().
    Attempt(const Geometry& geometry, const Cylinder& cylinder, const BindOptions& options, double onset,
            std::vector<RestRegion> places, std::vector<RegionBinding> found, const Parts* parts,
            double ease = 1)
        : geometry_(&geometry),
          cylinder_(&cylinder),
          options_(&options),
          places_(std::move(places)),
          found_(std::move(found)),
          parts_(parts != nullptr ? std::make_shared<Parts>(*parts) : nullptr) {
        if (parts_) weigh(*parts_, cylinder, places_, options.profile, ease);
        draft_ = make_draft(onset);
        body_ = make(cylinder, draft_->regions, draft_->mesh);
        const std::function<void(double)> nobody;  // what is tried again has been told
        const BindShares shares(ease == 1 ? options.progress : nobody, options.amplitude);
        shares.draft.tell(1, 1);
        if (!keeps_area()) return;
        if (options.profile.kind == Profile::Kind::even) {
            weigh_slices(body_, geometry, options, draft_->mesh, places_, found_, shares.weights);
            if (parts_) weigh(*parts_, cylinder, places_, options.profile, ease);
            draft_ = make_draft(onset);
            body_ = make(cylinder, draft_->regions, draft_->mesh);
            shares.weighted_draft.tell(1, 1);
        }
        missing_ = keep_area(body_, geometry, cylinder, options.wrinkle_range, *draft_, shares.factors);
    }

    /// The share of the area that is missing: see solve_factors().
    [[nodiscard]] double missing() const { return missing_; }
    /// Whether there are parts that bear less than all.
    [[nodiscard]] bool eases() const { return parts_ != nullptr && !parts_->sound(); }

    [[nodiscard]] Binding finish(double milliseconds) && {
        apply_mask(*geometry_, *cylinder_, draft_->mesh);
        if (keeps_area() || !geometry_->wrinkle_mask.empty())
            body_ = make(*cylinder_, draft_->regions, draft_->mesh);
        return {std::move(body_),  std::move(found_), std::move(draft_->mesh.order),
                *cylinder_,        options_->profile, options_->amplitude,
                std::move(parts_), milliseconds};
    }

private:
    [[nodiscard]] bool keeps_area() const { return options_->amplitude == Amplitude::mesh; }
    [[nodiscard]] std::unique_ptr<Draft> make_draft(double onset) const {
        return std::make_unique<Draft>(*geometry_, *cylinder_, *options_, onset, places_, parts_.get());
    }

    const Geometry* geometry_;
    const Cylinder* cylinder_;
    const BindOptions* options_;
    std::vector<RestRegion> places_;
    std::vector<RegionBinding> found_;
    std::shared_ptr<Parts> parts_;
    std::unique_ptr<Draft> draft_;  // refers to `places_`
    bend::Body body_;
    double missing_ = 0;
};

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
    check_bindable(given);
    const Cylinder cylinder = base_of(geometry, given, given_options);
    const BindOptions options = with_regions_of(cylinder, given_options);
    const double gentle = cylinder.bent() ? BindOptions::gentle_onset : 0;
    const double onset = options.onset.value_or(gentle);
    check_options(options, cylinder, onset);

    std::vector<RestRegion> places;
    const std::vector<RegionBinding> found = plan(geometry, cylinder, options, onset, places);
    // Thin parts hardly wrinkle. Where the others cannot make up for their area, they bear more, if that
    // helps.
    constexpr double most_missing = 0.0075;
    const std::unique_ptr<const Parts> parts = parts_of(geometry, cylinder, options, places);
    Attempt best(geometry, cylinder, options, onset, places, found, parts.get());
    for (const double ease : {4.0, 16.0}) {
        if (best.missing() <= most_missing || !best.eases()) break;
        Attempt eased(geometry, cylinder, options, onset, places, found, parts.get(), ease);
        if (eased.missing() < best.missing() / 2) best = std::move(eased);
    }
    return std::move(best).finish(milliseconds_since(start));
}

std::vector<std::uint32_t> Binding::vertices_in_body() const {
    if (!order.empty()) {
        if (order.size() != body.vertex_count())
            throw Error("order: has " + std::to_string(order.size()) + " vertices, and the body " +
                        std::to_string(body.vertex_count()) + "; give what bind returned");
        return places_in_body(order);
    }
    std::vector<std::uint32_t> vertices(body.vertex_count());
    std::iota(vertices.begin(), vertices.end(), 0u);
    return vertices;
}

Binding bind_level(const Geometry& level, const Binding& rig) {
    const auto start = std::chrono::steady_clock::now();
    check(level);
    if (rig.body.empty() || rig.body.region_count() != rig.regions.size())
        throw Error("rig: its body is empty or does not have its regions; give what bind returned");
    check(rig.cylinder);
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
