#pragma once

#include "handway/report/document/document.h"
#include "handway/report/export.h"

#include <filesystem>

namespace handway::report {

/// Writes the drawings of a document to their files, and the document to `report.md` and
/// `report.html`. Folders of drawings are created if they are missing.
/// @throws geometric::OutputError if a file can't be written.
HANDWAY_REPORT_EXPORT void write_report(const Document& document,
                                        const std::filesystem::path& folder);

/// Writes a figure as SVG. @throws geometric::OutputError if it can't be written.
HANDWAY_REPORT_EXPORT void write_svg(const Figure& figure, const std::filesystem::path& file);

}  // namespace handway::report
