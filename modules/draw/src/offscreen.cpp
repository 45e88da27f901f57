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

namespace {

bool has(const char* extension) {
    return epoxy_has_egl_extension(EGL_NO_DISPLAY, extension);
}

/// Returns the display, where there is one that can be used, or none.
EGLDisplay usable(EGLenum platform, void* native) {
    const EGLDisplay display = eglGetPlatformDisplayEXT(platform, native, nullptr);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE)
        return EGL_NO_DISPLAY;
    return display;
}

/// Mesa's, which chooses a device, or none but the processor.
EGLDisplay surfaceless() {
    if (!has("EGL_EXT_platform_base") || !has("EGL_MESA_platform_surfaceless")) return EGL_NO_DISPLAY;
    return usable(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
}

/// That of the first device that has one: what drivers other than Mesa's have on machines without a screen.
EGLDisplay of_a_device() {
    if (!has("EGL_EXT_platform_base") || !has("EGL_EXT_platform_device") ||
        !(has("EGL_EXT_device_base") || has("EGL_EXT_device_enumeration")))
        return EGL_NO_DISPLAY;
    EGLDeviceEXT devices[16];
    EGLint count = 0;
    if (eglQueryDevicesEXT(16, &devices[0], &count) == EGL_FALSE) return EGL_NO_DISPLAY;
    for (EGLint i = 0; i < count; ++i)
        if (const EGLDisplay display = usable(EGL_PLATFORM_DEVICE_EXT, devices[i]); display != EGL_NO_DISPLAY)
            return display;
    return EGL_NO_DISPLAY;
}

}  // namespace

std::string OffscreenContext::Current::make(Api api) {
    if (!epoxy_has_egl()) return "there is no EGL here";
    display = surfaceless();
    if (display == EGL_NO_DISPLAY) display = of_a_device();
    if (display == EGL_NO_DISPLAY) return "EGL has no display without a window, of Mesa or of a device";
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
