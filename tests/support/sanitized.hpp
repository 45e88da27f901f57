// SPDX-License-Identifier: MIT
#pragma once

namespace goffer::test {

/// Whether sanitizers watch.
#ifdef GOFFER_SANITIZED
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace goffer::test
