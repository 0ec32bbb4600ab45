#pragma once

#include "handway/planning/queries/palm_ik.h"

#include <QString>

namespace handway::gui {

/// "manipulability 0.084 · reach 78 %"; with "out of reach" in front where the arm is not there.
[[nodiscard]] QString reach_words(const planning::ReachFigures& figures, bool reached = true);
/// Returns the explanation of the two figures, for a tooltip.
[[nodiscard]] QString reach_explanation();

}  // namespace handway::gui
