#pragma once

#include "handway/report/document/cell.h"
#include "handway/report/export.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace handway::report {

/// Column of a table.
struct HANDWAY_REPORT_EXPORT Column {
  // NOLINTBEGIN(google-explicit-constructor): headers are lists of titles.
  Column(const char* name, std::string its_unit = {}) : title(name), unit(std::move(its_unit)) {}
  Column(std::string name, std::string its_unit = {})
      : title(std::move(name)), unit(std::move(its_unit)) {}
  // NOLINTEND(google-explicit-constructor)

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
