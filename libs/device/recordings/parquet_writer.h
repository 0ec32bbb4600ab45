#pragma once

#include "recordings/parquet_metadata.h"
#include "recordings/thrift_writer.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace handway::device {

/// A column to write.
struct ParquetField {
  std::string name;
  ParquetType type = ParquetType::kDouble;  ///< kInt64, kFloat, kDouble or kByteArray for texts.
  bool has_lists = false;                   ///< Each row has a list of values.
};

/// Values of a column in some rows: numbers, shape [rows, width of a list], or one text for each
/// row.
using ParquetCells = std::variant<Eigen::MatrixXd, std::vector<std::string>>;

/// Keys and values in the metadata of a file.
using ParquetNotes = std::vector<std::pair<std::string, std::string>>;

/// Writes a table as a Parquet file. All columns are optional, as other writers make them, and no
/// value is null. Pages are of version 1, uncompressed, with values PLAIN; lists have the three
/// levels of the specification.
/// Source: Apache Parquet, parquet-format 2.11.
class ParquetWriter {
 public:
  explicit ParquetWriter(std::vector<ParquetField> fields);

  /// Adds a group of rows, with a page for each column.
  /// @param cells one for each column. Numbers of integer columns are whole.
  /// @throws std::invalid_argument if they have other types or different numbers of rows, or lists
  /// are empty.
  void add_rows(const std::vector<ParquetCells>& cells);

  [[nodiscard]] std::int64_t rows() const { return rows_; }
  /// Returns the size of the pages so far, bytes.
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  /// Returns the whole file.
  [[nodiscard]] std::string file(const ParquetNotes& notes = {}) const;

 private:
  [[nodiscard]] ThriftWriter add_chunk(const ParquetField& field, const ParquetCells& cells,
                                       std::size_t rows);

  std::vector<ParquetField> fields_;
  std::string bytes_;
  std::vector<ThriftWriter> groups_;
  std::int64_t rows_ = 0;
};

}  // namespace handway::device
