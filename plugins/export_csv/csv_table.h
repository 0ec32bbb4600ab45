#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace handway::export_csv {

/// Text in rows and columns, numbers as the shortest that read back to the same bits.
class CsvTable {
 public:
  explicit CsvTable(const std::vector<std::string>& columns);

  /// @pre as many as columns.
  void add_row(const std::vector<double>& values);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace handway::export_csv
