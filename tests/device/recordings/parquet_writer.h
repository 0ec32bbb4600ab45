#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// A small writer of Parquet files for tests, by the specification of Apache Parquet.

namespace handway::test {

/// Fields of a structure of Thrift's compact protocol.
class ThriftFields {
 public:
  ThriftFields& integer(int number, std::int64_t value);
  ThriftFields& truth(int number, bool value);
  ThriftFields& text(int number, const std::string& value);
  ThriftFields& structure(int number, const ThriftFields& value);
  ThriftFields& structures(int number, const std::vector<ThriftFields>& values);
  /// The bytes with the mark of their end.
  [[nodiscard]] std::string bytes() const { return bytes_ + '\0'; }

 private:
  void head(int number, int type);

  std::string bytes_;
  int last_ = 0;
};

/// A column of lists of the same length, or of single numbers, as float, double, 64-bit integers
/// or truth values.
struct WrittenColumn {
  enum class Type : std::uint8_t { kBool = 0, kInt64 = 2, kFloat = 4, kDouble = 5, kText = 6 };
  std::string name;
  Type type = Type::kDouble;
  std::size_t width = 0;  ///< 0: single numbers.
  /// Numbers of all rows; nothing: null. A list whose numbers are all missing is null.
  std::vector<std::optional<double>> values;
  bool has_dictionary = false;
};

/// Choices of a writer.
struct ParquetStyle {
  int page_version = 1;
  int codec = 0;     ///< 0: none, 1: Snappy, 6: Zstandard; others are named, but not applied.
  int encoding = 0;  ///< Encoding that pages without a dictionary name.
  std::size_t rows_of_group = 0;  ///< 0: all.
};

[[nodiscard]] std::string parquet_bytes(const std::vector<WrittenColumn>& columns,
                                        const ParquetStyle& style = {});

}  // namespace handway::test
