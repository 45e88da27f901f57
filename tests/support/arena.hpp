// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace goffer::test {

/// Calls `work` in an oneTBB arena of `threads` threads; in a build without oneTBB, as it is.
void in_arena(int threads, const std::function<void()>& work);

}  // namespace goffer::test
