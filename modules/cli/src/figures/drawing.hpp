// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/pose.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// What it takes to draw a deformed body with OpenGL, without a window.

namespace goffer::cli {

/// The picture that is drawn, in pixels.
inline constexpr int drawn_width = 640, drawn_height = 480;

/// Milliseconds for each of `runs` runs, the mean over `frames` frames: vertices go to OpenGL, a picture is
/// drawn into a frame buffer object, and all of it is waited for. Frame i shows `body` in pose(i), in which
/// it was deformed before. Nothing where there is no OpenGL without a surface. *device: the device, or why
/// there is none.
[[nodiscard]] std::optional<std::vector<double>> drawing_times(
    const bend::Body& body, std::span<const std::uint32_t> triangles,
    const std::function<bend::Pose(std::size_t)>& pose, int runs, int frames, std::string& device);

}  // namespace goffer::cli
