#pragma once

#include "model/planning/microscope.h"

#include <QString>

#include <cstddef>

namespace handway::gui {

/// Returns the result of a line of the algorithm as a sentence. @pre index is one of the run's
/// steps.
[[nodiscard]] QString step_text(const RecordedRun& run, std::size_t index);

}  // namespace handway::gui
