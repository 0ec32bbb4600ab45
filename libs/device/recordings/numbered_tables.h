#pragma once

#include "recordings/parquet_writer.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace handway::device {

/// A table in files of at most some 100 MB, as LeRobot numbers them: chunk-000/file-000.parquet, up
/// to 1000 files in a chunk.
class NumberedTables {
 public:
  /// Numbers of chunk and file.
  struct Place {
    std::int64_t chunk = 0;
    std::int64_t file = 0;
  };

  NumberedTables(std::filesystem::path folder, std::vector<ParquetField> fields);

  /// Returns the file to which the next rows are added. A full one is written.
  /// @throws OutputError if it can't be written.
  Place next_place();
  /// Adds a group of rows to the file of next_place().
  void add_rows(const std::vector<ParquetCells>& cells) { writer_.add_rows(cells); }
  /// Writes the last file. @throws OutputError if it can't be written.
  void close();

 private:
  std::filesystem::path folder_;
  std::vector<ParquetField> fields_;
  ParquetWriter writer_;
  Place place_;
};

/// Files of a chunk, and size of a file, MB (2^20 bytes).
inline constexpr std::int64_t kFilesOfChunk = 1000;
inline constexpr std::int64_t kTableFileSize = 100;

}  // namespace handway::device
