#pragma once

#include "handway/report/document/document.h"
#include "handway/report/export.h"

#include <filesystem>
#include <string>

namespace handway::report {

/// Returns a report as one HTML file with its styles and drawings.
/// @param folder of the document's pictures, which become part of the file. Those that can't be
/// read there stay links.
[[nodiscard]] HANDWAY_REPORT_EXPORT std::string to_html(const Document& document,
                                                        const std::filesystem::path& folder = {});

/// Returns the parts of a report without styles and pictures, in the HTML that labels of windows
/// understand.
[[nodiscard]] HANDWAY_REPORT_EXPORT std::string to_rich_text(const Document& document);

}  // namespace handway::report
