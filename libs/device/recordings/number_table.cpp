#include "recordings/number_table.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/table_text.h"
#include "recordings/recorded_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

namespace handway::device {
namespace {

using geometric::CellContent;

bool is_header(const std::vector<std::string_view>& parts) {
  return std::ranges::none_of(parts,
                              [](std::string_view part) { return parse_cell(part).has_value(); });
}

bool is_remark(const TextLine& line) {
  const std::string_view text = trimmed(line.text);
  return text.empty() || text.starts_with('#') || text.starts_with('%');
}

/// The cells of a line with that number of cells (0: any), without an empty one behind the last
/// separator.
std::vector<std::string_view> cells_of(const TextLine& line, char separator, std::size_t columns) {
  std::vector<std::string_view> parts = cells(line.text, separator);
  if (parts.size() == columns + 1 && columns > 0 && parts.back().empty()) {
    parts.pop_back();
  }
  return parts;
}

/// Returns whether a line is words of less than half as many cells as the one below it.
bool is_title(const TextLine& line, const TextLine& below, char separator) {
  const auto filled = [separator](const TextLine& of) {
    return std::ranges::count_if(cells(of.text, separator),
                                 [](std::string_view cell) { return !cell.empty(); });
  };
  return is_header(cells(line.text, separator)) && 2 * filled(line) < filled(below);
}

double number_or_mark(std::string_view cell) {
  if (const std::optional<double> number = parse_cell(cell)) {
    return *number;
  }
  if (const auto time = geometric::parse_time(cell)) {
    return time->seconds;
  }
  constexpr std::array<std::string_view, 10> kGaps{"",  "nan", "na",   "n/a",  "null",
                                                   "-", "inf", "+inf", "-inf", "none"};
  std::string small(cell);
  std::ranges::transform(small, small.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::ranges::find(kGaps, small) == kGaps.end() ? kWord : kGap;
}

}  // namespace

bool NumberTable::is_spelled(Eigen::Index column) const {
  const auto c = static_cast<std::size_t>(column);
  return c < contents.size() && contents[c] != CellContent::kOther &&
         contents[c] != CellContent::kNumbers;
}

NumberTable read_text_table(const std::filesystem::path& file, std::span<const TextLine> all,
                            int skip, std::optional<char> separator) {
  std::vector<TextLine> lines;
  for (const TextLine& line : all) {
    if (line.number > static_cast<std::size_t>(skip) && !is_remark(line)) {
      lines.push_back(line);
    }
  }
  if (!separator && !lines.empty()) {
    separator = separator_of(lines[lines.size() > 1 ? lines.size() - 2 : 0].text);
  }
  // Titles above the table are not part of it.
  while (lines.size() > 2 && is_title(lines[0], lines[1], *separator)) {
    lines.erase(lines.begin());
  }
  NumberTable table;
  std::vector<std::vector<double>> rows;
  std::size_t columns = 0;
  for (const TextLine& line : lines) {
    const std::vector<std::string_view> parts = cells_of(line, *separator, columns);
    if (columns == 0) {
      columns = parts.size();
      if (is_header(parts)) {
        table.names = geometric::cell_names(line.text, *separator);
        table.names.resize(columns);
        continue;
      }
    }
    if (rows.empty() && geometric::append_units(table.names, parts)) {
      continue;
    }
    if (parts.size() < columns && !line.ended) {
      table.warnings.push_back(at_line(file, line) + ": left out, the row is cut off");
      continue;
    }
    if (parts.size() != columns) {
      throw geometric::InputError({at_line(file, line), "", fmt::format("{} cells", parts.size()),
                                   fmt::format("{} as in the first row", columns), ""});
    }
    std::vector<double>& row = rows.emplace_back();
    table.contents.resize(columns, CellContent::kOther);
    for (std::size_t c = 0; c < columns; ++c) {
      row.push_back(number_or_mark(parts[c]));
      if (table.contents[c] == CellContent::kOther && std::isfinite(row.back())) {
        table.contents[c] = geometric::content_of(parts[c]);
      }
    }
    table.lines.push_back(line.number);
  }
  if (rows.empty()) {
    throw geometric::InputError({file.string(), "", "no rows", "at least one", ""});
  }
  table.values.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns));
  for (std::size_t row = 0; row < rows.size(); ++row) {
    table.values.row(static_cast<Eigen::Index>(row)) =
        Eigen::Map<const Eigen::RowVectorXd>(rows[row].data(), table.values.cols());
  }
  return table;
}

}  // namespace handway::device
