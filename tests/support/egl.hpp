// SPDX-License-Identifier: MIT
#pragma once

#include <epoxy/egl.h>

#include <string>

namespace goffer::test {

/// OpenGL without a display: a context of EGL, current while it lives. One at a time in a thread.
class EglContext {
public:
    /// ES 3.0 or the core profile of `major`.3. Sets *why where there is none.
    EglContext(bool embedded, int major, std::string& why);
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;
    ~EglContext();

private:
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace goffer::test
