// SPDX-License-Identifier: MIT
#include "deform_text.hpp"

#include <goffer/gpu/source.hpp>

namespace goffer::gpu {

std::string_view deform_glsl() noexcept {
    return {deform_text, sizeof deform_text - 1};
}

}  // namespace goffer::gpu
