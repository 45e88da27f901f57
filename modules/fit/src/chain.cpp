// SPDX-License-Identifier: MIT
#include "chain.hpp"

#include "bent_tube.hpp"
#include "center_line.hpp"
#include "least_squares.hpp"
#include "rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace goffer::fit {
namespace {

/// Lengths that a chain is fitted by, for a body of such a radius, in units of the body's size. A joint takes
/// a stretch of the body.
ChainLimits limits_of(double radius) {
    return {.radius = radius, .shortest = 1.5 * radius, .tolerance = 0.08};
}

View view_about(const Body& body, const ArcChain& chain) {
    return View(body, [&chain](const Vector3d& place) { return chain.straightened(place); });
}

/// The centers of the circles (Kasa 1976) of the sections about a chain. Sections that have none near the
/// chain are left out, as are both ends, where a chain tells too little of the directions of sections.
std::vector<CenterPoint> section_centers(const Body& body, const ArcChain& chain, const ChainLimits& limits) {
    struct Sums {
        Matrix3d normal = Matrix3d::Zero();
        Vector3d right = Vector3d::Zero();
        double weight = 0, z = 0;
    };
    constexpr double least_radius = 0.2, askew = 0.7;  // of the body's, and of a section's own
    const View view = view_about(body, chain);
    const auto [low, high] = extent(body, view);
    const double count =
        std::clamp((high - low) / (center_step * limits.radius), fewest_centers, most_centers);
    const Slices slices(body, view, static_cast<std::size_t>(count));
    std::vector<Sums> sums(slices.count());
    double all = 0;
    slices.each([&](const Sample& s, std::size_t slice, double weight) {
        const Vector3d row{1, 2 * s.place.x(), 2 * s.place.y()};
        Sums& own = sums[slice];
        own.normal += weight * row * row.transpose();
        own.right += weight * s.rho * s.rho * row;
        own.weight += weight;
        own.z += weight * s.place.z();
        all += weight;
    });
    std::vector<CenterPoint> points;
    const double step = (high - low) / static_cast<double>(sums.size());
    for (std::size_t i = 1; i + 1 < sums.size(); ++i) {
        const Sums& own = sums[i];
        if (!(own.weight > 0.1 * all / static_cast<double>(sums.size()))) continue;
        const Vector3d by = least_squares(own.normal, own.right);
        const double from_axis = by.tail<2>().norm(), radius = std::sqrt(by[0] + from_axis * from_axis);
        if (!(from_axis < limits.radius && radius > 0)) continue;
        if (static_cast<double>(std::min(i, sums.size() - 1 - i)) * step < askew * radius) continue;
        append(points, chain.bent({by[1], by[2], own.z / own.weight}), own.weight / all,
               std::max(radius, least_radius * limits.radius));
    }
    return points;
}

Vector3d chord_of(const std::vector<CenterPoint>& points) {
    return (points.back().place - points.front().place).stableNormalized();
}

/// Turns the points around if `axis` asks for it.
void orient(std::vector<CenterPoint>& points, const std::optional<Vector3d>& axis) {
    const Vector3d chord = chord_of(points);
    const double along = axis ? chord.dot(*axis) : chord[first_largest(chord.cwiseAbs())];
    if (!(along < 0)) return;
    const double length = points.back().along;
    std::ranges::reverse(points);
    for (CenterPoint& point : points) point.along = length - point.along;
}

/// The chain, with arcs straight that are so as far as anyone can see.
ArcChain with_straight_arcs(const ArcChain& chain, const ChainLimits& limits) {
    constexpr double least_angle = 0.003, least_sag = 0.005;
    std::vector<ChainArc> arcs = chain.arcs();
    for (ChainArc& arc : arcs) {
        const double angle = arc.length * arc.curvature.norm();
        if (angle < least_angle && angle * arc.length / 8 < least_sag * limits.radius)
            arc.curvature.setZero();
    }
    const Line start = chain.line_at(0);
    return {start.point, start.frame, arcs};
}

/// The chain without arcs at its ends of which less than `least` lies within the heights from `low` to
/// `high`: those beside them go on.
ArcChain trimmed(const ArcChain& chain, double low, double high, double least) {
    std::vector<ChainArc> arcs = chain.arcs();
    double end = 0;
    for (const ChainArc& arc : arcs) end += arc.length;
    while (arcs.size() > 1 && end - arcs.back().length > high - least) {
        end -= arcs.back().length;
        arcs.pop_back();
    }
    double start = 0;
    while (arcs.size() > 1 && start + arcs.front().length < low + least) {
        start += arcs.front().length;
        arcs.erase(arcs.begin());
    }
    const Line base = chain.line_at(start);
    return {base.point, base.frame, arcs};
}

/// The chain as a cylinder in model space, from the lowest to the highest vertex. Nothing if an arc has no
/// inner side.
std::optional<Cylinder> cylinder_of(const Body& body, const ArcChain& chain) {
    const View view = view_about(body, chain);
    const std::optional<Section> section = section_around(body, view);
    if (!section) return std::nullopt;
    const auto [low, high] = extent(body, view);
    const Line carried = chain.line_at(low), base = line_through(carried.point, carried.axis());
    const double r = section->radius;
    const Vector3d zero = carried.frame.transpose() * base.frame.col(0);
    Cylinder cylinder;
    cylinder.origin = from_eigen(body.middle + body.size * base.point);
    cylinder.axis = from_eigen(base.axis());
    cylinder.zero = from_eigen(base.frame.col(0));
    cylinder.radius = body.size * r;
    cylinder.residual = section->residual;
    cylinder.length = 0;
    double start = 0;
    for (std::size_t i = 0; i < chain.arcs().size(); ++i) {
        const ChainArc& arc = chain.arcs()[i];
        const double from = i == 0 ? low : start;
        start += arc.length;
        const double length = (i + 1 == chain.arcs().size() ? high : start) - from;
        const double angle = length * arc.curvature.norm();
        if (!(length > 0 && has_inner_line(length + angle * r, angle, r))) return std::nullopt;
        const double direction =
            std::atan2(arc.curvature.y(), arc.curvature.x()) - std::atan2(zero.y(), zero.x());
        const double halves = std::ceil(std::max(angle / std::numbers::pi, 1.0));  // of a turn
        const RestArc own{body.size * (length + angle * r) / halves, angle / halves,
                          angle == 0 ? 0 : std::remainder(direction, 2 * std::numbers::pi)};
        cylinder.arcs.insert(cylinder.arcs.end(), static_cast<std::size_t>(halves), own);
    }
    for (const RestArc& arc : cylinder.arcs) cylinder.length += arc.length;
    return cylinder;
}

/// How far the sections lie to one side of the chain: 0 where they surround it, 1 where they do not.
double one_sidedness(const Body& body, const View& view) {
    struct Sums {
        double weight = 0;
        Eigen::Vector2d side = Eigen::Vector2d::Zero();
    };
    const Slices slices(body, view, 48);
    std::vector<Sums> sums(slices.count());
    slices.each([&](const Sample& s, std::size_t slice, double weight) {
        sums[slice].weight += weight;
        sums[slice].side += weight / s.rho * s.place.head<2>();
    });
    double all = 0, one_sided = 0;
    for (const Sums& own : sums) {
        all += own.weight;
        one_sided += own.side.norm();
    }
    return one_sided / all;
}

/// How far the middle of the body lies from a line, at most.
double aside(const std::vector<CenterPoint>& points, const Line& line) {
    const Straightened straightened(line);
    double most = 0;
    for (const CenterPoint& point : points) most = std::max(most, straightened(point.place).head<2>().norm());
    return most;
}

/// The radius of a tube that has the body's area and goes once across its box, at least: a body that runs to
/// and fro is slimmer.
double slimmest(const Body& body) {
    return area_of(body) / (2 * std::numbers::pi);
}

/// Whether all of the body lies between the ends of the cylinder. A ring, say, has none that a chain finds.
bool holds(const Cylinder& cylinder, const Body& body) {
    constexpr double slack = 2.5e-4;  // of the first and the last arc: half of what rest_mesh() clamps to
    const Straightening straightening(cylinder);
    return std::ranges::all_of(body.triangles, [&](std::uint32_t i) {
        const double z = straightening.height(from_eigen(body.middle + body.size * body.points[i]));
        return z > -slack * cylinder.arcs.front().length &&
               z < cylinder.length + slack * cylinder.arcs.back().length;
    });
}

constexpr std::size_t fewest_points = 6;

/// The chain through the middle of the body, of `arcs` or, where that is 0, of as few as follow it. `noise`:
/// the tolerance for the first points, which are less exact.
std::optional<ArcChain> chain_through(const Body& cloud, std::vector<CenterPoint> points,
                                      const ChainLimits& limits, std::size_t arcs, double noise) {
    constexpr int rounds = 3;
    for (int round = 0;; ++round) {
        const ChainLimits own = {limits.radius, limits.shortest, round == 0 ? noise : limits.tolerance};
        std::optional<ArcChain> chain =
            arcs == 0 ? fit_fewest_arcs(points, own) : fit_arcs(points, own, arcs);
        if (!chain || round == rounds) return chain;
        points = section_centers(cloud, *chain, limits);
        if (points.size() < fewest_points) return std::nullopt;
    }
}

/// What a further arc has to lower roughness to, so that it does not follow noise.
constexpr double clearly_better = 0.7;

/// The chain of as few arcs as follow the body, and one more where that does so far better. Points that are
/// less exact than they might be are followed by needless arcs, and those that are more exact by too few:
/// both are tried.
std::optional<ArcChain> fewest_arcs_through(const Body& cloud, const std::vector<CenterPoint>& points,
                                            const ChainLimits& limits) {
    constexpr double better = 0.8, rough_enough = 0.04;
    std::optional<ArcChain> best;
    double least = std::numeric_limits<double>::infinity();
    const auto takes = [&](std::optional<ArcChain> chain, double share) {
        const double rough = chain ? roughness(cloud, view_about(cloud, *chain)) : least;
        if (!(rough < share * least)) return false;
        least = rough;
        best = std::move(chain);
        return true;
    };
    for (const double noise : {1.5 * limits.tolerance, limits.tolerance})
        takes(chain_through(cloud, points, limits, 0, noise), better);
    const auto takes_one_more = [&] {
        const std::size_t arcs = best->arcs().size() + 1;
        return arcs <= max_arcs &&
               takes(chain_through(cloud, points, limits, arcs, limits.tolerance), clearly_better);
    };
    while (best && least > rough_enough * limits.radius && takes_one_more()) {
    }
    return best;
}

/// The chain as far as the body reaches, with arcs straight that are nearly so.
ArcChain finished(const Body& body, const ArcChain& found, const ChainLimits& limits) {
    const ArcChain chain = with_straight_arcs(found, limits);
    const auto [low, high] = extent(body, view_about(body, chain));
    return trimmed(chain, low, high, limits.shortest / 2);
}

/// Points along the middle of the body from base to tip; none where it is too stout for a chain, or does not
/// lie along the axis.
CenterPoints points_along(const Body& body, const std::optional<Vector3d>& axis) {
    CenterPoints found = center_points(body);
    if (found.points.size() < fewest_points) return {{}, found.radius};
    if (axis && !lies_along(chord_of(found.points), *axis)) return {{}, found.radius};
    orient(found.points, axis);
    return found;
}

/// The base about a chain, if the sections lie all around it and the body between its ends. `view`: of the
/// cloud, about the chain.
std::optional<Cylinder> base_about(const ArcChain& chain, const Body& body, const Body& cloud,
                                   const View& view) {
    constexpr double most_one_sided = 0.25;
    if (!(one_sidedness(cloud, view) < most_one_sided)) return std::nullopt;
    std::optional<Cylinder> cylinder = cylinder_of(body, chain);
    if (cylinder && !holds(*cylinder, body)) return std::nullopt;
    return cylinder;
}

/// The base with `count` arcs, the longest of which are halved for it.
Cylinder cut_to(Cylinder cylinder, std::size_t count) {
    while (cylinder.arcs.size() < count) {
        const auto longest = std::ranges::max_element(cylinder.arcs, {}, &RestArc::length);
        longest->length /= 2;
        longest->angle /= 2;
        cylinder.arcs.insert(longest, *longest);
    }
    return cylinder;
}

/// Whether sections about a chain, of the roughness `now`, are circles where those about a line are not.
bool is_clean(double now, double rough, double radius) {
    return now < 0.1 * radius && now < 0.45 * rough;
}

/// Whether they are at least better.
bool is_better(double now, double rough, double radius) {
    return (now < 0.2 * radius && now < 0.7 * rough) || (now < 0.25 * radius && now < 0.5 * rough);
}

constexpr std::size_t samples = 4000;

}  // namespace

