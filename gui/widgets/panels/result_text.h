#pragma once

#include "handway/planning/core/plan_result.h"
#include "model/planning/optimize_runner.h"

#include <QString>

namespace handway::gui {

/// A result in words with its key figures, as rich text.
/// @param note to be said first, plain text; may be empty.
[[nodiscard]] QString result_text(const planning::PlanResult& result, const QString& note = {});

/// How planning ended, in few words: "Path found".
[[nodiscard]] QString status_text(planning::PlanStatus status);

/// The same of a path that was planned again for an edited scene.
/// @param way where it came from, one word.
[[nodiscard]] QString replanned_text(const planning::PlanResult& result, const QString& way);

/// A path that gets better, with its figures, as rich text.
[[nodiscard]] QString optimizing_text(const OptimizeProgress& progress);

/// A result as one line of plain text.
[[nodiscard]] QString result_line(const planning::PlanResult& result);

/// A failure in words, as rich text.
[[nodiscard]] QString failure_text(const QString& message);

}  // namespace handway::gui
