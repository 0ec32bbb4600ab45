#include "recordings/parquet_writer.h"
#include "recordings/table_bytes.h"

#include <algorithm>

namespace handway::device {

std::string parquet_bytes(const RecordedTable& table) {
  constexpr Eigen::Index kRowsOfGroup = 100'000;
  std::vector<ParquetField> fields{{"time_s", ParquetType::kDouble}};
  for (const std::string& name : table.names) {
    fields.push_back({name, ParquetType::kDouble});
  }
  ParquetWriter writer(fields);
  for (Eigen::Index first = 0; first < table.values.rows(); first += kRowsOfGroup) {
    const Eigen::Index rows = std::min(kRowsOfGroup, table.values.rows() - first);
    std::vector<ParquetCells> cells{Eigen::MatrixXd(table.times.segment(first, rows))};
    for (Eigen::Index column = 0; column < table.values.cols(); ++column) {
      cells.emplace_back(Eigen::MatrixXd(table.values.col(column).segment(first, rows)));
    }
    writer.add_rows(cells);
  }
  return writer.file();
}

}  // namespace handway::device
