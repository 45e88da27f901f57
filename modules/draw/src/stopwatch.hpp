// SPDX-License-Identifier: MIT
#pragma once

#include "gl.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace goffer::draw {

#ifdef __EMSCRIPTEN__
/// Browsers do not say how long pictures take.
class Stopwatch {
public:
    void start() {}
    void stop() {}
    [[nodiscard]] std::optional<double> milliseconds() const { return std::nullopt; }
};
#else
/// How long pictures take, asked for when the answers have come. Only desktops' OpenGL says so, and that of
/// software renderers tells the time to take in the commands, which is not asked for.
class Stopwatch {
public:
    Stopwatch() {
        const std::string device(reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
        const bool software =
            device.find("llvmpipe") != device.npos || device.find("softpipe") != device.npos;
        if (!is_desktop() || software) return;
        for (Query& query : queries_) query = made<Query>(glGenQueries);
        runs_ = true;
    }
    void start() {
        if (!runs_) return;
        if (started_) stop();  // a picture that did not come to its end
        if (next_ >= queries_.size()) {
            GLuint64 nanoseconds = 0;
            glGetQueryObjectui64v(queries_[next_ % queries_.size()], GL_QUERY_RESULT, &nanoseconds);
            milliseconds_ = 1e-6 * static_cast<double>(nanoseconds);
        }
        glBeginQuery(GL_TIME_ELAPSED, queries_[next_ % queries_.size()]);
        started_ = true;
    }
    void stop() {
        if (!runs_) return;
        glEndQuery(GL_TIME_ELAPSED);
        started_ = false;
        ++next_;
    }
    [[nodiscard]] std::optional<double> milliseconds() const { return milliseconds_; }

private:
    std::array<Query, 3> queries_;
    std::size_t next_ = 0;
    bool runs_ = false, started_ = false;
    std::optional<double> milliseconds_;
};
#endif

}  // namespace goffer::draw
