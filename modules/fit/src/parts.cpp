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
#include <numbers>
#include <unordered_map>
#include <utility>

namespace goffer::fit {
namespace {

constexpr std::size_t slice_count = 128;
constexpr double most_wobble = 0.15;  // of a part's radius that its center may move by
constexpr double most_depth = 0.45;   // of the radius of a part beside the axis that a wrinkle may be deep
constexpr double spread = 0.4;        // radii along the body that a weight passes into others in

/// A piece of a cross-section's outline.
struct Segment {
    double x, y;  // its middle
    double length;
    std::uint32_t from;  // which crossed edges it joins
    std::uint32_t to;
};

/// The outlines of a mesh at one height.
class CrossSection {
public:
    void add(const std::array<std::uint64_t, 2>& edges, const std::array<double, 4>& ends) {
        segments_.push_back({(ends[0] + ends[2]) / 2, (ends[1] + ends[3]) / 2,
                             std::hypot(ends[2] - ends[0], ends[3] - ends[1]), number(edges[0]),
                             number(edges[1])});
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

/// How much of a displacement away from the axis is away from the center of a part, too: 1 all around a part
/// that the axis runs through, from -1 to 1 about one that lies beside it.
double outward(double x, double y, double center_x, double center_y, double radius) {
    const double rho = std::hypot(x, y), own = std::hypot(x - center_x, y - center_y);
    const double least = 0.25 * radius;  // below it a direction says little
    return rho > 0 ? ((x - center_x) * x + (y - center_y) * y) / (rho * std::max(own, least)) : 1;
}

/// How far the center of an outline moves where the wrinkle of the inner line is 1 deep, in the direction of
/// bending in which that is the most: a column wrinkles as the cosine of half its angle from the inner line.
double response(std::span<const Segment> outline, double length, double axis_radius, double center_x,
                double center_y, double radius) {
    constexpr int directions = 16;
    double most = 0;
    for (int i = 0; i < directions; ++i) {
        const double theta = 2 * std::numbers::pi * i / directions;
        double x = 0, y = 0;
        for (const Segment& s : outline) {
            const double rho = std::hypot(s.x, s.y);
            if (rho == 0) continue;
            const double half = (std::atan2(s.y, s.x) - theta) / 2;
            const double moved = s.length * std::fabs(std::cos(half)) *
                                 paper::depth_weight(rho, axis_radius) *
                                 outward(s.x, s.y, center_x, center_y, radius);
            x += moved * s.x / rho;
            y += moved * s.y / rho;
        }
        most = std::max(most, std::hypot(x, y) / length);
    }
    return most;
}

std::vector<CrossSection> cross_sections(const Geometry& geometry, const Cylinder& cylinder, double step) {
    const Straightening straightening(cylinder);
    std::vector<glm::dvec3> local;
    local.reserve(geometry.positions.size());
    for (const glm::vec3& position : geometry.positions)
        local.push_back(paper::from_cylindrical(straightening.vertex(position)));
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
    : slices_(slice_count), step_(cylinder.length / slice_count), reach_(spread * cylinder.radius + step_) {
    std::vector<CrossSection> sections = cross_sections(geometry, cylinder, step_);
    for (std::size_t slice = 0; slice < slice_count; ++slice) {
        sections[slice].each_outline([&](std::span<const Segment> outline) {
            Part part{0, 0, 0, 0, 1};
            double length = 0;
            for (const Segment& s : outline) {
                part.x += s.length * s.x;
                part.y += s.length * s.y;
                length += s.length;
            }
            if (!(length > 0)) return;
            part.x /= length;
            part.y /= length;
            for (const Segment& s : outline)
                part.radius +=
                    s.length / length * std::hypot(s.x - part.x, s.y - part.y, s.length / std::sqrt(12.0));
            part.radius = std::max(part.radius, 1e-9 * step_);
            part.moved =
                std::max(response(outline, length, cylinder.radius, part.x, part.y, part.radius), 1e-9);
            slices_[slice].push_back(part);
        });
    }
}

void Parts::weigh(const std::function<double(double)>& depth) {
    sound_ = true;
    for (std::size_t slice = 0; slice < slice_count; ++slice) {
        const double deep = depth((static_cast<double>(slice) + 0.5) * step_);
        for (Part& part : slices_[slice]) {
            part.weight = 1;
            if (!(deep > 0)) continue;
            const double beside = glm::smoothstep(0.5, 1.0, std::hypot(part.x, part.y) / part.radius);
            const double bearable = std::min(most_wobble / part.moved, most_depth / beside) * part.radius;
            part.weight = std::min(bearable / deep, 1.0);
            sound_ = sound_ && part.weight == 1 && std::hypot(part.x, part.y) < 0.5 * part.radius;
        }
    }
}

/// Outlines count by how near they are, in their own radii.
Parts::Near Parts::near(const std::vector<Part>& slice, double x, double y) const {
    constexpr double least = 0.01;  // as near as an outline itself
    Near sum;
    for (const Part& part : slice) {
        const double beyond = std::max(std::hypot(x - part.x, y - part.y) / part.radius - 1, 0.0);
        const double root = least + beyond * beyond, share = 1 / (root * root);
        sum.weight += share * part.weight * outward(x, y, part.x, part.y, part.radius);
        sum.all += share;
    }
    return sum;
}

MaskValue Parts::at(const paper::Cylindrical& place) const {
    if (sound_) return {};
    const double x = place.rho * std::cos(place.beta), y = place.rho * std::sin(place.beta);
    const double z = std::clamp(place.z, 0.0, step_ * slice_count);
    const auto first = static_cast<std::size_t>(std::max(std::ceil((z - reach_) / step_ - 0.5), 0.0));
    Near sum, slope;
    for (std::size_t i = first; i < slice_count; ++i) {
        const double t = (z - (static_cast<double>(i) + 0.5) * step_) / reach_;
        if (t <= -1) break;
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
