#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Metadata of Parquet files. Source: Apache Parquet, parquet.thrift of parquet-format 2.11.

namespace handway::device {

/// Physical types of values.
enum class ParquetType : std::uint8_t {
  kBoolean = 0,
  kInt32 = 1,
  kInt64 = 2,
  kInt96 = 3,
  kFloat = 4,
  kDouble = 5,
  kByteArray = 6,
  kFixedLengthByteArray = 7,
};

/// A column of a table: one value, or a list of them, in each row.
struct ParquetColumn {
  std::string name;
  ParquetType type = ParquetType::kByteArray;
  bool is_unsigned = false;
  unsigned most_repetition = 0;     ///< Highest repetition level: the depth of lists.
  unsigned most_definition = 0;     ///< Definition level of a value that is there.
  unsigned element_definition = 0;  ///< From this level on there is an element, maybe a null.
  std::size_t leaf = 0;             ///< Its place among the chunks of a group of rows.
  std::string problem;              ///< Reason why it has no numbers; empty if it has.

  [[nodiscard]] bool has_lists() const { return most_repetition > 0; }
  /// "float32", "int64", "bool"; "text" or "structure" for columns without numbers.
  [[nodiscard]] std::string type_name() const;
};

/// The part of a column that belongs to a group of rows.
struct ParquetChunk {
  std::int64_t codec = 0;
  std::uint64_t values = 0;  ///< With nulls.
  std::uint64_t offset = 0;  ///< Place of its first page in the file.
  std::uint64_t size = 0;    ///< Size of its pages, bytes.
  std::string problem;       ///< Reason why it can't be read; empty if it can.
};

struct ParquetRowGroup {
  std::uint64_t rows = 0;
  std::vector<ParquetChunk> chunks;  ///< One for each leaf of the schema.
};

struct ParquetMetadata {
  std::vector<ParquetColumn> columns;  ///< Fields of the schema's root.
  std::vector<ParquetRowGroup> groups;
  std::uint64_t rows = 0;  ///< Rows of all groups.
};

/// Parses the metadata at the end of a file.
/// @param source file for messages. @throws InputError if they are damaged or contradictory.
[[nodiscard]] ParquetMetadata parse_parquet_metadata(std::string_view bytes,
                                                     const std::string& source);

enum class ParquetPageKind : std::uint8_t { kData = 0, kIndex = 1, kDictionary = 2, kData2 = 3 };

/// Header of a page.
struct ParquetPageHeader {
  ParquetPageKind kind = ParquetPageKind::kIndex;
  std::size_t size = 0;             ///< Size of the page in memory, bytes.
  std::size_t compressed_size = 0;  ///< Size in the file, behind this header, bytes.
  std::size_t values = 0;           ///< With nulls.
  std::int64_t encoding = 0;
  std::int64_t definition_encoding = 3;  ///< RLE, as always in version 2.
  std::int64_t repetition_encoding = 3;
  std::size_t definition_size = 0;  ///< Size of the levels in version 2, bytes.
  std::size_t repetition_size = 0;
  bool is_compressed = true;
  std::size_t header_size = 0;  ///< Size of this header, bytes.
};

/// Parses the header at the beginning of some bytes. @throws InputError if it is damaged.
[[nodiscard]] ParquetPageHeader parse_parquet_page(std::string_view bytes,
                                                   const std::string& source);

}  // namespace handway::device
