// SPDX-License-Identifier: MIT
#pragma once

#include "file/format.hpp"
#include "file/holdings.hpp"

#include <goffer/bend/body_file.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace goffer::bend {

/// The first fault of a header as far as it can be told without what follows: `size` is the file's.
[[nodiscard]] BodyFileFault check_start(const FileHeader& header, std::uint64_t size) noexcept;

/// load() of `bytes`, which `holdings` may own: they live as long as the file and its bodies.
[[nodiscard]] std::optional<BodyFile> load_held(std::span<const std::byte> bytes, BodyFileFault* fault,
                                                Verify verify, FileMemory holdings);

}  // namespace goffer::bend
