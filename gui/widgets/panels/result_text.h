#pragma once

#include "handway/planning/core/plan_result.h"
#include "model/planning/optimize_runner.h"
#include "model/planning/path_history.h"

#include <QString>

#include <optional>

namespace handway::gui {

/// Returns a result in words with its key figures, as rich text.
/// @param note plain text that comes first; may be empty. @param figures of its motion, once known.
[[nodiscard]] QString result_text(const planning::PlanResult& result, const QString& note = {},
                                  const std::optional<PathFigures>& figures = std::nullopt);

/// Returns a result in words as plain text, for a tool tip; each figure has a line.
[[nodiscard]] QString result_tip(const planning::PlanResult& result);

/// Returns the text about a path that was replanned for an edited scene. @param source of the path,
/// one word.
[[nodiscard]] QString replanned_text(const planning::PlanResult& result, const QString& source);

/// Returns the figures of a path that is being optimised, as rich text.
[[nodiscard]] QString optimizing_text(const OptimizeProgress& progress);

/// Returns a failure in words, as rich text.
[[nodiscard]] QString failure_text(const QString& message);

}  // namespace handway::gui
