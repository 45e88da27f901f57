// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace goffer::cli {

/// Bytes that a program can still use without pushing others out, or nothing where the system does not say
/// (it does on Linux). Asking for more often succeeds, and using it ends the program.
[[nodiscard]] std::optional<std::uint64_t> free_memory();

}  // namespace goffer::cli
