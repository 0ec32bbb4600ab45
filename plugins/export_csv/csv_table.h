#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace handway::export_csv {

/// Text in rows and columns: times as planning::csv_time(), other numbers as the shortest that read
/// back to the same bits.
class CsvTable {
 public:
  explicit CsvTable(const std::vector<std::string>& columns);

  /// @param time s, the first column. @param values of all others.
  void add_row(double time, const std::vector<double>& values);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace handway::export_csv
