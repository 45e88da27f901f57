// SPDX-License-Identifier: MIT
#pragma once

#include "figures/figure.hpp"

#include <string>

/// Charts, by gnuplot: a program of its own, which is run without a shell.

namespace goffer::cli {

/// Throws InputError, with how to mend it, where gnuplot cannot be run.
void check_gnuplot();

/// The figure's script as it is left in the folder: run there, it draws NAME.svg from NAME.csv.
[[nodiscard]] std::string chart_script(const Figure& figure);

/// What gnuplot draws by that script: the SVG. Throws InputError where it fails.
[[nodiscard]] std::string drawn_chart(const Figure& figure);

}  // namespace goffer::cli
