#pragma once

#include "handway/planning/core/plan_result.h"

#include <QString>

namespace handway::gui {

/// What stood in a planner's way, in words: which bodies touched in most of the samples
/// that it refused, where along the way, and what to try. Plain text; empty if it refused none.
[[nodiscard]] QString rejection_text(const planning::PlanStatistics& statistics);

}  // namespace handway::gui
