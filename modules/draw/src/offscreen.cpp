// SPDX-License-Identifier: MIT
#include <goffer/draw/offscreen.hpp>

#include <epoxy/egl.h>

namespace goffer::draw {

struct OffscreenContext::Current {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    /// Returns what is missing; nothing where the context is current.
    std::string make(Api api);

    Current() = default;
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
    ~Current() {
        if (display == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
        eglTerminate(display);
    }
};

std::string OffscreenContext::Current::make(Api api) {
    if (!epoxy_has_egl()) return "there is no EGL here";
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base") ||
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        return "EGL cannot go without a surface";
    display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE)
        return "EGL has no display without a surface";
    const EGLint core[] = {EGL_CONTEXT_MAJOR_VERSION,
                           api == Api::core43 ? 4 : 3,
                           EGL_CONTEXT_MINOR_VERSION,
                           3,
                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                           EGL_NONE};
    const EGLint embedded[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE};
    const bool es = api == Api::es30;
    eglBindAPI(es ? EGL_OPENGL_ES_API : EGL_OPENGL_API);
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, es ? &embedded[0] : &core[0]);
    if (context == EGL_NO_CONTEXT ||
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE)
        return "EGL makes no such context";
    return {};
}

OffscreenContext::OffscreenContext(Api api, std::string& why) : current_(std::make_unique<Current>()) {
    const std::string missing = current_->make(api);
    if (missing.empty()) return;
    why = missing;
    current_.reset();
}

OffscreenContext::~OffscreenContext() = default;

}  // namespace goffer::draw
