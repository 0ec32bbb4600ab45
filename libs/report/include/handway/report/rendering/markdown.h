#pragma once

#include "handway/report/document/document.h"
#include "handway/report/export.h"

#include <string>

namespace handway::report {

/// Returns a report as Markdown. Figures are links to their files.
[[nodiscard]] HANDWAY_REPORT_EXPORT std::string to_markdown(const Document& document);

}  // namespace handway::report
