#include "recordings/thrift_reader.h"

#include "handway/geometric/io/input_error.h"

#include <utility>

namespace handway::device {
namespace {

constexpr int kDeepestStructure = 32;

}  // namespace

ThriftReader::ThriftReader(std::string_view bytes, std::string source)
    : bytes_(bytes), source_(std::move(source)) {}

void ThriftReader::fail(const std::string& found) const {
  throw geometric::InputError(
      {source_, "metadata", found, "the metadata of a Parquet file", "Copy the file again."});
}

void ThriftReader::require(bool holds, const std::string& found) const {
  if (!holds) {
    fail(found);
  }
}

std::uint8_t ThriftReader::byte() {
  require(at_ < bytes_.size(), "an end within a field");
  return static_cast<std::uint8_t>(bytes_[at_++]);
}

std::uint64_t ThriftReader::varint() {
  constexpr unsigned kBits = 7;
  constexpr unsigned kMostBits = 64;
  std::uint64_t number = 0;
  for (unsigned shift = 0; shift < kMostBits; shift += kBits) {
    const std::uint8_t next = byte();
    number |= static_cast<std::uint64_t>(next & 0x7FU) << shift;
    if ((next & 0x80U) == 0) {
      return number;
    }
  }
  fail("an integer of more than 64 bits");
}

std::int64_t ThriftReader::zigzag() {
  const std::uint64_t number = varint();
  return static_cast<std::int64_t>((number >> 1U) ^ (~(number & 1U) + 1U));
}

std::string_view ThriftReader::take(std::uint64_t size) {
  require(size <= bytes_.size() - at_, "an end within a field");
  const std::string_view taken = bytes_.substr(at_, static_cast<std::size_t>(size));
  at_ += taken.size();
  return taken;
}

void ThriftReader::structure(const Field& field) {
  std::int64_t number = 0;
  while (true) {
    const std::uint8_t head = byte();
    const auto type = static_cast<Type>(head & 0x0FU);
    if (type == Type::kStop) {
      return;
    }
    const std::int64_t step = head >> 4U;
    // Numbers beyond those of Parquet are skipped, whatever they are.
    number = step == 0 ? zigzag() : static_cast<std::int64_t>((number + step) & 0xFFFF);
    if (!field(number, type)) {
      skip(type, 0);
    }
  }
}

ThriftReader::Elements ThriftReader::elements() {
  constexpr std::uint64_t kLongList = 15;
  const std::uint8_t head = byte();
  std::uint64_t count = head >> 4U;
  if (count == kLongList) {
    count = varint();
  }
  // Every element has a byte at least.
  require(count <= bytes_.size() - at_, "a list that is longer than the metadata");
  return {static_cast<Type>(head & 0x0FU), static_cast<std::size_t>(count)};
}

void ThriftReader::list(Type type, const std::function<void(Type)>& element) {
  require(type == Type::kList, "another value in place of a list");
  const Elements all = elements();
  for (std::size_t i = 0; i < all.count; ++i) {
    element(all.type);
  }
}

std::int64_t ThriftReader::integer(Type type) {
  switch (type) {
    case Type::kTrue:
      return 1;
    case Type::kFalse:
      return 0;
    case Type::kByte:
      return static_cast<std::int8_t>(byte());
    case Type::kInt16:
    case Type::kInt32:
    case Type::kInt64:
      return zigzag();
    default:
      fail("another value in place of a number");
  }
}

std::string_view ThriftReader::binary(Type type) {
  require(type == Type::kBinary, "another value in place of a text");
  return take(varint());
}

void ThriftReader::skip(Type type, int depth) {
  require(depth < kDeepestStructure, "structures within each other, more than 32");
  switch (type) {
    case Type::kTrue:
    case Type::kFalse:
      break;
    case Type::kByte:
      static_cast<void>(byte());
      break;
    case Type::kInt16:
    case Type::kInt32:
    case Type::kInt64:
      static_cast<void>(varint());
      break;
    case Type::kDouble:
      static_cast<void>(take(sizeof(double)));
      break;
    case Type::kUuid:
      static_cast<void>(take(16));
      break;
    case Type::kBinary:
      static_cast<void>(take(varint()));
      break;
    case Type::kList:
    case Type::kSet: {
      const Elements all = elements();
      for (std::size_t i = 0; i < all.count; ++i) {
        skip_element(all.type, depth + 1);
      }
      break;
    }
    case Type::kMap:
      skip_map(depth);
      break;
    case Type::kStruct:
      structure([this, depth](std::int64_t /*number*/, Type inner) {
        skip(inner, depth + 1);
        return true;
      });
      break;
    default:
      fail("a field of unknown type");
  }
}

void ThriftReader::skip_map(int depth) {
  const std::uint64_t count = varint();
  if (count == 0) {
    return;
  }
  const std::uint8_t types = byte();
  require(count <= bytes_.size() - at_, "a map that is longer than the metadata");
  for (std::uint64_t i = 0; i < count; ++i) {
    skip_element(static_cast<Type>(types >> 4U), depth + 1);
    skip_element(static_cast<Type>(types & 0x0FU), depth + 1);
  }
}

// Truth values have a byte of their own in lists and maps, but none in structures.
void ThriftReader::skip_element(Type type, int depth) {
  const bool is_truth = type == Type::kTrue || type == Type::kFalse;
  skip(is_truth ? Type::kByte : type, depth);
}

}  // namespace handway::device
