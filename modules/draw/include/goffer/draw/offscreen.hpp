// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/draw/mesh.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <string>

/// OpenGL without a display or a window: a context of EGL, and something to draw into.

namespace goffer::draw {

/// A context without a surface, current in the thread that made it for as long as it lives. One at a time in
/// a thread. Needs EGL with the platform `surfaceless`, which Mesa has, also in software, or `device`, which
/// drivers of graphics cards have on machines without a screen.
class OffscreenContext {
public:
    enum class Api : std::uint8_t {
        core33,  ///< OpenGL 3.3, the core profile
        core43,  ///< OpenGL 4.3, the core profile
        es30,    ///< OpenGL ES 3.0
    };

    /// Where there is no such context the object is false, and *why says what is missing, in one line; else
    /// *why stays as it is.
    OffscreenContext(Api api, std::string& why);
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;
    ~OffscreenContext();

    [[nodiscard]] explicit operator bool() const noexcept { return current_ != nullptr; }

private:
    struct Current;
    std::unique_ptr<Current> current_;
};

/// A frame buffer object of so many pixels, RGBA of 8 bits with a depth of 24, which is bound when it is made
/// and needs the context to be current, its destructor too.
class OffscreenTarget {
public:
    /// Throws Error where OpenGL has none of that size. Both sides are above 0.
    OffscreenTarget(int width, int height);
    OffscreenTarget(const OffscreenTarget&) = delete;
    OffscreenTarget& operator=(const OffscreenTarget&) = delete;
    ~OffscreenTarget();

    /// Waits until all that was drawn is there.
    static void finish();

private:
    std::array<std::uint32_t, 2> buffers_{};  // names: colors, depth
    std::uint32_t frame_ = 0;
};

}  // namespace goffer::draw
