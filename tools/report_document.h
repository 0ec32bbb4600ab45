#pragma once

#include <string>
#include <variant>
#include <vector>

/// A report as one document, written as Markdown and as HTML.
namespace handway::tools {

struct ReportHeading {
  int level = 2;  ///< 1: the title.
  std::string text;
};

struct ReportText {
  std::string text;  ///< A paragraph, plain.
};

struct ReportTable {
  std::vector<std::string> columns;  ///< The first is text, the others are right-aligned.
  std::vector<std::vector<std::string>> rows;
};

/// A drawing: inline in HTML, in Markdown as a file of its own.
struct ReportFigure {
  std::string caption;
  std::string svg;
  std::string data_file;  ///< Beside the report.
  std::string file;       ///< File of the drawing, beside the report.
};

/// A picture in a file of its own.
struct ReportPicture {
  std::string caption;
  std::string file;  ///< Beside the report.
};

using ReportPart =
    std::variant<ReportHeading, ReportText, ReportTable, ReportFigure, ReportPicture>;
using ReportDocument = std::vector<ReportPart>;

[[nodiscard]] std::string to_markdown(const ReportDocument& document);
/// Returns a drawing with the styles of reports.
[[nodiscard]] std::string to_svg(const ReportFigure& figure);
/// Returns one file with its styles and drawings.
[[nodiscard]] std::string to_html(const ReportDocument& document);

/// Reports contain text from files: it is shown as text, see geometric::printable().

/// Returns `text` with <, >, & and " escaped for HTML and SVG, and without control characters.
[[nodiscard]] std::string html_escaped(const std::string& text);
/// Returns `text` as a field of a CSV file for spreadsheets: quoted if needed, and with a ' before
/// text that a spreadsheet would take for a formula.
[[nodiscard]] std::string csv_field(const std::string& text);
/// Columns and rows of a table.
[[nodiscard]] std::string to_csv(const ReportTable& table);

}  // namespace handway::tools
