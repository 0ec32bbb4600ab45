#pragma once

#include "model/planning/recorded_run.h"

#include <QString>

namespace handway::gui {

/// What a line found, in a sentence. @pre index is one of the run's steps.
[[nodiscard]] QString step_text(const RecordedRun& run, std::size_t index);

}  // namespace handway::gui
