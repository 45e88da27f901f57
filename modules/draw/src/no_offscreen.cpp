// SPDX-License-Identifier: MIT
#include <goffer/draw/offscreen.hpp>

namespace goffer::draw {

struct OffscreenContext::Current {};

OffscreenContext::OffscreenContext(Api, std::string& why) {
    why = "this goffer was built without EGL";
}

OffscreenContext::~OffscreenContext() = default;

}  // namespace goffer::draw
