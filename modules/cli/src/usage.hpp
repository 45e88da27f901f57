// SPDX-License-Identifier: MIT
#pragma once

#include "command_line.hpp"

#include <string>

/// What to say of words that the command line does not take.

namespace goffer::cli {

/// Returns a sentence that names the word at fault, the known word that is nearest to it, and the help to
/// look into. `app` has parsed the words and thrown `error`.
[[nodiscard]] std::string fault_of(const CLI::App& app, const CLI::ParseError& error);

/// Returns a sentence that names an option whose value is another option's name, or is empty, as a variable
/// is that a script has not set; nothing if there is none. `app` has parsed the words.
[[nodiscard]] std::string fault_of_values(const CLI::App& app);

}  // namespace goffer::cli
