#include "parquet_writer.h"

#include <snappy-c.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <span>

namespace handway::test {
namespace {

constexpr int kRle = 3;
constexpr int kRleDictionary = 8;

std::string varint(std::uint64_t value) {
  std::string bytes;
  for (; value > 0x7F; value >>= 7U) {
    bytes += static_cast<char>((value & 0x7FU) | 0x80U);
  }
  return bytes + static_cast<char>(value);
}

template <typename Number>
std::string little(Number number) {
  std::string bytes(sizeof(Number), '\0');
  std::memcpy(bytes.data(), &number, sizeof(Number));
  return bytes;
}

/// Small integers packed in bits, in one run.
std::string packed(const std::vector<std::uint32_t>& values, unsigned width) {
  if (width == 0) {
    return "";
  }
  const std::size_t groups = (values.size() + 7) / 8;
  std::string bits(groups * width, '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (unsigned bit = 0; bit < width; ++bit) {
      const std::size_t at = i * width + bit;
      const unsigned set = (values[i] >> bit) & 1U;
      bits[at / 8] = static_cast<char>(static_cast<unsigned char>(bits[at / 8]) | set << at % 8);
    }
  }
  return varint(groups << 1U | 1U) + bits;
}

/// Small integers as runs of equal ones.
std::string repeated(const std::vector<std::uint32_t>& values) {
  std::string bytes;
  for (std::size_t begin = 0; begin < values.size();) {
    std::size_t end = begin;
    while (end < values.size() && values[end] == values[begin]) {
      ++end;
    }
    bytes += varint((end - begin) << 1U) + static_cast<char>(values[begin]);
    begin = end;
  }
  return bytes;
}

std::string plain(WrittenColumn::Type type, std::span<const double> values) {
  std::string bytes;
  std::vector<std::uint32_t> truths;
  for (const double value : values) {
    switch (type) {
      case WrittenColumn::Type::kBool:
        truths.push_back(value != 0.0 ? 1 : 0);
        break;
      case WrittenColumn::Type::kInt64:
        bytes += little(static_cast<std::int64_t>(value));
        break;
      case WrittenColumn::Type::kFloat:
        bytes += little(static_cast<float>(value));
        break;
      case WrittenColumn::Type::kDouble:
        bytes += little(value);
        break;
      case WrittenColumn::Type::kText:
        bytes += little(std::uint32_t{1}) + 'a';
        break;
    }
  }
  // A run of bits without its head.
  return truths.empty() ? bytes
                        : packed(truths, 1).substr(varint((truths.size() + 7) / 8 << 1U).size());
}

std::string compressed(int codec, const std::string& bytes) {
  if (codec == 1) {
    std::string block(snappy_max_compressed_length(bytes.size()), '\0');
    std::size_t size = block.size();
    snappy_compress(bytes.data(), bytes.size(), block.data(), &size);
    return block.substr(0, size);
  }
  if (codec == 6) {
    std::string frame(ZSTD_compressBound(bytes.size()), '\0');
    return frame.substr(0,
                        ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), 1));
  }
  return bytes;
}

/// Levels and values of some rows.
struct Levels {
  std::vector<std::uint32_t> repetitions;
  std::vector<std::uint32_t> definitions;
  std::vector<double> values;
};

/// Lists are optional and have optional elements: 0 is a null list, 2 a null element.
Levels levels_of(const WrittenColumn& column, std::size_t first, std::size_t rows) {
  Levels levels;
  const std::size_t width = std::max<std::size_t>(column.width, 1);
  const auto all = std::span(column.values).subspan(first * width, rows * width);
  for (std::size_t row = 0; row < rows; ++row) {
    const auto values = all.subspan(row * width, width);
    const bool is_null = std::ranges::none_of(values, [](const auto& v) { return v.has_value(); });
    for (std::size_t i = 0; i < (is_null ? 1 : width); ++i) {
      levels.repetitions.push_back(i > 0 ? 1 : 0);
      levels.definitions.push_back(column.width == 0 ? (values[i] ? 1 : 0)
                                   : is_null         ? 0
                                                     : (values[i] ? 3 : 2));
      if (values[i]) {
        levels.values.push_back(*values[i]);
      }
    }
  }
  return levels;
}

