#pragma once

#include "handway/execution/motion/motion_run.h"
#include "handway/planning/timing/time_path.h"

#include <QString>

namespace handway::gui {

/// Returns a description of a motion, or of what prevents it (rich text).
[[nodiscard]] QString motion_text(const planning::TimedPath& motion);

/// Returns the cause that stopped a motion before its end.
[[nodiscard]] QString cause_of(const execution::MotionOutcome& outcome);

/// Returns how a motion ended (rich text).
[[nodiscard]] QString outcome_text(const execution::MotionOutcome& outcome);

}  // namespace handway::gui
