// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace goffer::gpu {

/// The text of goffer/gpu/deform.glsl, for programs that compile shaders when they run: to be put after the
/// line with the version. Static storage; a 0 follows it. Thread-safe.
[[nodiscard]] std::string_view deform_glsl() noexcept;

}  // namespace goffer::gpu
