// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace goffer::cli {

/// The processor's name, as the system has it; what kind it is where the system has none.
[[nodiscard]] std::string processor_name();

}  // namespace goffer::cli
