#pragma once

#include "handway/execution/motion/motion_run.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/timing/time_path.h"
#include "model/planning/optimize_runner.h"

#include <QString>

namespace handway::gui {

/// A result in words with its key figures, as rich text.
/// @param note to be said first, plain text; may be empty.
[[nodiscard]] QString result_text(const planning::PlanResult& result, const QString& note = {});

/// The same of a path that was planned again for an edited scene.
/// @param way where it came from, one word.
[[nodiscard]] QString replanned_text(const planning::PlanResult& result, const QString& way);

/// A path that gets better, with its figures, as rich text.
[[nodiscard]] QString optimizing_text(const OptimizeProgress& progress);

/// A failure in words, as rich text.
[[nodiscard]] QString failure_text(const QString& message);

/// What a motion would be like, or what stands against it, for a person (rich text).
[[nodiscard]] QString motion_text(const planning::TimedPath& motion);

/// What stopped a motion that was not done.
[[nodiscard]] QString cause_of(const execution::MotionOutcome& outcome);

/// How a motion ended, for a person (rich text).
[[nodiscard]] QString outcome_text(const execution::MotionOutcome& outcome);

}  // namespace handway::gui
