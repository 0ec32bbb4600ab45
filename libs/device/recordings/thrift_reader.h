#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace handway::device {

/// Reads structures of Thrift's compact protocol, as in the metadata of Parquet files.
/// Source: Apache Thrift, doc/specs/thrift-compact-protocol.md.
class ThriftReader {
 public:
  /// Types of fields and of elements of lists.
  enum class Type : std::uint8_t {
    kStop = 0,
    kTrue = 1,
    kFalse = 2,
    kByte = 3,
    kInt16 = 4,
    kInt32 = 5,
    kInt64 = 6,
    kDouble = 7,
    kBinary = 8,
    kList = 9,
    kSet = 10,
    kMap = 11,
    kStruct = 12,
    kUuid = 13,
  };
  /// Reads a field and returns true, or returns false to skip it.
  using Field = std::function<bool(std::int64_t number, Type type)>;

  /// @param bytes which outlive the reader. @param source file for messages.
  ThriftReader(std::string_view bytes, std::string source);

  // All functions throw InputError if the bytes end before, or are invalid.

  /// Reads the fields of a structure.
  void structure(const Field& field);
  /// Reads a list: `element` reads one element, of the type that is passed to it.
  void list(Type type, const std::function<void(Type)>& element);
  /// Reads an integer of any size. @param type of the field.
  [[nodiscard]] std::int64_t integer(Type type);
  /// Reads bytes or a text. @param type of the field.
  [[nodiscard]] std::string_view binary(Type type);
  /// The number of bytes read so far.
  [[nodiscard]] std::size_t position() const { return at_; }

 private:
  struct Elements {
    Type type = Type::kStop;
    std::size_t count = 0;
  };

  [[noreturn]] void fail(const std::string& found) const;
  void require(bool holds, const std::string& found) const;
  std::uint8_t byte();
  std::uint64_t varint();
  std::int64_t zigzag();
  std::string_view take(std::uint64_t size);
  Elements elements();
  void skip(Type type, int depth);
  void skip_map(int depth);
  void skip_element(Type type, int depth);

  std::string_view bytes_;
  std::string source_;
  std::size_t at_ = 0;
};

}  // namespace handway::device
