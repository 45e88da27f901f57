// SPDX-License-Identifier: MIT
#pragma once

namespace goffer::test {

/// Whether sanitizers watch.
#ifdef GOFFER_SANITIZED
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// Whether the thread sanitizer is among them.
#ifdef GOFFER_THREAD_SANITIZED
inline constexpr bool thread_sanitized = true;
#else
inline constexpr bool thread_sanitized = false;
#endif

}  // namespace goffer::test
