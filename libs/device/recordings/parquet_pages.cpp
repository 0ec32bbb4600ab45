#include "recordings/parquet_pages.h"

#include "handway/geometric/io/input_error.h"
#include "recordings/array_file.h"
#include "recordings/decompression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace handway::device {
namespace {

using geometric::InputError;

constexpr double kNullValue = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kLargestPage = std::size_t{64} << 20;  // bytes; usual ones have 1 MB
constexpr std::int64_t kPlain = 0;
constexpr std::int64_t kPlainDictionary = 2;
constexpr std::int64_t kRle = 3;
constexpr std::int64_t kRleDictionary = 8;

/// Thrown for a page that is damaged.
class PageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

template <typename Number>
Number little_endian(std::string_view bytes) {
  static_assert(std::endian::native == std::endian::little);
  Number number{};
  std::memcpy(&number, bytes.data(), sizeof(Number));
  return number;
}

/// Takes bytes from the front. @throws PageError if there are fewer.
std::string_view take_front(std::string_view& bytes, std::size_t size) {
  if (size > bytes.size()) {
    throw PageError{"a page that ends early"};
  }
  const std::string_view taken = bytes.substr(0, size);
  bytes.remove_prefix(size);
  return taken;
}

/// Reads small integers in runs: repeated, or packed in bits ("RLE/bit-packing hybrid").
class RunReader {
 public:
  RunReader(std::string_view bytes, unsigned width) : bytes_(bytes), width_(width) {
    constexpr unsigned kWidest = 32;
    if (width > kWidest) {
      throw PageError{fmt::format("integers of {} bits", width)};
    }
  }

  /// @throws PageError at the end.
  std::uint32_t next() {
    if (width_ == 0) {
      return 0;
    }
    while (rest_ == 0) {
      begin_run();
    }
    --rest_;
    return is_packed_ ? next_packed() : repeated_;
  }

 private:
  static constexpr unsigned kBitsOfByte = 8;

  void begin_run() {
    const std::uint64_t head = varint();
    is_packed_ = (head & 1U) != 0;
    rest_ = head >> 1U;
    if (is_packed_) {
      // The last run may lack the bytes behind its last integer.
      const std::uint64_t most = std::uint64_t{bytes_.size()} * kBitsOfByte / width_;
      rest_ = std::min(rest_, most / kBitsOfByte + 1) * kBitsOfByte;
      const std::uint64_t size =
          std::min<std::uint64_t>((rest_ * width_ + kBitsOfByte - 1) / kBitsOfByte, bytes_.size());
      rest_ = std::min(rest_, most);
      packed_ = take_front(bytes_, static_cast<std::size_t>(size));
      bit_ = 0;
    } else {
      repeated_ = 0;
      unsigned shift = 0;
      for (const char byte : take_front(bytes_, (width_ + kBitsOfByte - 1) / kBitsOfByte)) {
        repeated_ |= static_cast<std::uint32_t>(static_cast<unsigned char>(byte)) << shift;
        shift += kBitsOfByte;
      }
    }
  }

  std::uint32_t next_packed() {
    std::uint32_t value = 0;
    for (unsigned got = 0; got < width_;) {
      const auto byte = static_cast<unsigned char>(packed_[bit_ / kBitsOfByte]);
      const auto skipped = static_cast<unsigned>(bit_ % kBitsOfByte);
      const unsigned bits = std::min(kBitsOfByte - skipped, width_ - got);
      const std::uint32_t part =
          (static_cast<std::uint32_t>(byte) >> skipped) & ((1U << bits) - 1U);
      value |= part << got;
      got += bits;
      bit_ += bits;
    }
    return value;
  }

  std::uint64_t varint() {
    constexpr unsigned kMostBits = 35;  // five bytes
    std::uint64_t number = 0;
    for (unsigned shift = 0; shift < kMostBits; shift += 7) {
      const auto byte = static_cast<unsigned char>(take_front(bytes_, 1).front());
      number |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
      if ((byte & 0x80U) == 0) {
        return number;
      }
    }
    throw PageError{"a run of more than 32 bits"};
  }

