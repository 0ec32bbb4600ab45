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
  std::vector<std::string> columns;  ///< The first is text, the others are set to the right.
  std::vector<std::vector<std::string>> rows;
};

/// A drawing: in HTML as it is, in Markdown as a file of its own.
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
/// A drawing with the styles that reports give it.
[[nodiscard]] std::string to_svg(const ReportFigure& figure);
/// One file with its styles and drawings.
[[nodiscard]] std::string to_html(const ReportDocument& document);

/// Reports hold text from files: it appears as text, see geometric::printable().

/// `text` with <, >, & and " as HTML and SVG want them, and without control characters.
[[nodiscard]] std::string html_escaped(const std::string& text);
/// `text` as a field of a CSV file for spreadsheets: quoted where it has to be, and with a ' before
/// what a spreadsheet would take for a formula.
[[nodiscard]] std::string csv_field(const std::string& text);
/// Columns and rows of a table.
[[nodiscard]] std::string to_csv(const ReportTable& table);

}  // namespace handway::tools
