#include "recordings/series_table.h"

#include <cmath>
#include <cstddef>

namespace handway::device {

NumberTable table_of(const Series& series) {
  NumberTable table;
  table.warnings = series.warnings;
  table.names = series.names;
  const Eigen::Index columns = series.values.cols();
  table.values.resize(series.values.rows(), columns + (series.times.empty() ? 0 : 1));
  table.values.leftCols(columns) = series.values;
  if (!series.times.empty()) {
    table.values.col(columns) = Eigen::VectorXd::Map(series.times.data(), series.values.rows());
    if (!table.names.empty()) {
      table.names.emplace_back("time");
    }
  }
  table.contents.assign(static_cast<std::size_t>(table.values.cols()),
                        geometric::CellContent::kNumbers);
  table.values =
      table.values.unaryExpr([](double value) { return std::isfinite(value) ? value : kGap; });
  return table;
}

std::vector<ColumnUse> time_columns_of(const Series& series) {
  return series.times.empty() ? std::vector<ColumnUse>{}
                              : std::vector<ColumnUse>{{-1, series.values.cols()}};
}

}  // namespace handway::device
