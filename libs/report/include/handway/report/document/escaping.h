#pragma once

#include "handway/report/export.h"

#include <string>
#include <string_view>

/// @file
/// Reports contain text from files. It is shown as text, without control characters; see
/// geometric::printable().
namespace handway::report {

/// Returns `text` with <, >, & and " escaped for HTML and SVG.
[[nodiscard]] HANDWAY_REPORT_EXPORT std::string html_escaped(std::string_view text);

/// Returns `text` in one line that contains neither HTML nor marks of Markdown.
[[nodiscard]] HANDWAY_REPORT_EXPORT std::string markdown_escaped(std::string_view text);

/// Returns `text` as a field of a CSV file for spreadsheets: quoted if needed, and with a ' before
/// text that a spreadsheet would take for a formula.
[[nodiscard]] HANDWAY_REPORT_EXPORT std::string csv_field(const std::string& text);

/// Returns the path of a file beside the report as the target of a link.
[[nodiscard]] HANDWAY_REPORT_EXPORT std::string link_target(std::string_view file);

}  // namespace handway::report
