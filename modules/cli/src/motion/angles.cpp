// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "motion/kinds.hpp"
#include "poses.hpp"

#include <goffer/bend/region.hpp>

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

/// Motions whose poses are said: keys and swings.

namespace goffer::cli {
namespace {

class AnglesMotion final : public Motion {
public:
    explicit AnglesMotion(KeyedAngles keys) : keys_(std::move(keys)) {
        const std::size_t regions = keys_.keys.front().directions.size();
        for (std::size_t r = 0; r < regions; ++r) flat_.push_back(is_flat(r));
    }

    double seconds() const noexcept override { return keys_.times.back(); }
    bool repeats() const noexcept override { return keys_.repeats; }

    Moment at(double seconds, const bend::Body& body) const override {
        const KeyPlace place = place_among(keys_.times, within(seconds, keys_.times.back(), keys_.repeats));
        RegionAngles angles = on_body(keys_.keys[place.key], body);
        if (place.share != 0) move_on(angles, place, body);
        return {.poses = poses_for(body, angles, keys_.from_rest)};
    }

private:
    double angle(std::size_t key, std::size_t region) const {
        const std::vector<double>& angles = keys_.keys[key].angles;
        return angles[angles.size() == 1 ? 0 : region];
    }

    /// Whether a region bends to one direction and against it alone.
    bool is_flat(std::size_t region) const {
        std::optional<std::size_t> first;
        for (std::size_t key = 0; key < keys_.keys.size(); ++key) {
            if (angle(key, region) == 0) continue;
            if (!first) first = key;
            if (keys_.keys[key].directions[region] != keys_.keys[*first].directions[region]) return false;
        }
        return true;
    }

    /// The direction of a region that bends in one plane.
    std::optional<double> plane(std::size_t region) const {
        for (std::size_t key = 0; key < keys_.keys.size(); ++key) {
            if (angle(key, region) != 0) return keys_.keys[key].directions[region];
        }
        return keys_.keys.front().directions[region];
    }

    template <class ValueOf>
    auto between(const KeyPlace& place, ValueOf value) const {
        return interpolated(keys_.interpolation, keys_.times, keys_.repeats, place, value);
    }

    /// From the angles of a key to those of `place` behind it. In one plane it is the angle that moves, with
    /// its sign; else the vector (angle cos direction, angle sin direction), which goes the short way, and
    /// for which 0 degrees is a place like all others.
    void move_on(RegionAngles& angles, const KeyPlace& place, const bend::Body& body) const {
        for (std::size_t r = 0; r < angles.angles.size(); ++r) {
            const std::size_t own = flat_.size() == 1 ? 0 : r;  // one is said for all regions of a chain
            const auto value = [&](std::size_t key) { return angle_of(keys_.keys[key], body, r); };
            if (flat_[own]) {
                angles.angles[r] = between(place, value);
                angles.directions[r] = plane(own);
                continue;
            }
            const glm::dvec2 vector = between(place, [&](std::size_t key) {
                const std::optional<double>& said = keys_.keys[key].directions[own];
                const double direction = radians(said.value_or(rest_direction(body)));
                return value(key) * glm::dvec2(std::cos(direction), std::sin(direction));
            });
            angles.angles[r] = std::hypot(vector.x, vector.y);
            angles.directions[r] = degrees(std::atan2(vector.y, vector.x));
        }
    }

    KeyedAngles keys_;
    std::vector<bool> flat_;  // by region
};

class SwingMotion final : public Motion {
public:
    explicit SwingMotion(Swing swing) : swing_(std::move(swing)) {}

    double seconds() const noexcept override { return swing_.seconds; }
    bool repeats() const noexcept override { return true; }

    Moment at(double seconds, const bend::Body& body) const override {
        RegionAngles angles = on_body(swing_.from, body);
        const RegionAngles to = on_body(swing_.to, body);
        const double time = within(seconds, swing_.seconds, true) / swing_.seconds;
        double start = 0;
        for (std::size_t r = 0; r < angles.angles.size(); ++r) {
            const double phase = 2 * std::numbers::pi * (time - swing_.lag * start / body.length());
            angles.angles[r] += (to.angles[r] - angles.angles[r]) * (0.5 - 0.5 * std::cos(phase));
            start += body.region_inputs()[r].length;
        }
        return {.poses = poses_for(body, angles, swing_.from_rest)};
    }

private:
    Swing swing_;
};

}  // namespace

double angle_of(const RegionAngles& said, const bend::Body& body, std::size_t region) {
    const bool shared = said.angles.size() != body.region_count();
    const double angle = shared ? said.angles.front() * share_of(body, region) : said.angles[region];
    if (!std::isinf(angle)) return angle;
    return std::copysign(degrees(static_cast<double>(body.max_angle(region))), angle);
}

RegionAngles on_body(const RegionAngles& said, const bend::Body& body) {
    RegionAngles own{{}, said.directions};
    if (own.directions.size() == 1) own.directions.resize(body.region_count(), said.directions.front());
    own.angles.reserve(body.region_count());
    for (std::size_t r = 0; r < body.region_count(); ++r) own.angles.push_back(angle_of(said, body, r));
    return own;
}

std::vector<bend::Pose> poses_for(const bend::Body& body, const RegionAngles& angles, bool from_rest) {
    PoseRequest request;
    request.angles = angles.angles;
    request.directions = angles.directions;
    request.from_rest = from_rest;
    return poses_of(targets_on(body, request));
}

std::unique_ptr<const Motion> make_motion(KeyedAngles keys) {
    return std::make_unique<AnglesMotion>(std::move(keys));
}

std::unique_ptr<const Motion> make_motion(Swing swing) {
    return std::make_unique<SwingMotion>(std::move(swing));
}

}  // namespace goffer::cli
