#include "recordings/parquet_writer.h"

#include "recordings/parquet_file.h"

#include <bit>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace handway::device {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they are");

constexpr std::int32_t kPlainEncoding = 0;
constexpr std::int32_t kRleEncoding = 3;

template <typename Number>
std::string raw_bytes(Number number) {
  std::string bytes(sizeof(Number), '\0');
  std::memcpy(bytes.data(), &number, sizeof(Number));
  return bytes;
}

/// Bytes behind their number in four bytes.
std::string with_size(const std::string& bytes) {
  return raw_bytes(static_cast<std::uint32_t>(bytes.size())) + bytes;
}

std::size_t row_count_of(const ParquetCells& cells) {
  const auto* numbers = std::get_if<Eigen::MatrixXd>(&cells);
  return numbers != nullptr ? static_cast<std::size_t>(numbers->rows())
                            : std::get<std::vector<std::string>>(cells).size();
}

/// Values of a row.
std::size_t width_of_cells(const ParquetCells& cells) {
  const auto* numbers = std::get_if<Eigen::MatrixXd>(&cells);
  return numbers != nullptr ? static_cast<std::size_t>(numbers->cols()) : 1;
}

/// Definition level of a value that is there: of an optional column, or of an optional element in
/// a repeated group of an optional list.
std::uint64_t definition_of(const ParquetField& field) { return field.has_lists ? 3 : 1; }

/// Repetition levels, packed in bits: 0 at the first value of each row, 1 at the others.
std::string repetition_levels(std::size_t rows, std::size_t width) {
  constexpr std::size_t kBits = 8;
  const std::size_t count = rows * width;
  const std::size_t groups = (count + kBits - 1) / kBits;
  std::string bits(groups, '\0');
  for (std::size_t at = 0; at < count; ++at) {
    const unsigned level = at % width == 0 ? 0U : 1U;
    const auto byte = static_cast<unsigned char>(bits[at / kBits]);
    bits[at / kBits] = static_cast<char>(byte | (level << (at % kBits)));
  }
  return varint_bytes((groups << 1U) | 1U) + bits;
}

/// Definition levels of values that are all there, in one run.
std::string definition_levels(const ParquetField& field, std::size_t count) {
  return varint_bytes(count << 1U) + static_cast<char>(definition_of(field));
}

std::string number_bytes(ParquetType type, double number) {
  switch (type) {
    case ParquetType::kInt64:
      return raw_bytes(static_cast<std::int64_t>(number));
    case ParquetType::kFloat:
      return raw_bytes(static_cast<float>(number));
    default:
      return raw_bytes(number);
  }
}

/// Values in the order of the rows, PLAIN.
std::string plain_bytes(ParquetType type, const ParquetCells& cells) {
  std::string bytes;
  if (const auto* numbers = std::get_if<Eigen::MatrixXd>(&cells)) {
    bytes.reserve(static_cast<std::size_t>(numbers->size()) * sizeof(double));
    for (Eigen::Index row = 0; row < numbers->rows(); ++row) {
      for (const double number : numbers->row(row)) {
        bytes += number_bytes(type, number);
      }
    }
    return bytes;
  }
  for (const std::string& text : std::get<std::vector<std::string>>(cells)) {
    bytes += with_size(text);
  }
  return bytes;
}

/// Checks the values of a column.
void check_cells(const ParquetField& field, const ParquetCells& cells, std::size_t rows) {
  const bool is_text = std::holds_alternative<std::vector<std::string>>(cells);
  const bool fits = field.has_lists ? width_of_cells(cells) > 0 : width_of_cells(cells) == 1;
  if (is_text != (field.type == ParquetType::kByteArray) || !fits || row_count_of(cells) != rows) {
    throw std::invalid_argument("values that do not fit the column " + field.name);
  }
}

/// A page of version 1 with its header.
std::string data_page(const ParquetField& field, const ParquetCells& cells, std::size_t rows) {
  const std::size_t width = width_of_cells(cells);
  std::string content = field.has_lists ? with_size(repetition_levels(rows, width)) : "";
  content += with_size(definition_levels(field, rows * width));
  content += plain_bytes(field.type, cells);
  const auto size = static_cast<std::int32_t>(content.size());
  const ThriftWriter header =
      ThriftWriter()
          .int32(1, static_cast<std::int32_t>(ParquetPageKind::kData))
          .int32(2, size)
          .int32(3, size)
          .structure(5, ThriftWriter()
                            .int32(1, static_cast<std::int32_t>(rows * width))
                            .int32(2, kPlainEncoding)
                            .int32(3, kRleEncoding)
                            .int32(4, kRleEncoding));
  return header.bytes() + content;
}