  std::string_view bytes_;
  unsigned width_;
  std::uint64_t rest_ = 0;
  bool is_packed_ = false;
  std::uint32_t repeated_ = 0;
  std::string_view packed_;
  std::size_t bit_ = 0;
};

/// Returns the values of a page one after the other, without nulls. It throws PageError at the end.
using ValueReader = std::function<double()>;

template <typename Number>
ValueReader plain_numbers(std::string_view bytes) {
  return [bytes]() mutable {
    return static_cast<double>(little_endian<Number>(take_front(bytes, sizeof(Number))));
  };
}

ValueReader plain_truths(std::string_view bytes) {
  return [bytes, bit = 0U]() mutable {
    constexpr unsigned kBits = 8;
    if (bytes.empty()) {
      throw PageError{"a page that ends early"};
    }
    const unsigned value = (static_cast<unsigned char>(bytes.front()) >> bit) & 1U;
    bit = (bit + 1) % kBits;
    bytes.remove_prefix(bit == 0 ? 1 : 0);
    return static_cast<double>(value);
  };
}

ValueReader plain_values(const ParquetColumn& column, std::string_view bytes) {
  switch (column.type) {
    case ParquetType::kBoolean:
      return plain_truths(bytes);
    case ParquetType::kInt32:
      return column.is_unsigned ? plain_numbers<std::uint32_t>(bytes)
                                : plain_numbers<std::int32_t>(bytes);
    case ParquetType::kInt64:
      return column.is_unsigned ? plain_numbers<std::uint64_t>(bytes)
                                : plain_numbers<std::int64_t>(bytes);
    case ParquetType::kFloat:
      return plain_numbers<float>(bytes);
    default:
      return plain_numbers<double>(bytes);
  }
}

/// Bytes whose number precedes them in four bytes.
std::string_view take_sized(std::string_view& bytes) {
  return take_front(bytes, little_endian<std::uint32_t>(take_front(bytes, sizeof(std::uint32_t))));
}

std::string encoding_name(std::int64_t encoding) {
  constexpr std::array<const char*, 10> kNames{
      "PLAIN",          "GROUP_VAR_INT",       "PLAIN_DICTIONARY",        "RLE",
      "BIT_PACKED",     "DELTA_BINARY_PACKED", "DELTA_LENGTH_BYTE_ARRAY", "DELTA_BYTE_ARRAY",
      "RLE_DICTIONARY", "BYTE_STREAM_SPLIT"};
  return encoding >= 0 && encoding < std::ssize(kNames)
             ? kNames.at(static_cast<std::size_t>(encoding))
             : fmt::format("of number {}", encoding);
}

std::string codec_name(std::int64_t codec) {
  constexpr std::array<const char*, 8> kNames{"UNCOMPRESSED", "SNAPPY", "GZIP", "LZO",
                                              "BROTLI",       "LZ4",    "ZSTD", "LZ4_RAW"};
  return codec >= 0 && codec < std::ssize(kNames) ? kNames.at(static_cast<std::size_t>(codec))
                                                  : fmt::format("of number {}", codec);
}

/// Levels and values of a data page.
struct PageContent {
  RunReader repetitions;
  RunReader definitions;
  std::string_view values;
};

/// Decodes pages one after the other.
class PageReader {
 public:
  PageReader(const ParquetColumn& column, const ParquetChunk& chunk, const std::string& file,
             ParquetRows& rows)
      : column_(column), chunk_(chunk), file_(file), rows_(rows) {}

