// SPDX-License-Identifier: MIT
#pragma once

#if defined(__SSE__) || defined(_M_X64)
#include <xmmintrin.h>
#endif

namespace goffer::simd {

/// Orders streaming stores before whatever is stored next: before other threads are told of them. It waits
/// for them all, so once per piece of work, not once per kernel.
inline void fence() noexcept {
#if defined(__SSE__) || defined(_M_X64)
    _mm_sfence();
#endif
}

}  // namespace goffer::simd
