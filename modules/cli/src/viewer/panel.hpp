// SPDX-License-Identifier: MIT
#pragma once

#include "stage/controls.hpp"
#include "stage/stage.hpp"

#include <optional>
#include <string>

/// The viewer's panel: Dear ImGui's widgets for Controls, and what there is to be told.

namespace goffer::cli {

/// What the panel shows, besides the controls.
struct Told {
    FrameTimes times;
    std::optional<double> draw;  ///< milliseconds of the GPU
    double frame = 0;            ///< milliseconds from picture to picture
    bool moving = false;         ///< pictures follow one another
    bool busy = false;           ///< binding
    std::string device;
    std::string message;  ///< of what was done last
    bool failed = false;  ///< the message is of an error
};

/// What was done in the panel.
struct Done {
    bool bind = false;   ///< words have changed: bind again
    bool crowd = false;  ///< the number of instances has changed
    bool open = false;   ///< Controls::path
    bool save_model = false, save_body = false, save_picture = false, copy = false, look = false;
};

/// Shows the panel along the left edge, `width` wide, and changes `controls` as people do.
[[nodiscard]] Done show_panel(Controls& controls, const Stage& stage, const Told& told, float width);

}  // namespace goffer::cli
