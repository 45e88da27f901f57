// SPDX-License-Identifier: MIT
#pragma once

namespace goffer::test {

/// Whether sanitizers watch.
#ifdef GOFFER_SANITIZED
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// Whether the thread sanitizer does.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define GOFFER_THREAD_SANITIZED
#endif
#endif
#ifdef GOFFER_THREAD_SANITIZED
inline constexpr bool thread_sanitized = true;
#else
inline constexpr bool thread_sanitized = false;
#endif

}  // namespace goffer::test