std::optional<Cylinder> fit_chain(const Body& body, const Line& line, const std::optional<Vector3d>& axis) {
    constexpr double least_rough = 0.08, rough_enough = 0.12;  // of the line's radius
    constexpr double least_aside = 0.25, far_aside = 1;        // radii
    constexpr double few_times = 4;  // what a line's radius may be of the slimmest that is possible
    std::vector<std::uint32_t> triangles;
    const Body cloud = sampled_surface(body, samples, triangles);
    const View along_line(cloud, line);
    const double rough = roughness(cloud, along_line);
    const std::optional<Section> before = section_around(cloud, along_line);
    const bool slim = before && before->radius < few_times * slimmest(body);
    if (slim && !(rough > least_rough * before->radius)) return std::nullopt;
    const CenterPoints found = points_along(body, axis);
    if (found.points.empty()) return std::nullopt;
    const double bow = aside(found.points, line) / found.radius;
    if (!(bow > least_aside)) return std::nullopt;
    const ChainLimits limits = limits_of(found.radius);
    const std::optional<ArcChain> through = fewest_arcs_through(cloud, found.points, limits);
    if (!through) return std::nullopt;
    const ArcChain chain = finished(body, *through, limits);
    if (chain.arcs().size() < 2) return std::nullopt;
    const View view = view_about(cloud, chain);
    const double now = roughness(cloud, view);
    // What bends by less than a radius may be a relief, unless that is a clean tube.
    const bool far = bow > far_aside && !(slim && !(rough > rough_enough * before->radius));
    if (!is_clean(now, rough, limits.radius) && !(far && is_better(now, rough, limits.radius)))
        return std::nullopt;
    const std::optional<Cylinder> base = base_about(chain, body, cloud, view);
    return base && is_bent_tube(body, *base) ? base : std::nullopt;
}

