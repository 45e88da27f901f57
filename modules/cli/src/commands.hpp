// SPDX-License-Identifier: MIT
#pragma once

#include "arguments.hpp"
#include "command_line.hpp"

/// The subcommands. Each adds itself to `app` and sets `action` when it is the one that was called.

namespace goffer::cli {

void add_bake(CLI::App& app, Action& action);
void add_base(CLI::App& app, Action& action);
void add_inspect(CLI::App& app, Action& action);
void add_refine(CLI::App& app, Action& action);
void add_bend(CLI::App& app, Action& action);
void add_animate(CLI::App& app, Action& action);
void add_cache(CLI::App& app, Action& action);
void add_crowd(CLI::App& app, Action& action);
void add_figures(CLI::App& app, Action& action);
void add_view(CLI::App& app, Action& action);

}  // namespace goffer::cli
