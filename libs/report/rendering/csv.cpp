#include "handway/report/rendering/csv.h"

#include "handway/report/document/escaping.h"

namespace handway::report {
namespace {

void add_field(std::string& line, const std::string& text) { line += csv_field(text) + ','; }

void end_line(std::string& line) {
  if (!line.empty() && line.back() == ',') {
    line.back() = '\n';
  }
}

}  // namespace

std::string to_csv(const Table& table) {
  std::string csv;
  for (const Column& column : table.columns) {
    add_field(csv, column.heading());
  }
  end_line(csv);
  for (const std::vector<Cell>& row : table.rows) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      add_field(csv, i < row.size() ? row[i].field() : std::string());
    }
    end_line(csv);
  }
  return csv;
}

}  // namespace handway::report
