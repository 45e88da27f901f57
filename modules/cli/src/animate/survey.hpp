// SPDX-License-Identifier: MIT
#pragma once

#include "animate/writers.hpp"

namespace goffer::cli {

/// How pictures are to look at a motion.
struct SurveyView {
    Viewpoint viewpoint;
    view::Settings settings;
};

/// Deforms every frame once, and looks at it. `pictures`: how they will be taken; null where none will. The
/// camera looks as a picture of the frame that bends the most would, and sees all frames from one place.
[[nodiscard]] Survey survey(const MovingModel& frames, const SurveyView* pictures);

}  // namespace goffer::cli
