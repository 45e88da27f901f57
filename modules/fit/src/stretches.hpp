// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

/// A center line in stretches, one after the other from base to tip.

namespace goffer::fit {

/// Returns the stretch that holds height z; a joint belongs to the stretch that begins there. `start` of each
/// is the height where it begins.
template <class Stretch>
[[nodiscard]] std::size_t stretch_at(std::span<const Stretch> stretches, double z) {
    std::size_t at = stretches.size() - 1;
    while (at > 0 && z < stretches[at].start) --at;
    return at;
}

/// A place as one stretch sees it.
struct SeenPlace {
    double z;    ///< its height within the stretch; beyond the base and the tip the first and the last go on
    double far;  ///< how far it is from the stretch, squared: a place belongs to the one that is nearest
};

/// `z` and `rho`: what the stretch maps the place to, as if it went on at both ends.
[[nodiscard]] inline SeenPlace seen_from(double z, double rho, double length, bool first, bool last) {
    const double within = std::clamp(z, 0.0, length), beyond = z - within;
    const bool open = (first && beyond < 0) || (last && beyond > 0);
    return {open ? z : within, rho * rho + beyond * beyond};
}

}  // namespace goffer::fit
