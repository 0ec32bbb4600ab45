#pragma once

#include "handway/planning/core/plan_result.h"

#include <QString>

namespace handway::gui {

/// A result in words with its key figures, as rich text.
[[nodiscard]] QString result_text(const planning::PlanResult& result);

/// A result as one line of plain text.
[[nodiscard]] QString result_line(const planning::PlanResult& result);

/// A failure in words, as rich text.
[[nodiscard]] QString failure_text(const QString& message);

}  // namespace handway::gui