/// The pages of a part of a column.
struct WrittenPages {
  std::string bytes;
  std::size_t dictionary_size = 0;  ///< Bytes of its page.
  std::size_t values = 0;
};

std::string page(const ThriftFields& header, const std::string& stored) {
  return header.bytes() + stored;
}

WrittenPages pages_of(const WrittenColumn& column, const ParquetStyle& style, std::size_t first,
                      std::size_t rows) {
  Levels levels = levels_of(column, first, rows);
  const auto count = static_cast<std::int64_t>(levels.definitions.size());
  WrittenPages pages;
  pages.values = levels.definitions.size();
  std::string values = plain(column.type, levels.values);
  if (column.has_dictionary) {
    std::vector<double> distinct = levels.values;
    std::ranges::sort(distinct);
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    std::vector<std::uint32_t> indices;
    for (const double value : levels.values) {
      indices.push_back(
          static_cast<std::uint32_t>(std::ranges::lower_bound(distinct, value) - distinct.begin()));
    }
    const std::string dictionary = plain(column.type, distinct);
    const std::string stored = compressed(style.codec, dictionary);
    pages.bytes =
        page(ThriftFields()
                 .integer(1, 2)
                 .integer(2, static_cast<std::int64_t>(dictionary.size()))
                 .integer(3, static_cast<std::int64_t>(stored.size()))
                 .structure(7, ThriftFields().integer(1, std::ssize(distinct)).integer(2, 0)),
             stored);
    pages.dictionary_size = pages.bytes.size();
    constexpr unsigned kWidth = 9;
    values = static_cast<char>(kWidth) + packed(indices, kWidth);
  }
  const int encoding = column.has_dictionary ? kRleDictionary : style.encoding;
  const std::string repetitions = column.width > 0 ? repeated(levels.repetitions) : "";
  const std::string definitions = packed(levels.definitions, column.width > 0 ? 2 : 1);
  if (style.page_version == 2) {
    const std::string stored = compressed(style.codec, values);
    const auto level_size = static_cast<std::int64_t>(repetitions.size() + definitions.size());
    pages.bytes += page(ThriftFields()
                            .integer(1, 3)
                            .integer(2, level_size + std::ssize(values))
                            .integer(3, level_size + std::ssize(stored))
                            .structure(8, ThriftFields()
                                              .integer(1, count)
                                              .integer(2, count - std::ssize(levels.values))
                                              .integer(3, static_cast<std::int64_t>(rows))
                                              .integer(4, encoding)
                                              .integer(5, std::ssize(definitions))
                                              .integer(6, std::ssize(repetitions))
                                              .truth(7, true)),
                        repetitions + definitions + stored);
    return pages;
  }
  const auto sized = [](const std::string& bytes) {
    return little(static_cast<std::uint32_t>(bytes.size())) + bytes;
  };
  const std::string content =
      (column.width > 0 ? sized(repetitions) : "") + sized(definitions) + values;
  const std::string stored = compressed(style.codec, content);
  pages.bytes += page(ThriftFields()
                          .integer(1, 0)
                          .integer(2, std::ssize(content))
                          .integer(3, std::ssize(stored))
                          .structure(5, ThriftFields()
                                            .integer(1, count)
                                            .integer(2, encoding)
                                            .integer(3, kRle)
                                            .integer(4, kRle)),
                      stored);
  return pages;
}

