#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace handway::device {

/// Thrown for a message that is shorter than its contents.
class CdrError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads the fields of a message in CDR (version 1), the encoding of ROS 2, one after the other.
/// Source: OMG, DDS Interoperability Wire Protocol 2.2, section 10.
class CdrReader {
 public:
  /// @param message with its four bytes of encapsulation, which outlives the reader.
  /// @throws CdrError if they name another encoding.
  explicit CdrReader(std::string_view message);

  /// All functions throw CdrError if the message ends before.
  [[nodiscard]] std::int32_t int32();
  [[nodiscard]] std::uint32_t uint32();
  [[nodiscard]] double float64();
  [[nodiscard]] std::string text();
  [[nodiscard]] std::vector<std::string> texts();
  [[nodiscard]] std::vector<double> float64s();
  /// The number of elements of a sequence. @param least the fewest bytes of an element.
  [[nodiscard]] std::size_t count(std::size_t least);
  /// A time or duration of ROS, s.
  [[nodiscard]] double seconds();

 private:
  template <typename Number>
  Number number();
  std::string_view take(std::size_t size);

  std::string_view body_;
  std::size_t at_ = 0;
  bool big_endian_ = false;
};

}  // namespace handway::device
