#pragma once

#include "handway/report/document/document.h"
#include "handway/report/export.h"

#include <cstddef>
#include <string>
#include <vector>

namespace handway::report {

/// Returns a report as plain text for a terminal. Figures are named with their files alone.
[[nodiscard]] HANDWAY_REPORT_EXPORT std::string to_text(const Document& document);

/// Lines of a table in plain text, for rows that become known one after the other.
class HANDWAY_REPORT_EXPORT TextTable {
 public:
  /// Width and alignment of a column.
  struct Layout {
    Column column;
    std::size_t width = 0;  ///< Least width, characters; it is at least that of the heading.
    bool is_numeric = true;
  };

  explicit TextTable(std::vector<Layout> layout);

  /// Returns the line of headings.
  [[nodiscard]] std::string header() const;
  /// Returns the line of a row. Longer cells are not cut.
  [[nodiscard]] std::string row(const std::vector<Cell>& cells) const;

 private:
  [[nodiscard]] std::string line(const std::vector<std::string>& texts) const;

  std::vector<Layout> layout_;
};

}  // namespace handway::report
