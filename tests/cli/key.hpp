// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

namespace goffer::test {

/// A key of a motion's document, angles in degrees.
inline nlohmann::json key(double time, double angle, double direction = 0) {
    return {{"time", time}, {"angle", angle}, {"direction", direction}};
}

}  // namespace goffer::test
