#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace handway::device {

/// Returns an integer in groups of 7 bits, the lowest first (ULEB128).
[[nodiscard]] std::string varint_bytes(std::uint64_t value);

/// Writes a structure of Thrift's compact protocol, as in the metadata of Parquet files. Fields are
/// added by increasing numbers, at most 15 apart.
/// Source: Apache Thrift, doc/specs/thrift-compact-protocol.md.
class ThriftWriter {
 public:
  ThriftWriter& int32(int number, std::int32_t value);
  ThriftWriter& int64(int number, std::int64_t value);
  /// Adds bytes or a text.
  ThriftWriter& binary(int number, std::string_view bytes);
  ThriftWriter& structure(int number, const ThriftWriter& fields);
  ThriftWriter& int32_list(int number, const std::vector<std::int32_t>& values);
  ThriftWriter& binary_list(int number, const std::vector<std::string>& values);
  ThriftWriter& structure_list(int number, const std::vector<ThriftWriter>& values);
  /// Returns the structure with the mark of its end.
  [[nodiscard]] std::string bytes() const { return bytes_ + '\0'; }

 private:
  void field(int number, int type);
  void list(int number, int type, std::size_t size);

  std::string bytes_;
  int last_ = 0;
};

}  // namespace handway::device
