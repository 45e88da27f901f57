// SPDX-License-Identifier: MIT
#include <goffer/draw/offscreen.hpp>

#include <epoxy/egl.h>

#include <vector>

namespace goffer::draw {

struct OffscreenContext::Current {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    /// Returns what is missing; nothing where the context is current.
    std::string make(Api api);

    Current() = default;
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
    ~Current() { end(); }

private:
    bool make_on(EGLDisplay candidate, Api api);
    void end() {
        if (display == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
        eglTerminate(display);
        display = EGL_NO_DISPLAY;
        context = EGL_NO_CONTEXT;
    }
};

namespace {

bool has(const char* extension) {
    return epoxy_has_egl_extension(EGL_NO_DISPLAY, extension);
}

/// Displays without a window, not initialized: Mesa's, which chooses a device, or none but the processor;
/// then those of devices, as drivers of graphics cards have them on machines without a screen.
std::vector<EGLDisplay> displays() {
    std::vector<EGLDisplay> found;
    if (!has("EGL_EXT_platform_base")) return found;
    if (has("EGL_MESA_platform_surfaceless")) {
        found.push_back(
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    }
    if (has("EGL_EXT_platform_device") && (has("EGL_EXT_device_base") || has("EGL_EXT_device_enumeration"))) {
        EGLDeviceEXT devices[16];
        EGLint count = 0;
        if (eglQueryDevicesEXT(16, &devices[0], &count) == EGL_FALSE) count = 0;
        for (EGLint i = 0; i < count; ++i)
            found.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
    }
    return found;
}

}  // namespace

std::string OffscreenContext::Current::make(Api api) {
    if (!epoxy_has_egl()) return "there is no EGL here";
    const std::vector<EGLDisplay> candidates = displays();
    if (candidates.empty()) return "EGL has neither Mesa's display without a surface nor one of a device";
    for (const EGLDisplay candidate : candidates)
        if (make_on(candidate, api)) return {};
    return "EGL cannot make such a context";
}

bool OffscreenContext::Current::make_on(EGLDisplay candidate, Api api) {
    if (candidate == EGL_NO_DISPLAY || eglInitialize(candidate, nullptr, nullptr) == EGL_FALSE) return false;
    display = candidate;
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
    if (context != EGL_NO_CONTEXT &&
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_FALSE)
        return true;
    end();
    return false;
}

OffscreenContext::OffscreenContext(Api api, std::string& why) : current_(std::make_unique<Current>()) {
    const std::string missing = current_->make(api);
    if (missing.empty()) return;
    why = missing;
    current_.reset();
}

OffscreenContext::~OffscreenContext() = default;

}  // namespace goffer::draw