/// Elements of the schema, depth first: the root and all columns.
std::vector<ThriftWriter> schema_elements(const std::vector<ParquetField>& fields) {
  constexpr std::int32_t kOptional = 1;
  constexpr std::int32_t kRepeated = 2;
  constexpr std::int32_t kUtf8 = 0;  // converted types, and fields of the union LogicalType
  constexpr std::int32_t kListOfValues = 3;
  constexpr int kStringField = 1;
  constexpr int kListField = 3;
  std::vector<ThriftWriter> elements{
      ThriftWriter().binary(4, "schema").int32(5, static_cast<std::int32_t>(fields.size()))};
  for (const ParquetField& field : fields) {
    ThriftWriter value;
    value.int32(1, static_cast<std::int32_t>(field.type)).int32(3, kOptional);
    value.binary(4, field.has_lists ? std::string("element") : field.name);
    if (field.type == ParquetType::kByteArray) {
      value.int32(6, kUtf8).structure(10, ThriftWriter().structure(kStringField, {}));
    }
    if (field.has_lists) {
      elements.push_back(ThriftWriter()
                             .int32(3, kOptional)
                             .binary(4, field.name)
                             .int32(5, 1)
                             .int32(6, kListOfValues)
                             .structure(10, ThriftWriter().structure(kListField, {})));
      elements.push_back(ThriftWriter().int32(3, kRepeated).binary(4, "list").int32(5, 1));
    }
    elements.push_back(std::move(value));
  }
  return elements;
}

}  // namespace

ParquetWriter::ParquetWriter(std::vector<ParquetField> fields)
    : fields_(std::move(fields)), bytes_(kParquetMark) {}

void ParquetWriter::add_rows(const std::vector<ParquetCells>& cells) {
  if (cells.size() != fields_.size() || cells.empty()) {
    throw std::invalid_argument("values of other columns");
  }
  const std::size_t rows = row_count_of(cells.front());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    check_cells(fields_[i], cells[i], rows);
  }
  if (rows == 0) {
    return;
  }
  const std::size_t begin = bytes_.size();
  std::vector<ThriftWriter> chunks;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    chunks.push_back(add_chunk(fields_[i], cells[i], rows));
  }
  groups_.push_back(ThriftWriter()
                        .structure_list(1, chunks)
                        .int64(2, static_cast<std::int64_t>(bytes_.size() - begin))
                        .int64(3, static_cast<std::int64_t>(rows)));
  rows_ += static_cast<std::int64_t>(rows);
}

// Returns the ColumnChunk.
ThriftWriter ParquetWriter::add_chunk(const ParquetField& field, const ParquetCells& cells,
                                      std::size_t rows) {
  constexpr std::int32_t kUncompressed = 0;
  const auto begin = static_cast<std::int64_t>(bytes_.size());
  const std::string page = data_page(field, cells, rows);
  bytes_ += page;
  const std::vector<std::string> path =
      field.has_lists ? std::vector<std::string>{field.name, "list", "element"}
                      : std::vector<std::string>{field.name};
  const auto size = static_cast<std::int64_t>(page.size());
  const ThriftWriter metadata =
      ThriftWriter()
          .int32(1, static_cast<std::int32_t>(field.type))
          .int32_list(2, {kPlainEncoding, kRleEncoding})
          .binary_list(3, path)
          .int32(4, kUncompressed)
          .int64(5, static_cast<std::int64_t>(rows * width_of_cells(cells)))
          .int64(6, size)
          .int64(7, size)
          .int64(9, begin);
  return ThriftWriter().int64(2, 0).structure(3, metadata);
}

std::string ParquetWriter::file(const ParquetNotes& notes) const {
  constexpr std::int32_t kVersion1 = 1;
  ThriftWriter metadata;
  metadata.int32(1, kVersion1)
      .structure_list(2, schema_elements(fields_))
      .int64(3, rows_)
      .structure_list(4, groups_);
  if (!notes.empty()) {
    std::vector<ThriftWriter> pairs;
    for (const auto& [key, value] : notes) {
      pairs.push_back(ThriftWriter().binary(1, key).binary(2, value));
    }
    metadata.structure_list(5, pairs);
  }
  std::string bytes = bytes_ + metadata.bytes();
  bytes += raw_bytes(static_cast<std::uint32_t>(metadata.bytes().size()));
  return bytes.append(kParquetMark);
}

}  // namespace handway::device