std::vector<ThriftFields> schema_of(const std::vector<WrittenColumn>& columns) {
  constexpr int kOptional = 1;
  constexpr int kRepeated = 2;
  std::vector<ThriftFields> schema{
      ThriftFields().text(4, "schema").integer(5, std::ssize(columns))};
  for (const WrittenColumn& column : columns) {
    const auto type = static_cast<std::int64_t>(column.type);
    if (column.width > 0) {
      schema.push_back(
          ThriftFields().integer(3, kOptional).text(4, column.name).integer(5, 1).integer(6, 3));
      schema.push_back(ThriftFields().integer(3, kRepeated).text(4, "list").integer(5, 1));
      schema.push_back(ThriftFields().integer(1, type).integer(3, kOptional).text(4, "element"));
    } else {
      schema.push_back(ThriftFields().integer(1, type).integer(3, kOptional).text(4, column.name));
    }
  }
  return schema;
}

}  // namespace

void ThriftFields::head(int number, int type) {
  bytes_ += static_cast<char>((number - last_) << 4 | type);
  last_ = number;
}

ThriftFields& ThriftFields::integer(int number, std::int64_t value) {
  constexpr int kInt64 = 6;
  head(number, kInt64);
  bytes_ += varint(static_cast<std::uint64_t>(value) << 1U ^ (value < 0 ? ~std::uint64_t{0} : 0));
  return *this;
}

ThriftFields& ThriftFields::truth(int number, bool value) {
  head(number, value ? 1 : 2);
  return *this;
}

ThriftFields& ThriftFields::text(int number, const std::string& value) {
  constexpr int kBinary = 8;
  head(number, kBinary);
  bytes_ += varint(value.size()) + value;
  return *this;
}

ThriftFields& ThriftFields::structure(int number, const ThriftFields& value) {
  constexpr int kStruct = 12;
  head(number, kStruct);
  bytes_ += value.bytes();
  return *this;
}

ThriftFields& ThriftFields::structures(int number, const std::vector<ThriftFields>& values) {
  constexpr int kList = 9;
  constexpr int kStruct = 12;
  constexpr int kLong = 15;
  head(number, kList);
  bytes_ += static_cast<char>(kLong << 4 | kStruct);
  bytes_ += varint(values.size());
  for (const ThriftFields& value : values) {
    bytes_ += value.bytes();
  }
  return *this;
}

std::string parquet_bytes(const std::vector<WrittenColumn>& columns, const ParquetStyle& style) {
  const std::size_t rows =
      columns.front().values.size() / std::max<std::size_t>(columns.front().width, 1);
  const std::size_t step = style.rows_of_group == 0 ? rows : style.rows_of_group;
  std::string bytes = "PAR1";
  std::vector<ThriftFields> groups;
  for (std::size_t first = 0; first < rows; first += step) {
    const std::size_t count = std::min(step, rows - first);
    std::vector<ThriftFields> chunks;
    for (const WrittenColumn& column : columns) {
      const WrittenPages pages = pages_of(column, style, first, count);
      const auto begin = static_cast<std::int64_t>(bytes.size());
      ThriftFields metadata;
      metadata.integer(1, static_cast<std::int64_t>(column.type))
          .integer(4, style.codec)
          .integer(5, static_cast<std::int64_t>(pages.values))
          .integer(7, std::ssize(pages.bytes))
          .integer(9, begin + static_cast<std::int64_t>(pages.dictionary_size));
      if (pages.dictionary_size > 0) {
        metadata.integer(11, begin);
      }
      chunks.push_back(ThriftFields().integer(2, begin).structure(3, metadata));
      bytes += pages.bytes;
    }
    groups.push_back(
        ThriftFields().structures(1, chunks).integer(3, static_cast<std::int64_t>(count)));
  }
  const std::string metadata = ThriftFields()
                                   .integer(1, 1)
                                   .structures(2, schema_of(columns))
                                   .integer(3, static_cast<std::int64_t>(rows))
                                   .structures(4, groups)
                                   .bytes();
  return bytes + metadata + little(static_cast<std::uint32_t>(metadata.size())) + "PAR1";
}

}  // namespace handway::test
