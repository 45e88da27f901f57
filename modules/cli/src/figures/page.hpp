// SPDX-License-Identifier: MIT
#pragma once

#include "figures/figure.hpp"

#include <span>
#include <string>

namespace goffer::cli {

/// What the page says besides its figures.
struct PageFacts {
    std::string models;  ///< their names, with commas between them
    bool quick = false;
    bool charts = true;
    const Table* machine = nullptr;  ///< of columns "what" and "value"
};

/// The page: HTML of one file without a script, whose links are to files beside it. Its numbers are <data>
/// elements with the values that the CSV files have.
[[nodiscard]] std::string page_text(std::span<const Figure> figures, const PageFacts& facts);

}  // namespace goffer::cli
