// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <type_traits>

/// The one place where the engine, bend, fit and measure meet a scheduler: a loop over ranges, run by oneTBB
/// in the caller's arena. A build without oneTBB (GOFFER_TBB=OFF) runs it on the calling thread, as one
/// range.

namespace goffer {

/// Calls `body(context, first, last)` for disjoint ranges that cover [0, count), from the threads of the
/// arena that the caller is in, and returns when all calls have. A range of more than `grain` elements may be
/// halved for other threads, so no range is shorter than half of `grain`, unless `count` is. A grain of 0
/// counts as 1.
///
/// Nested work is isolated: while the calling thread waits, it picks up no other tasks of the caller. Sets
/// nothing global. `body` must not throw. goffer allocates nothing here, but the scheduler may. Thread-safe.
void parallel_ranges(std::size_t count, std::size_t grain, void* context,
                     void (*body)(void* context, std::size_t first, std::size_t last));

/// The same for a callable that takes (first, last).
template <class Body>
void parallel_ranges(std::size_t count, std::size_t grain, Body&& body) {
    using Callable = std::remove_reference_t<Body>;
    parallel_ranges(count, grain, const_cast<void*>(static_cast<const void*>(&body)),
                    [](void* context, std::size_t first, std::size_t last) {
                        (*static_cast<Callable*>(context))(first, last);
                    });
}

}  // namespace goffer
