// SPDX-License-Identifier: MIT
#include "rest.hpp"
#include "text.hpp"

#include <goffer/bend/region.hpp>
#include <goffer/fit/bind_options.hpp>
#include <goffer/fit/geometry.hpp>

#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace goffer::fit {

BindOptions BindOptions::as_in_paper() {
    BindOptions options;
    options.profile = Profile::damped;
    options.shape = ShapeMode::cylinder;
    options.onset = 0;
    return options;
}

void check(std::span<const RegionOptions> regions) {
    if (regions.size() > bend::max_regions) {
        throw Error("regions: there are " + std::to_string(regions.size()) + " of them; give " +
                    std::to_string(bend::max_regions) + " at most");
    }
    double sum = 0;
    for (const RegionOptions& region : regions) {
        if (!(region.share > 0) || !std::isfinite(region.share)) {
            throw Error("regions: " + text(region.share) +
                        " is not a share of the length; each must be above 0");
        }
        sum += region.share;
    }
    if (std::fabs(sum - 1) > 1e-6) {
        throw Error("regions: their shares add up to " + text(sum) + " of the length; make it 1");
    }
}

std::vector<RegionOptions> regions_of(const BindOptions& options) {
    std::vector<RegionOptions> regions = options.regions;
    if (regions.empty()) regions.emplace_back();
    for (RegionOptions& region : regions) {
        if (!region.folds) region.folds = options.folds;
    }
    return regions;
}

double default_fold_length(Profile profile) {
    return profile.kind == Profile::Kind::even ? 0.5 : 1;
}

}  // namespace goffer::fit
