// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <type_traits>

/// The one place where goffer meets a scheduler: a loop over ranges, run by oneTBB in the caller's arena. A
/// build without oneTBB (GOFFER_TBB=OFF) runs it on the calling thread, in one range.

namespace goffer {

/// Calls `body(context, first, last)` for disjoint ranges that cover [0, count), each of `grain` or more
/// elements where there are as many, from the threads of the arena that the caller is in.
///
/// Nested work is isolated: while it waits, the calling thread does not pick up the caller's own tasks.
/// Nothing global is set. Returns when all is done. `body` must not throw. Thread-safe.
void parallel_ranges(std::size_t count, std::size_t grain, void* context,
                     void (*body)(void* context, std::size_t first, std::size_t last));

/// As above, for a callable taking (first, last).
template <class Body>
void parallel_ranges(std::size_t count, std::size_t grain, Body&& body) {
    using Callable = std::remove_reference_t<Body>;
    parallel_ranges(count, grain, const_cast<void*>(static_cast<const void*>(&body)),
                    [](void* context, std::size_t first, std::size_t last) {
                        (*static_cast<Callable*>(context))(first, last);
                    });
}

}  // namespace goffer
