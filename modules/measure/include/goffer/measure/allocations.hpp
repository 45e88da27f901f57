// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

/// Counts allocations: shows that a frame makes none.

namespace goffer::measure {

/// How often this process has called malloc, calloc, realloc, aligned_alloc, memalign, posix_memalign, valloc
/// or pvalloc so far, and thereby operator new: from any thread and any library, the C ones included. Nothing
/// where that is not counted: without glibc, or where a sanitizer or valgrind has put its own functions
/// there. What a library gets from the system past these (mmap) is not counted. Does not allocate.
/// Thread-safe.
///
/// A program counts by calling this: the call links functions into it that stand before glibc's, and pass
/// everything on.
[[nodiscard]] std::optional<std::uint64_t> allocations() noexcept;

}  // namespace goffer::measure
