#include "recordings/raw_table.h"

#include "handway/device/glove/recording.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace handway::device {
namespace {

/// The unit of a column by its use; empty if it is not known, or named already.
std::string unit_of_column(const TableLayout& layout, Eigen::Index column,
                           const std::string& name) {
  const auto use = std::ranges::find(layout.columns, column, &ColumnUse::column);
  if (use == layout.columns.end() || name.ends_with(']') || name.ends_with(')')) {
    return "";
  }
  if (layout.kind == RecordingKind::kCounts) {
    return "counts";
  }
  constexpr double kTolerance = 1e-9;
  const double gain = std::abs(use->gain);
  const bool in_degrees = std::abs(gain - geometric::kDegree) < kTolerance;
  return in_degrees ? "deg" : std::abs(gain - 1.0) < kTolerance ? "rad" : "";
}

/// Returns whether the sensors have every column of the table as it is, but for times.
bool is_taken_whole(const NumberTable& table, const TableLayout& layout) {
  const bool unchanged = std::ranges::all_of(
      layout.columns, [](const ColumnUse& use) { return use.gain == 1.0 && use.offset == 0.0; });
  return unchanged && table.values.cols() == std::ssize(layout.columns) + std::ssize(layout.times);
}

}  // namespace

RawColumns raw_columns_of_table(const NumberTable& table, const TableLayout& layout) {
  RawColumns raw;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index column = 0; column < table.values.cols(); ++column) {
    if (!table.values.col(column).array().isFinite().any()) {
      continue;  // text, or nothing
    }
    const auto index = static_cast<std::size_t>(column);
    const std::string name = index < table.names.size() && !table.names[index].empty()
                                 ? table.names[index]
                                 : fmt::format("column_{}", column + 1);
    raw.add(name, unit_of_column(layout, column, name));
    kept.push_back(column);
  }
  raw.values = table.values(Eigen::all, kept);
  raw.values = raw.values.unaryExpr([](double value) {
    return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
  });
  return raw;
}

std::optional<RawColumns> raw_columns_of_rows(const NumberTable& table, const TableLayout& layout,
                                              const std::vector<Eigen::Index>& rows) {
  if (table.raw) {
    return rows_of(*table.raw, rows);
  }
  return is_taken_whole(table, layout)
             ? std::nullopt
             : std::optional(rows_of(raw_columns_of_table(table, layout), rows));
}

}  // namespace handway::device
