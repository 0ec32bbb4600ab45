#pragma once

#include "recordings/parquet_metadata.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Values in the pages of a column of a Parquet file.

namespace handway::device {

/// Numbers of a column, row by row. Every row has the same number of them.
class ParquetRows {
 public:
  /// @param width numbers of a row. @param element file and column for messages.
  ParquetRows(std::size_t width, std::string file, std::string element);

  /// Expects that many further rows. @pre those before are complete.
  void expect(std::size_t rows);
  /// Begins a row. @throws InputError if the one before is incomplete, or none is expected.
  void begin_row();
  /// Adds a number to the row. @throws InputError if it has all.
  void add(double number);
  /// Ends the last row. @throws InputError if it is incomplete, or further rows were expected.
  void end();
  [[nodiscard]] const std::vector<double>& numbers() const { return numbers_; }

 private:
  [[noreturn]] void fail(std::size_t found) const;
  void fill();

  std::size_t width_;
  std::string file_;
  std::string element_;
  std::vector<double> numbers_;
  std::size_t rows_ = 0;
  std::size_t most_rows_ = 0;
  std::size_t in_row_ = 0;
};

/// Decodes the pages of a part of a column and adds their numbers to `rows`; NaN: null. A row that
/// is null, or an empty list, has NaN only.
/// @param pages bytes of all pages of the part.
/// @throws InputError naming file and column if they are damaged, or compressed or encoded in
/// another way than those that are read.
void add_parquet_pages(const ParquetColumn& column, const ParquetChunk& chunk,
                       std::string_view pages, const std::string& file, ParquetRows& rows);

}  // namespace handway::device
