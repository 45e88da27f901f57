// SPDX-License-Identifier: MIT
#include "body/body_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace goffer::bend {
namespace {

/// Takes the drift at an edge from the vertex nearest to it.
void set_drift(Bands& bands, const RestColumns& columns, std::size_t first, std::size_t last,
               float per_height) {
    bands.shaped = true;
    std::array<float, Bands::count + 1> distance;
    distance.fill(std::numeric_limits<float>::max());
    for (std::size_t i = first; i < last; ++i) {
        bands.max_scale = std::max(bands.max_scale, columns.scale[i]);
        const float place = (columns.height[i] - bands.lowest) * per_height;
        for (std::size_t j = 0; j < distance.size(); ++j) {
            const float away = std::fabs(place - static_cast<float>(j));
            if (away < distance[j]) distance[j] = away, bands.drift[j] = columns.drift[i];
        }
    }
    for (std::size_t j = 0; j < Bands::count; ++j)
        bands.max_drift_step = std::max(bands.max_drift_step, std::fabs(bands.drift[j + 1] - bands.drift[j]));
    for (std::size_t i = first; i < last; ++i) {
        const float at = drift_at(bands, (columns.height[i] - bands.lowest) * per_height);
        bands.drift_error = std::max(bands.drift_error, std::fabs(columns.drift[i] - at));
    }
}

}  // namespace

Bands bands_of(const RestColumns& columns, std::size_t first, std::size_t last) noexcept {
    Bands bands;
    bands.rho.fill(-1);
    if (first == last) return bands;
    const auto [lowest, highest] = std::minmax_element(columns.height + first, columns.height + last);
    bands.lowest = *lowest;
    bands.highest = *highest;
    const float per_height = bands_per_height(bands);
    if (columns.scale != nullptr) set_drift(bands, columns, first, last, per_height);
    for (std::size_t i = first; i < last; ++i) {
        const auto band = static_cast<std::size_t>((columns.height[i] - bands.lowest) * per_height);
        const std::size_t place = std::min(band, Bands::count - 1) + 1;
        bands.rho[place] = std::max(bands.rho[place], columns.rho[i]);
        bands.outward[place] = std::max(bands.outward[place], columns.radial_offset[i]);
        bands.inward[place] = std::max(bands.inward[place], -columns.radial_offset[i]);
    }
    return bands;
}

}  // namespace goffer::bend
