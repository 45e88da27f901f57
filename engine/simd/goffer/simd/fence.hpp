// SPDX-License-Identifier: MIT
#pragma once

#if defined(__SSE__) || defined(_M_X64)
#include <xmmintrin.h>
#endif

namespace goffer::simd {

/// Orders streaming stores before later stores, such as those that tell other threads of the results. It
/// waits for all of them, so call it once per piece of work, not once per kernel.
inline void fence() noexcept {
#if defined(__SSE__) || defined(_M_X64)
    _mm_sfence();
#endif
}

}  // namespace goffer::simd
