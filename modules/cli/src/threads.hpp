// SPDX-License-Identifier: MIT
#pragma once

namespace goffer::cli {

/// `asked` threads, at most the machine's; 0 for all of them.
[[nodiscard]] int usable_threads(int asked);

}  // namespace goffer::cli
