#pragma once

#include "handway/report/document/cell.h"
#include "handway/report/export.h"

#include <concepts>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace handway::report {

/// Column of a table.
struct HANDWAY_REPORT_EXPORT Column {
  template <std::convertible_to<std::string> Text>
  Column(Text&& title_, std::string unit_ = {})
      : title(std::forward<Text>(title_)), unit(std::move(unit_)) {}

  std::string title;
  std::string unit;  ///< Unit of all its numbers; may be empty.

  /// Returns the title with the unit: "time [s]".
  [[nodiscard]] std::string heading() const;
};

/// A table. A row may have fewer cells than there are columns: the others are empty.
struct HANDWAY_REPORT_EXPORT Table {
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows = {};

  /// Returns whether the column has numbers alone, and is right-aligned therefore.
  [[nodiscard]] bool is_numeric(std::size_t column) const;
};

}  // namespace handway::report
