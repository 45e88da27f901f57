// SPDX-License-Identifier: MIT
#include "parts.hpp"

#include "disjoint_sets.hpp"
#include "places.hpp"
#include "rest.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <unordered_set>

namespace goffer::fit {
namespace {

constexpr std::size_t slice_count = 128;
constexpr double most_wobble = 0.1;  // of a part's size that its center may move by
constexpr double most_depth = 0.35;  // of the size of a part beside the axis that its wrinkle may be deep
constexpr double spread = 0.3;       // radii along the body that a weight passes into others in
constexpr double blend = 1.5;        // greatest depths of a wrinkle over which it does so across the body
// By these, a wrinkle leaves a part of every distance away from the axis in any pose, so that no surface
// passes through another.

/// A piece of a cross-section's outline, in radii of the base.
struct Segment {
    double x, y;              // its middle
    double along_x, along_y;  // from its beginning to its end
    double length;
    std::uint32_t from;  // which crossed edges it joins
    std::uint32_t to;
};

/// The outlines of a mesh at one height.
class CrossSection {
public:
    void add(const std::array<std::uint64_t, 2>& edges, const std::array<double, 4>& ends) {
        const double along_x = ends[2] - ends[0], along_y = ends[3] - ends[1];
        segments_.push_back({(ends[0] + ends[2]) / 2, (ends[1] + ends[3]) / 2, along_x, along_y,
                             std::hypot(along_x, along_y), number(edges[0]), number(edges[1])});
    }

    /// Calls visit(segments) for each connected outline.
    template <class Visit>
    void each_outline(const Visit& visit) {
        for (const Segment& segment : segments_) joined_.join(segment.from, segment.to);
        const auto outline = [&](const Segment& segment) { return joined_.set_of(segment.from); };
        std::ranges::sort(segments_, {}, outline);
        for (auto from = segments_.begin(); from != segments_.end();) {
            const auto to = std::find_if(from, segments_.end(), [&, own = outline(*from)](const Segment& s) {
                return outline(s) != own;
            });
            visit(std::span<const Segment>(&*from, static_cast<std::size_t>(to - from)));
            from = to;
        }
    }

private:
    std::uint32_t number(std::uint64_t edge) {
        const auto [at, added] = numbers_.try_emplace(edge, 0);
        if (added) at->second = joined_.add();
        return at->second;
    }

