#pragma once

#include "handway/execution/motion/motion_run.h"
#include "handway/planning/timing/time_path.h"

#include <QString>

namespace handway::gui {

/// What a motion would be like, or what stands against it, for a person (rich text).
[[nodiscard]] QString motion_text(const planning::TimedPath& motion);

/// What stopped a motion that was not done.
[[nodiscard]] QString cause_of(const execution::MotionOutcome& outcome);

/// How a motion ended, for a person (rich text).
[[nodiscard]] QString outcome_text(const execution::MotionOutcome& outcome);

}  // namespace handway::gui
