// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace goffer::test {

/// How often this process has asked for a lock so far, from any thread and any library: pthread's mutexes
/// (and so std::mutex), read-write locks, spin locks and conditions, and semaphores. Nothing where that is
/// not counted: without glibc, or under a sanitizer.
[[nodiscard]] std::optional<std::uint64_t> locks() noexcept;

}  // namespace goffer::test
