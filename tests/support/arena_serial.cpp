// SPDX-License-Identifier: MIT
#include "support/arena.hpp"

namespace goffer::test {

void in_arena(int /*threads*/, const std::function<void()>& work) {
    work();
}

}  // namespace goffer::test
