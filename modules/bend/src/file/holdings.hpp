// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body_file.hpp>
#include <goffer/engine/columns.hpp>

#include <atomic>
#include <cstddef>
#include <vector>

namespace goffer::bend {

/// What the views of a BodyFile refer to, beside bytes that are the caller's.
struct FileHoldings {
    Columns copy;  ///< of the file, or none
    std::vector<std::vector<DrawPart>> parts;
    std::atomic<std::size_t> shares{1};
};

}  // namespace goffer::bend
