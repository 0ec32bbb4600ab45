#pragma once

#include "handway/report/document/figure.h"
#include "handway/report/export.h"

#include <string>

namespace handway::report {

/// Returns a figure as an SVG file: dark text on white. A plot without data has its axes and the
/// words "no data". Names that are too long for their place are cut; the whole name is their tip.
[[nodiscard]] HANDWAY_REPORT_EXPORT std::string to_svg(const Figure& figure);

}  // namespace handway::report