  void read(std::string_view pages) {
    std::uint64_t values = 0;
    while (values < chunk_.values) {
      const ParquetPageHeader page = parse_parquet_page(pages, file_);
      take_front(pages, page.header_size);
      const std::string_view stored = take_front(pages, page.compressed_size);
      if (page.kind == ParquetPageKind::kDictionary) {
        read_dictionary(page, stored);
      } else if (page.kind != ParquetPageKind::kIndex) {
        if (page.values > chunk_.values - values) {
          throw PageError{"pages with more values than the metadata name"};
        }
        values += page.values;
        read_data(page, stored);
      }
    }
  }

 private:
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw InputError({file_, "column " + column_.name, found, expected,
                      "Write it again by pandas: to_parquet(FILE, compression=\"snappy\")."});
  }

  std::string decompressed(std::string_view stored, std::size_t size) const {
    constexpr std::int64_t kUncompressed = 0;
    constexpr std::int64_t kSnappy = 1;
    constexpr std::int64_t kZstd = 6;
    if (size > kLargestPage) {
      throw PageError{fmt::format("a page of {} bytes, which are more than can be read", size)};
    }
    std::optional<std::string> bytes;
    switch (chunk_.codec) {
      case kUncompressed:
        bytes = std::string(stored);
        break;
      case kSnappy:
        bytes = snappy_decompressed(stored, size);
        break;
      case kZstd:
        bytes = zstd_decompressed(stored, size);
        break;
      default:
        refuse(fmt::format("pages compressed by {}", codec_name(chunk_.codec)),
               "UNCOMPRESSED, SNAPPY or ZSTD");
    }
    if (!bytes || bytes->size() != size) {
      throw PageError{"a damaged page"};
    }
    return *std::move(bytes);
  }

  void read_dictionary(const ParquetPageHeader& page, std::string_view stored) {
    if (page.encoding != kPlain && page.encoding != kPlainDictionary) {
      refuse(fmt::format("a dictionary encoded as {}", encoding_name(page.encoding)), "PLAIN");
    }
    const std::string bytes = decompressed(stored, page.size);
    const ValueReader next = plain_values(column_, bytes);
    dictionary_.clear();
    for (std::size_t i = 0; i < page.values; ++i) {
      dictionary_.push_back(next());
    }
  }

  void read_data(const ParquetPageHeader& page, std::string_view stored) {
    const bool is_second = page.kind == ParquetPageKind::kData2;
    std::string_view levels;
    if (is_second) {
      // Levels are before the values and never compressed.
      levels = take_front(stored, page.repetition_size + page.definition_size);
    }
    if (page.size < levels.size()) {
      throw PageError{"a damaged page"};
    }
    const std::size_t size = page.size - levels.size();
    const std::string bytes = is_second && (!page.is_compressed || size == 0)
                                  ? std::string(stored)
                                  : decompressed(stored, size);
    add_values(page, is_second ? second_content(page, levels, bytes) : first_content(page, bytes));
  }

  PageContent second_content(const ParquetPageHeader& page, std::string_view levels,
                             std::string_view values) const {
    return {RunReader(levels.substr(0, page.repetition_size), width_of(column_.most_repetition)),
            RunReader(levels.substr(page.repetition_size), width_of(column_.most_definition)),
            values};
  }

  PageContent first_content(const ParquetPageHeader& page, std::string_view bytes) const {
    const auto take_levels = [&](unsigned most, std::int64_t encoding) {
      if (most > 0 && encoding != kRle) {
        refuse(fmt::format("levels encoded as {}", encoding_name(encoding)), "RLE");
      }
      return RunReader(most > 0 ? take_sized(bytes) : std::string_view(), width_of(most));
    };
    RunReader repetitions = take_levels(column_.most_repetition, page.repetition_encoding);
    RunReader definitions = take_levels(column_.most_definition, page.definition_encoding);
    return {repetitions, definitions, bytes};
  }

  static unsigned width_of(unsigned most) { return static_cast<unsigned>(std::bit_width(most)); }

