// SPDX-License-Identifier: MIT
#pragma once

#include "file/holdings.hpp"

#include <goffer/bend/body_file.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace goffer::bend {

/// load() of `bytes`, which `holdings` may own: they live as long as the file and its bodies.
[[nodiscard]] std::optional<BodyFile> load_held(std::span<const std::byte> bytes, BodyFileFault* fault,
                                                Verify verify, FileMemory holdings);

}  // namespace goffer::bend
