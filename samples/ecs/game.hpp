// SPDX-License-Identifier: MIT
#pragma once

#include "components.hpp"

namespace ecs {

/// Plays the game in `world` without a window, as the words of the command line ask for, and returns the exit
/// code. Prints what frames took and a hash of all hats and of the vertices of the last frame, which is the
/// same for every world and number of threads.
int play(World& world, int argc, char** argv);

}  // namespace ecs