  [[nodiscard]] ValueReader values_of(const ParquetPageHeader& page, std::string_view bytes) const {
    if (page.encoding == kPlain) {
      return plain_values(column_, bytes);
    }
    if (page.encoding == kRle && column_.type == ParquetType::kBoolean) {
      return [runs = RunReader(take_sized(bytes), 1)]() mutable {
        return static_cast<double>(runs.next());
      };
    }
    if (page.encoding == kPlainDictionary || page.encoding == kRleDictionary) {
      // A page of nulls may lack the width.
      const unsigned width = bytes.empty() ? 0 : static_cast<unsigned char>(bytes.front());
      bytes.remove_prefix(bytes.empty() ? 0 : 1);
      return [this, runs = RunReader(bytes, width)]() mutable {
        const std::uint32_t index = runs.next();
        if (index >= dictionary_.size()) {
          throw PageError{"a value that is not in the dictionary"};
        }
        return dictionary_[index];
      };
    }
    refuse(fmt::format("values encoded as {}", encoding_name(page.encoding)),
           "PLAIN, RLE, PLAIN_DICTIONARY or RLE_DICTIONARY");
  }

  void add_values(const ParquetPageHeader& page, PageContent content) const {
    const ValueReader next = values_of(page, content.values);
    for (std::size_t i = 0; i < page.values; ++i) {
      const std::uint32_t repetition = content.repetitions.next();
      const std::uint32_t definition = content.definitions.next();
      if (repetition > column_.most_repetition || definition > column_.most_definition) {
        throw PageError{"a level beyond those of the schema"};
      }
      if (repetition == 0) {
        rows_.begin_row();
      }
      if (definition == column_.most_definition) {
        rows_.add(next());
      } else if (definition >= column_.element_definition) {
        rows_.add(kNullValue);
      }
    }
  }

  const ParquetColumn& column_;
  const ParquetChunk& chunk_;
  const std::string& file_;
  ParquetRows& rows_;
  std::vector<double> dictionary_;
};

}  // namespace

ParquetRows::ParquetRows(std::size_t width, std::string file, std::string element)
    : width_(width), file_(std::move(file)), element_(std::move(element)) {}

void ParquetRows::expect(std::size_t rows) { most_rows_ = rows_ + rows; }

void ParquetRows::fail(std::size_t found) const {
  throw InputError({file_, element_, fmt::format("{} numbers in row {}", found, rows_),
                    fmt::format("{}, as in the other rows", width_), ""});
}

void ParquetRows::begin_row() {
  fill();
  if (rows_ == most_rows_) {
    throw InputError({file_, element_, fmt::format("more than {} rows", rows_),
                      "as many as the metadata name", "Copy the file again."});
  }
  ++rows_;
  in_row_ = 0;
}

void ParquetRows::end() {
  fill();
  if (rows_ != most_rows_) {
    throw InputError({file_, element_, fmt::format("{} rows", rows_),
                      fmt::format("{} by the metadata", most_rows_), "Copy the file again."});
  }
}

void ParquetRows::fill() {
  if (rows_ == 0) {
    return;
  }
  if (in_row_ == 0) {
    numbers_.insert(numbers_.end(), width_, kNullValue);
  } else if (in_row_ != width_) {
    fail(in_row_);
  }
  in_row_ = width_;
  if (numbers_.size() > kMostNumbers) {
    throw InputError({file_, element_, "more numbers than can be read",
                      fmt::format("{} at most", kMostNumbers), "Choose a part of them."});
  }
}

void ParquetRows::add(double number) {
  if (rows_ == 0 || in_row_ == width_) {
    fail(in_row_ + 1);
  }
  ++in_row_;
  numbers_.push_back(number);
}

void add_parquet_pages(const ParquetColumn& column, const ParquetChunk& chunk,
                       std::string_view pages, const std::string& file, ParquetRows& rows) {
  try {
    PageReader(column, chunk, file, rows).read(pages);
  } catch (const PageError& error) {
    throw InputError({file, "column " + column.name, error.what(), "pages of a Parquet file",
                      "Copy the file again."});
  }
}

}  // namespace handway::device
