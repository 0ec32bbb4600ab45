#pragma once

#include "recordings/file_bytes.h"
#include "recordings/parquet_metadata.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace handway::device {

/// First bytes of a Parquet file.
inline constexpr std::string_view kParquetMark = "PAR1";

/// A table in a Parquet file, of which columns of numbers are read: numbers and truth values, and
/// lists of them with the same number of elements in each row. Read are pages of both versions,
/// UNCOMPRESSED, SNAPPY and ZSTD, with values PLAIN, RLE and in dictionaries.
/// Source: Apache Parquet, parquet-format 2.11.
class ParquetFile {
 public:
  /// @throws InputError if the file can't be opened or its metadata are damaged.
  explicit ParquetFile(const std::filesystem::path& file);

  [[nodiscard]] std::size_t rows() const { return static_cast<std::size_t>(metadata_.rows); }
  [[nodiscard]] const std::vector<ParquetColumn>& columns() const { return metadata_.columns; }
  /// Returns the column of that name; nullptr if there is none.
  [[nodiscard]] const ParquetColumn* find(std::string_view name) const;
  /// Returns the numbers in each row of a column; 0 if rows have different ones.
  [[nodiscard]] std::size_t width(const ParquetColumn& column) const;
  /// Reads rows of a column; NaN: null.
  /// @param width numbers in each row. @pre the file has the rows.
  /// @throws InputError naming file and column if they are damaged, have another number of columns
  /// or are written in a way that is not read.
  [[nodiscard]] Eigen::MatrixXd numbers(const ParquetColumn& column, std::size_t width,
                                        std::size_t first_row, std::size_t row_count) const;

 private:
  [[nodiscard]] std::string read_metadata() const;
  [[nodiscard]] std::string pages_of(const ParquetColumn& column, const ParquetChunk& chunk) const;

  FileBytes bytes_;
  ParquetMetadata metadata_;
};

}  // namespace handway::device
