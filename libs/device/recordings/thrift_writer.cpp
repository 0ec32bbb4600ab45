#include "recordings/thrift_writer.h"

#include "recordings/thrift_reader.h"

#include <cstddef>
#include <stdexcept>

namespace handway::device {
namespace {

constexpr int type_code(ThriftReader::Type type) { return static_cast<int>(type); }

constexpr int kInt32Type = type_code(ThriftReader::Type::kInt32);
constexpr int kInt64Type = type_code(ThriftReader::Type::kInt64);
constexpr int kBinaryType = type_code(ThriftReader::Type::kBinary);
constexpr int kListType = type_code(ThriftReader::Type::kList);
constexpr int kStructType = type_code(ThriftReader::Type::kStruct);

/// Signs alternate: 0, -1, 1, -2, … become 0, 1, 2, 3, ….
std::string zigzag_bytes(std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  return varint_bytes((bits << 1U) ^ (value < 0 ? ~std::uint64_t{0} : 0));
}

std::string sized_bytes(std::string_view bytes) { return varint_bytes(bytes.size()).append(bytes); }

}  // namespace

std::string varint_bytes(std::uint64_t value) {
  std::string bytes;
  for (; value > 0x7FU; value >>= 7U) {
    bytes += static_cast<char>((value & 0x7FU) | 0x80U);
  }
  bytes += static_cast<char>(value);
  return bytes;
}

void ThriftWriter::field(int number, int type) {
  constexpr int kLargestStep = 15;
  if (number <= last_ || number > last_ + kLargestStep) {
    throw std::invalid_argument("fields of a structure have to be in order");
  }
  bytes_ += static_cast<char>(((number - last_) << 4) | type);
  last_ = number;
}

void ThriftWriter::list(int number, int type, std::size_t size) {
  constexpr std::size_t kLongList = 15;
  field(number, kListType);
  if (size < kLongList) {
    bytes_ += static_cast<char>((static_cast<int>(size) << 4) | type);
  } else {
    bytes_ += static_cast<char>((static_cast<int>(kLongList) << 4) | type);
    bytes_ += varint_bytes(size);
  }
}

ThriftWriter& ThriftWriter::int32(int number, std::int32_t value) {
  field(number, kInt32Type);
  bytes_ += zigzag_bytes(value);
  return *this;
}

ThriftWriter& ThriftWriter::int64(int number, std::int64_t value) {
  field(number, kInt64Type);
  bytes_ += zigzag_bytes(value);
  return *this;
}

ThriftWriter& ThriftWriter::binary(int number, std::string_view bytes) {
  field(number, kBinaryType);
  bytes_ += sized_bytes(bytes);
  return *this;
}

ThriftWriter& ThriftWriter::structure(int number, const ThriftWriter& fields) {
  field(number, kStructType);
  bytes_ += fields.bytes();
  return *this;
}

ThriftWriter& ThriftWriter::int32_list(int number, const std::vector<std::int32_t>& values) {
  list(number, kInt32Type, values.size());
  for (const std::int32_t value : values) {
    bytes_ += zigzag_bytes(value);
  }
  return *this;
}

ThriftWriter& ThriftWriter::binary_list(int number, const std::vector<std::string>& values) {
  list(number, kBinaryType, values.size());
  for (const std::string& value : values) {
    bytes_ += sized_bytes(value);
  }
  return *this;
}

ThriftWriter& ThriftWriter::structure_list(int number, const std::vector<ThriftWriter>& values) {
  list(number, kStructType, values.size());
  for (const ThriftWriter& value : values) {
    bytes_ += value.bytes();
  }
  return *this;
}

}  // namespace handway::device
