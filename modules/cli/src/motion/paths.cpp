// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "motion/kinds.hpp"
#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

/// Motions along paths.

namespace goffer::cli {
namespace {

Moment laid(const Path& path, const bend::Body& body, double start) {
    Moment moment;
    moment.poses.resize(body.region_count());
    const bend::PathFit fit = path.lay(body, start, moment.poses);
    moment.transform = fit.transform;
    moment.clamped = fit.clamped;
    moment.path_error = static_cast<double>(fit.error);
    return moment;
}

class PathsMotion final : public Motion {
public:
    explicit PathsMotion(KeyedPaths keys) : keys_(std::move(keys)) {}

    double seconds() const noexcept override { return keys_.times.back(); }
    bool repeats() const noexcept override { return keys_.repeats; }

    Moment at(double seconds, const bend::Body& body) const override {
        const KeyPlace place = place_among(keys_.times, within(seconds, keys_.times.back(), keys_.repeats));
        PathWords words = keys_.keys[place.key];
        for (std::size_t i = 0; i < words.points.size(); ++i)
            words.points[i] = interpolated(keys_.interpolation, keys_.times, keys_.repeats, place,
                                           [&](std::size_t key) { return keys_.keys[key].points[i]; });
        return laid(Path(words, keys_.where), body, 0);
    }

private:
    KeyedPaths keys_;
};

class WalkMotion final : public Motion {
public:
    explicit WalkMotion(Walk walk) : walk_(std::move(walk)) {}

    double seconds() const noexcept override { return walk_.seconds; }
    bool repeats() const noexcept override { return walk_.path.closed(); }

    Moment at(double seconds, const bend::Body& body) const override {
        const Path& path = walk_.path;
        const double way = path.closed() ? path.length() : path.length() - body.length();
        if (!(way > 0))
            throw InputError("a body of a length of " + number(body.length()) +
                             " has no room to walk on a path of " + number(path.length()) +
                             "; give a longer path, or scale it");
        double share = seconds / walk_.seconds;
        share = path.closed() ? share - std::floor(share) : std::clamp(share, 0.0, 1.0);
        if (walk_.interpolation == Interpolation::smooth) share *= share * (3 - 2 * share);
        return laid(path, body, share * way);
    }

private:
    Walk walk_;
};

}  // namespace

std::unique_ptr<const Motion> make_motion(KeyedPaths keys) {
    return std::make_unique<PathsMotion>(std::move(keys));
}

std::unique_ptr<const Motion> make_motion(Walk walk) {
    return std::make_unique<WalkMotion>(std::move(walk));
}

}  // namespace goffer::cli
