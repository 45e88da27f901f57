// SPDX-License-Identifier: MIT
#include "rest.hpp"

#include <goffer/bend/body_input.hpp>
#include <goffer/bend/region.hpp>

#include <algorithm>
#include <vector>

/// Joints that folds run on over. See modules/paper/README.md, "Folds over joints".

namespace goffer::fit {
namespace {

/// What the wave of a region is multiplied by at one of its ends.
double wave_depth(const RestRegion& region, double z) {
    return paper::wave_depth(region.shape.get(), z);
}

/// Whether two regions are bent along the same arc at rest. `radius`: of the base.
bool share_rest_arc(const RestRegion& a, const RestRegion& b, double radius) {
    const auto input = [](const RestRegion& region) {
        bend::RegionInput result;
        result.length = region.length;
        result.rest_angle = region.rest.angle, result.rest_direction = region.rest.direction;
        result.radius = region.shape ? region.shape->radius() : 0;
        return result;
    };
    return bend::share_rest_arc(input(a), input(b), radius);
}

/// The thickest part of a region at `count` heights from `first` to `last`.
double thickest(const RestRegion& region, double radius, double first, double last, int count) {
    if (!region.shape) return radius;
    double scale = 0;
    for (int i = 0; i < count; ++i)
        scale = std::max(scale, region.shape->scale(first + (last - first) * i / (count - 1)));
    return scale * region.shape->radius();
}

/// Whether columns of both regions, and of either where the other's wrinkles reach, are squeezed at rest by
/// less than bend::Body::check() allows for regions on different arcs.
bool bears_other_arc(const RestRegion& region, const RestRegion& next, double radius, double blend) {
    // Leaves something, since heights are looked at singly.
    constexpr double most_squeeze = bend::WorkingRange::max_joint_rest - 0.03;
    const double own =
        std::max(thickest(region, radius, 0, region.length, 64), thickest(next, radius, 0, blend, 5));
    const double other = std::max(thickest(next, radius, 0, next.length, 64),
                                  thickest(region, radius, region.length - blend, region.length, 5));
    return 2 * region.rest.angle * own / region.length <= most_squeeze &&
           2 * next.rest.angle * other / next.length <= most_squeeze;
}

/// How far about a joint wrinkles pass into each other: a quarter of the shorter fold there, from its crest
/// or trough at the joint to where it crosses the surface at rest. 0 where one of the regions hardly
/// wrinkles.
double blend_at_joint(const RestRegion& region, const RestRegion& next, double radius, bool has_onset) {
    constexpr double least_depth = 0.05, least_share = 2e-5;
    if (region.folds.count == 0 || next.folds.count == 0) return 0;
    // A relative squeeze does not pass into one that is not.
    if (!has_onset && (region.rest.angle != 0) != (next.rest.angle != 0)) return 0;
    const double depth = wave_depth(region, region.length), next_depth = wave_depth(next, 0);
    if (!(std::min(depth, next_depth) > least_depth)) return 0;
    const auto quarter_fold = [](const RestRegion& r, double d) {
        return r.length / (4 * r.folds.count) * std::min(d, 1.0);
    };
    const double own = quarter_fold(region, depth), other = quarter_fold(next, next_depth);
    constexpr double most_ratio = 3;
    if (std::max(own, other) > most_ratio * std::min(own, other)) return 0;
    const double blend = std::min(own, other);
    if (!share_rest_arc(region, next, radius) && !bears_other_arc(region, next, radius, blend)) return 0;
    return blend > least_share * std::max(region.length, next.length) ? blend : 0;
}

}  // namespace

void join_folds(std::vector<RestRegion>& regions, double radius, double onset) {
    for (std::size_t first = 0; first < regions.size();) {
        std::size_t last = first + 1;
        int total = regions[first].folds.count;
        for (; last < regions.size(); ++last) {
            RestRegion& before = regions[last - 1];
            before.blend = blend_at_joint(before, regions[last], radius, onset != 0);
            if (before.blend == 0) break;
            total += regions[last].folds.count;
        }
        int before = 0;
        for (; first < last; ++first) {
            const int own = regions[first].folds.count;
            regions[first].folds = {own, before, total};
            before += own;
        }
    }
}

double gain_at_joint(const RestRegion& region, const RestRegion& next) {
    return region.blend == 0 ? 1 : wave_depth(next, 0) / wave_depth(region, region.length);
}

}  // namespace goffer::fit