    std::vector<Segment> segments_;
    std::unordered_map<std::uint64_t, std::uint32_t> numbers_;  // of the edges that are crossed
    DisjointSets joined_;                                       // those of one outline
};

Disc disc_of(std::span<const Segment> outline, double length) {
    Disc disc;
    for (const Segment& s : outline) {
        disc.x += s.length / length * s.x;
        disc.y += s.length / length * s.y;
    }
    double xx = 0, xy = 0, yy = 0;  // moments about the center
    for (const Segment& s : outline) {
        const double share = s.length / length, x = s.x - disc.x, y = s.y - disc.y;
        disc.radius += share * std::hypot(x, y, s.length / std::sqrt(12.0));
        disc.reach = std::max(disc.reach, std::hypot(x, y) + s.length / 2);
        xx += share * (x * x + s.along_x * s.along_x / 12);
        xy += share * (x * y + s.along_x * s.along_y / 12);
        yy += share * (y * y + s.along_y * s.along_y / 12);
    }
    disc.radius = std::max(disc.radius, 1e-9);
    const double least = (xx + yy) / 2 - std::hypot((xx - yy) / 2, xy);
    const double half =
        std::clamp(std::sqrt(2 * std::max(least, 0.0)), 1e-9, disc.radius);  // of its thickness
    disc.size = std::sqrt(half * disc.radius);
    disc.beside = glm::smoothstep(0.5, 1.0, std::hypot(disc.x, disc.y) / disc.radius);
    return disc;
}

/// How much of a displacement away from the axis is away from the center of a part, too: 1 all around a part
/// that the axis runs through, from -1 to 1 about one that lies beside it.
double outward(double x, double y, const Disc& disc) {
    constexpr double least = 0.6;  // of the radius: below it a direction says little
    const double rho = std::sqrt(x * x + y * y);
    if (disc.beside == 0 || rho == 0) return 1;
    const double dx = x - disc.x, dy = y - disc.y;
    const double own = std::max(std::sqrt(dx * dx + dy * dy), least * disc.radius);
    return glm::mix(1.0, (dx * x + dy * y) / (rho * own), disc.beside);
}

/// How far the center of an outline moves where the wrinkle of the inner line is 1 deep, in the direction of
/// bending in which that is the most: a column wrinkles as the cosine of half its angle from the inner line.
double response(std::span<const Segment> outline, double length, const Disc& disc) {
    constexpr int directions = 16;
    double most = 0;
    for (int i = 0; i < directions; ++i) {
        const double theta = 2 * std::numbers::pi * i / directions;
        double x = 0, y = 0;
        for (const Segment& s : outline) {
            const double rho = std::hypot(s.x, s.y);
            if (rho == 0) continue;
            const double half = (std::atan2(s.y, s.x) - theta) / 2;
            const double moved =
                s.length * std::fabs(std::cos(half)) * paper::depth_weight(rho, 1) * outward(s.x, s.y, disc);
            x += moved * s.x / rho;
            y += moved * s.y / rho;
        }
        most = std::max(most, std::hypot(x, y) / length);
    }
    return most;
}

/// Points all along an outline: one in each cell of a grid that it passes through.
std::vector<OutlinePoints> points_of(std::span<const Segment> outline) {
    constexpr double cell = 0.08, most_cells = 1e9;
    constexpr double most_points = 32;  // of one segment
    const auto number = [&](double coordinate) {
        return static_cast<std::uint32_t>(
            static_cast<std::int32_t>(std::floor(std::clamp(coordinate / cell, -most_cells, most_cells))));
    };
    std::unordered_set<std::uint64_t> taken;
    std::vector<OutlinePoints> points;
    for (const Segment& s : outline) {
        const double count = std::clamp(std::ceil(s.length / cell), 1.0, most_points);
        for (double i = 0.5; i < count; ++i) {
            const double share = i / count - 0.5, x = s.x + share * s.along_x, y = s.y + share * s.along_y;
            const std::size_t place = taken.size() % OutlinePoints::count;
            if (!taken.insert(std::uint64_t{number(x)} << 32 | number(y)).second) continue;
            if (place == 0) {
                OutlinePoints& all = points.emplace_back();
                all.x.fill(static_cast<float>(x));
                all.y.fill(static_cast<float>(y));
            }
            points.back().x[place] = static_cast<float>(x);
            points.back().y[place] = static_cast<float>(y);
        }
    }
    return points;
}

/// How far away the nearest point of an outline is. Eight side by side, which the compiler makes vectors of.
double squared_distance(std::span<const OutlinePoints> outline, double x, double y) {
    const auto at_x = static_cast<float>(x), at_y = static_cast<float>(y);
    std::array<float, OutlinePoints::count> least;
    least.fill(std::numeric_limits<float>::max());
    for (const OutlinePoints& points : outline) {
        for (std::size_t i = 0; i < points.count; ++i) {
            const float dx = points.x[i] - at_x, dy = points.y[i] - at_y, squared = dx * dx + dy * dy;
            least[i] = squared < least[i] ? squared : least[i];
        }
    }
    return static_cast<double>(*std::ranges::min_element(least));
}

/// How much a part counts beside others.
double share_of(double radius) {
    constexpr double thick = 0.3;  // counts in full
    return std::pow(std::min(radius / thick, 1.0), 1.25);
}

/// How much more the weight of a part counts than that of one that bears all of its wrinkle, so that where
/// thin parts grow out of a thick one, weights blend in the thick one. The thinner a part is, the less: hairs
/// and fins are all edge, and leave the body that they stand on its wrinkles. What lies on a thick part, such
/// as a grip, goes with it: `distance` is how far away that is on average, in the length that weights blend
/// over.
double priority_of(double weight, double share, double distance) {
    constexpr double least = 0.1, power = 2.5, least_apart = 0.25, apart = 0.75;
    return std::pow(least + weight,
                    -power * std::sqrt(share) * glm::smoothstep(least_apart, apart, distance));
}

std::vector<CrossSection> cross_sections(const Geometry& geometry, const Cylinder& cylinder, double step) {
    const Straightening straightening(cylinder);
    std::vector<glm::dvec3> local;
    local.reserve(geometry.positions.size());
    for (const glm::vec3& position : geometry.positions) {
        paper::Cylindrical at = straightening.vertex(position);
        at.rho /= cylinder.radius;
        local.push_back(paper::from_cylindrical(at));
    }
    const std::vector<std::uint32_t> place = places(geometry.positions);
    std::vector<CrossSection> sections(slice_count);
    for (std::size_t t = 0; t + 2 < geometry.triangles.size(); t += 3) {
        const std::array corner{geometry.triangles[t], geometry.triangles[t + 1], geometry.triangles[t + 2]};
        const auto [low, high] = std::minmax({local[corner[0]].z, local[corner[1]].z, local[corner[2]].z});
        const auto slice_above = [&](double z) {
            return static_cast<std::size_t>(std::clamp(std::ceil(z / step - 0.5), 0.0, double{slice_count}));
        };
        for (std::size_t slice = slice_above(low), last = slice_above(high); slice < last; ++slice) {
            const double height = (static_cast<double>(slice) + 0.5) * step;
            std::array<std::uint64_t, 2> edges{};
            std::array<double, 4> ends{};
            std::size_t crossed = 0;
            for (std::size_t i = 0; i < 3 && crossed < 2; ++i) {
                const std::uint32_t a = corner[i], b = corner[(i + 1) % 3];
                if ((local[a].z < height) == (local[b].z < height)) continue;
                const double share = (height - local[a].z) / (local[b].z - local[a].z);
                const auto [first, second] = std::minmax(place[a], place[b]);
                edges[crossed] = std::uint64_t{first} << 32 | second;
                ends[2 * crossed] = local[a].x + share * (local[b].x - local[a].x);
                ends[2 * crossed + 1] = local[a].y + share * (local[b].y - local[a].y);
                ++crossed;
            }
            if (crossed == 2) sections[slice].add(edges, ends);
        }
    }
    return sections;
}

}  // namespace

Parts::Parts(const Geometry& geometry, const Cylinder& cylinder)
    : slices_(slice_count),
      radius_(cylinder.radius),
      step_(cylinder.length / slice_count),
      reach_(spread * cylinder.radius + step_) {
    std::vector<CrossSection> sections = cross_sections(geometry, cylinder, step_);
    for (std::size_t slice = 0; slice < slice_count; ++slice) {
        sections[slice].each_outline([&](std::span<const Segment> outline) {
            double length = 0;
            for (const Segment& s : outline) length += s.length;
            if (!(length > 0)) return;
            const Disc disc = disc_of(outline, length);
            const double moved = std::max(response(outline, length, disc), 1e-9);
            slices_[slice].parts.push_back({disc, moved, share_of(disc.radius), points_of(outline)});
        });
        std::ranges::stable_sort(slices_[slice].parts, std::greater{},
                                 [](const Part& part) { return part.disc.radius; });
        measure_distances(slices_[slice]);
    }
}

/// Sets how far each part is from thicker ones on average. Thick parts come first.
void Parts::measure_distances(Slice& slice) {
    constexpr double thicker = 1.2;  // times as thick
    for (Part& part : slice.parts) {
        const auto end = std::ranges::find_if(
            slice.parts, [&](const Part& other) { return other.disc.radius <= thicker * part.disc.radius; });
        if (end == slice.parts.begin()) continue;
        const std::span<const Part> thick(slice.parts.data(),
                                          static_cast<std::size_t>(end - slice.parts.begin()));
        double sum = 0;
        for (const OutlinePoints& points : part.outline) {
            for (std::size_t i = 0; i < points.count; ++i)
                sum += distance(thick, static_cast<double>(points.x[i]), static_cast<double>(points.y[i]));
        }
        part.distance = sum / static_cast<double>(part.outline.size() * OutlinePoints::count);
    }
}

/// How far the nearest of the outlines is.
double Parts::distance(std::span<const Part> parts, double x, double y) {
    double least = std::numeric_limits<double>::infinity();
    for (const Part& part : parts) {
        const double from = std::max(std::hypot(x - part.disc.x, y - part.disc.y) - part.disc.reach, 0.0);
        if (from < least) least = std::min(least, std::sqrt(squared_distance(part.outline, x, y)));
    }
    return least;
}

double Parts::outermost(double low, double high) const {
    double most = 0;
    for (std::size_t i = 0; i < slice_count; ++i) {
        const double z = static_cast<double>(i) * step_;
        if (z + step_ < low || z > high) continue;
        for (const Part& part : slices_[i].parts)
            most = std::max(most, std::hypot(part.disc.x, part.disc.y) + part.disc.reach);
    }
    return most * radius_;
}

void Parts::weigh(const Depth& depth, const Depth& deepest, double ease) {
    sound_ = true;
    for (std::size_t i = 0; i < slice_count; ++i) {
        Slice& slice = slices_[i];
        const double z = (static_cast<double>(i) + 0.5) * step_, deep = depth(z) / radius_;
        slice.blend = blend * std::max(deepest(z) / radius_, 1e-3);
        slice.sound = true;
        for (Part& part : slice.parts) {
            const double bearable =
                ease * std::min(most_wobble / part.moved, most_depth / part.disc.beside) * part.disc.size;
            part.weight = deep > 0 ? std::min(bearable / deep, 1.0) : 1;
            part.priority = priority_of(part.weight, share_of(part.disc.size), part.distance / slice.blend);
            slice.sound = slice.sound && part.weight == 1 && part.disc.beside == 0;
        }
        sound_ = sound_ && slice.sound;
    }
}

/// Each part is almost alone near its own outline, if the other's is much farther away than what they blend
/// over. If two are equally far away, the one that bears less counts for more, but hairs for less: where they
/// grow out of a body, they go with it rather than let it be smooth. What hardly counts beside parts before
/// it is left out.
Parts::Near Parts::near(const Slice& slice, double x, double y) {
    constexpr double least = 1e-3;  // of the greatest share so far
    const double core = slice.blend * slice.blend;
    const auto share_at = [core](const Part& part, double squared) {
        const double nearness = core / (core + squared);
        return part.share * part.priority * nearness * nearness;
    };
    double greatest = 0;
    Near sum;
    for (const Part& part : slice.parts) {
        const double dx = x - part.disc.x, dy = y - part.disc.y;
        const double from = std::max(std::sqrt(dx * dx + dy * dy) - part.disc.reach, 0.0);
        if (share_at(part, from * from) < least * greatest) continue;
        const double share = share_at(part, squared_distance(part.outline, x, y));
        greatest = std::max(greatest, share);
        sum.weight += share * part.weight * outward(x, y, part.disc);
        sum.all += share;
    }
    return sum;
}

MaskValue Parts::at(const paper::Cylindrical& place) const {
    if (sound_) return {};
    const double z = std::clamp(place.z, 0.0, step_ * slice_count);
    const auto first = static_cast<std::size_t>(std::max(std::ceil((z - reach_) / step_ - 0.5), 0.0));
    const auto within = [&](std::size_t i) { return (static_cast<double>(i) + 0.5) * step_ < z + reach_; };
    std::size_t last = first;
    bool sound = true;
    for (; last < slice_count && within(last); ++last) sound = sound && slices_[last].sound;
    if (sound) return {};
    const double x = place.rho / radius_ * std::cos(place.beta),
                 y = place.rho / radius_ * std::sin(place.beta);
    Near sum, slope;
    for (std::size_t i = first; i < last; ++i) {
        const double t = (z - (static_cast<double>(i) + 0.5) * step_) / reach_;
        const Near own = near(slices_[i], x, y);
        const double kernel = (1 - t * t) * (1 - t * t), kernel_slope = -4 * t * (1 - t * t) / reach_;
        sum.weight += kernel * own.weight;
        sum.all += kernel * own.all;
        slope.weight += kernel_slope * own.weight;
        slope.all += kernel_slope * own.all;
    }
    if (!(sum.all > 0)) return {};
    const double value = sum.weight / sum.all;
    return {value, (slope.weight - value * slope.all) / sum.all};
}

}  // namespace goffer::fit
