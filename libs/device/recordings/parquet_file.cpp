#include "recordings/parquet_file.h"

#include "handway/geometric/io/input_error.h"
#include "recordings/array_file.h"
#include "recordings/parquet_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace handway::device {
namespace {

using geometric::InputError;

constexpr const char* kWhatParquet = "a Parquet file";
constexpr std::uint64_t kLargestMetadata = std::uint64_t{16} << 20;  // bytes
constexpr std::uint64_t kLargestChunk = std::uint64_t{1} << 30;      // bytes

[[noreturn]] void refuse_file(const FileBytes& bytes, const std::string& found,
                              const std::string& advice) {
  throw InputError({bytes.path().string(), "", found, kWhatParquet, advice});
}

}  // namespace

ParquetFile::ParquetFile(const std::filesystem::path& file)
    : bytes_(file, kWhatParquet),
      metadata_(parse_parquet_metadata(read_metadata(), file.string())) {}

// Behind the metadata are their size in four bytes, and the mark.
std::string ParquetFile::read_metadata() const {
  constexpr std::uint64_t kTail = 8;
  const std::string mark = bytes_.read(0, kParquetMark.size());
  if (mark == "PARE") {
    refuse_file(bytes_, "an encrypted file", "Write it without encryption.");
  }
  if (mark != kParquetMark) {
    refuse_file(bytes_, "a file without the mark PAR1 at its beginning", "");
  }
  const std::string tail =
      bytes_.size() < kParquetMark.size() + kTail ? "" : bytes_.read(bytes_.size() - kTail, kTail);
  if (!tail.ends_with(kParquetMark)) {
    refuse_file(bytes_, "a file without the mark PAR1 at its end",
                "The file is cut off: copy it again.");
  }
  std::uint32_t size = 0;
  std::memcpy(&size, tail.data(), sizeof(size));
  if (size > bytes_.size() - kParquetMark.size() - kTail || size > kLargestMetadata) {
    refuse_file(bytes_, fmt::format("metadata of {} bytes", size), "Copy the file again.");
  }
  return bytes_.read(bytes_.size() - kTail - size, size);
}

const ParquetColumn* ParquetFile::find(std::string_view name) const {
  const auto found = std::ranges::find(metadata_.columns, name, &ParquetColumn::name);
  return found == metadata_.columns.end() ? nullptr : &*found;
}

std::size_t ParquetFile::width(const ParquetColumn& column) const {
  if (!column.has_lists()) {
    return 1;
  }
  std::uint64_t values = 0;
  for (const ParquetRowGroup& group : metadata_.groups) {
    values += std::min<std::uint64_t>(group.chunks[column.leaf].values, kMostNumbers);
  }
  return metadata_.rows > 0 && values % metadata_.rows == 0
             ? static_cast<std::size_t>(values / metadata_.rows)
             : 0;
}

Eigen::MatrixXd ParquetFile::numbers(const ParquetColumn& column, std::size_t width,
                                     std::size_t first_row, std::size_t row_count) const {
  const std::string file = bytes_.path().string();
  const std::string element = "column " + column.name;
  if (!column.problem.empty() || width == 0) {
    throw InputError({file, element, width == 0 ? "lists of different lengths" : column.problem,
                      "numbers, or lists of the same length", ""});
  }
  if (row_count > kMostNumbers / width) {
    throw InputError({file, element, fmt::format("{} rows of {} numbers", row_count, width),
                      fmt::format("at most {} numbers", kMostNumbers), "Choose an episode."});
  }
  ParquetRows rows(width, file, element);
  std::size_t begin = 0;    // of the group
  std::size_t skipped = 0;  // rows before those that are read
  for (const ParquetRowGroup& group : metadata_.groups) {
    const std::size_t end = begin + static_cast<std::size_t>(group.rows);
    if (end <= first_row) {
      skipped = end;
    } else if (begin < first_row + row_count) {
      rows.expect(static_cast<std::size_t>(group.rows));
      const ParquetChunk& chunk = group.chunks[column.leaf];
      add_parquet_pages(column, chunk, pages_of(column, chunk), file, rows);
      rows.end();
    }
    begin = end;
  }
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const std::size_t before = (first_row - skipped) * width;
  return Eigen::Map<const RowMajor>(rows.numbers().data() + before,
                                    static_cast<Eigen::Index>(row_count),
                                    static_cast<Eigen::Index>(width));
}

std::string ParquetFile::pages_of(const ParquetColumn& column, const ParquetChunk& chunk) const {
  const bool is_here = bytes_.has(chunk.offset, chunk.size) && chunk.size <= kLargestChunk;
  if (!chunk.problem.empty() || !is_here) {
    throw InputError({bytes_.path().string(), "column " + column.name,
                      chunk.problem.empty() ? "pages beyond the end of the file" : chunk.problem,
                      "pages in this file", "Copy the file again."});
  }
  return bytes_.read(chunk.offset, chunk.size);
}

}  // namespace handway::device
