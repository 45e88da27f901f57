// SPDX-License-Identifier: MIT
#pragma once

#include "support/bodies.hpp"

/// What is bound and baked where memory runs out.

namespace goffer::test {

inline TestMesh small_mesh() {
    Random random(5);
    return random_mesh(random, 8, 1, 8, 33, 4);
}

}  // namespace goffer::test
