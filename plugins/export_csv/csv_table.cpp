#include "csv_table.h"

#include "handway/planning/paths/path_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace handway::export_csv {

CsvTable::CsvTable(const std::vector<std::string>& columns)
    : text_(fmt::format("{}\n", fmt::join(columns, ","))) {}

void CsvTable::add_row(double time, const std::vector<double>& values) {
  text_ += fmt::format("{},{}\n", planning::csv_time(time), fmt::join(values, ","));
}

}  // namespace handway::export_csv