std::optional<Cylinder> fit_chain_of(const Body& body, std::size_t arcs,
                                     const std::optional<Vector3d>& axis) {
    std::vector<std::uint32_t> triangles;
    const Body cloud = sampled_surface(body, samples, triangles);
    const CenterPoints found = points_along(body, axis);
    if (found.points.empty()) return std::nullopt;
    const ChainLimits limits = limits_of(found.radius);
    struct Followed {
        Cylinder base;
        double rough;
    };
    const auto follow = [&](std::size_t count) -> std::optional<Followed> {
        const std::optional<ArcChain> through =
            count == 0 ? fewest_arcs_through(cloud, found.points, limits)
                       : chain_through(cloud, found.points, limits, count, limits.tolerance);
        if (!through) return std::nullopt;
        const ArcChain chain = finished(body, *through, limits);
        const View view = view_about(cloud, chain);
        std::optional<Cylinder> base = base_about(chain, body, cloud, view);
        if (!base) return std::nullopt;
        return Followed{*std::move(base), roughness(cloud, view)};
    };
    std::optional<Followed> best = follow(0);
    const auto take_fewer = [&](std::size_t count) {
        std::optional<Followed> other = follow(count);
        if (other && (!best || other->base.arcs.size() < best->base.arcs.size())) best = std::move(other);
    };
    // Fewer may be fewer still, since arcs beyond an end are left out; or more, since one of more than a half
    // turn becomes two.
    const auto few_enough = [&] { return best && best->base.arcs.size() <= arcs; };
    for (std::size_t count = std::min(arcs, max_arcs); count > 0 && !few_enough(); --count) take_fewer(count);
    for (std::size_t count = arcs + 1; count <= max_arcs && !best; ++count) take_fewer(count);
    if (!best) return std::nullopt;
    if (best->base.arcs.size() >= arcs) return std::move(best->base);
    // Further arcs may follow the body's noise: they have to be clearly better than halves of the others.
    for (std::size_t count = best->base.arcs.size() + 1; count <= std::min(arcs, max_arcs); ++count) {
        std::optional<Followed> more = follow(count);
        if (more && more->base.arcs.size() <= arcs && more->rough < clearly_better * best->rough)
            best = std::move(more);
    }
    return cut_to(std::move(best->base), arcs);
}

}  // namespace goffer::fit
