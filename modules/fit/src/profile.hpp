// SPDX-License-Identifier: MIT
#pragma once

#include "text.hpp"

#include <goffer/fit/bind.hpp>

namespace goffer::fit {

/// The most folds of a region: over half of its length, or over all of it where the profile counts so.
inline int max_folds(const Profile& profile) {
    return profile.kind == Profile::Kind::even ? 2 * BindOptions::max_folds : BindOptions::max_folds;
}

/// Throws Error if the roundness is not in 0..0.5.
inline void check(const Profile& profile) {
    if (!(profile.roundness >= 0 && profile.roundness <= 0.5))
        throw Error("roundness: " + text(profile.roundness) + " is outside 0..0.5");
}

}  // namespace goffer::fit
