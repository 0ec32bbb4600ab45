#include "csv_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace handway::export_csv {

CsvTable::CsvTable(const std::vector<std::string>& columns)
    : text_(fmt::format("{}\n", fmt::join(columns, ","))) {}

void CsvTable::add_row(const std::vector<double>& values) {
  text_ += fmt::format("{}\n", fmt::join(values, ","));
}

}  // namespace handway::export_csv
