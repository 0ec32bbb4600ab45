#include "recordings/numbered_tables.h"

#include "handway/geometric/io/replace_file.h"

#include <fmt/format.h>

#include <cstddef>
#include <system_error>
#include <utility>

namespace handway::device {

NumberedTables::NumberedTables(std::filesystem::path folder, std::vector<ParquetField> fields)
    : folder_(std::move(folder)), fields_(std::move(fields)), writer_(fields_) {}

NumberedTables::Place NumberedTables::next_place() {
  constexpr std::size_t kFull = static_cast<std::size_t>(kTableFileSize) << 20U;
  if (writer_.size() >= kFull) {
    close();
    writer_ = ParquetWriter(fields_);
    ++place_.file;
    if (place_.file == kFilesOfChunk) {
      place_ = {place_.chunk + 1, 0};
    }
  }
  return place_;
}

void NumberedTables::close() {
  const std::filesystem::path chunk = folder_ / fmt::format("chunk-{:03}", place_.chunk);
  std::error_code ignored;
  std::filesystem::create_directories(chunk, ignored);
  geometric::replace_file(chunk / fmt::format("file-{:03}.parquet", place_.file), writer_.file());
}

}  // namespace handway::device
