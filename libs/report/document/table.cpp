#include "handway/report/document/table.h"

#include <fmt/format.h>

#include <algorithm>

namespace handway::report {

std::string Column::heading() const {
  if (unit.empty()) {
    return title;
  }
  return title.empty() ? fmt::format("[{}]", unit) : fmt::format("{} [{}]", title, unit);
}

bool Table::is_numeric(std::size_t column) const {
  return !rows.empty() && std::ranges::all_of(rows, [column](const std::vector<Cell>& row) {
    return column >= row.size() || row[column].is_number();
  });
}

}  // namespace handway::report
