#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace handway::device {

/// Thrown for a message that is shorter than its contents.
class MessageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Encoding of messages.
enum class MessageEncoding {
  /// CDR (version 1), of ROS 2. Source: OMG, DDS Interoperability Wire Protocol 2.2, section 10.
  kCdr,
  /// The encoding of ROS 1: little-endian numbers side by side. Source: ROS wiki, "msg", 2.1.1.
  kRos1,
};

/// Reads the fields of a message one after the other.
class MessageReader {
 public:
  /// @param message which outlives the reader; in CDR with its four bytes of encapsulation.
  /// @throws MessageError if these name another encoding.
  MessageReader(std::string_view message, MessageEncoding encoding);

  /// All functions throw MessageError if the message ends before.
  [[nodiscard]] std::int32_t int32();
  [[nodiscard]] std::uint32_t uint32();
  [[nodiscard]] double float64();
  /// Passes over so many bytes, which are not aligned.
  void skip(std::size_t bytes);
  /// Passes over a sequence of parts of `size` bytes, each of numbers of 4 bytes or of single
  /// bytes.
  void skip_sequence(std::size_t size);
  [[nodiscard]] std::string text();
  [[nodiscard]] std::vector<std::string> texts();
  [[nodiscard]] std::vector<double> float64s();
  /// The number of elements of a sequence. @param least the fewest bytes of an element.
  [[nodiscard]] std::size_t count(std::size_t least);
  /// A time or duration of ROS, s.
  [[nodiscard]] double seconds();
  /// Returns whether no field follows, but bytes that fill up the message.
  [[nodiscard]] bool is_at_end() const;
  /// The stamp of a header, s since 1970; nothing if it was not set.
  [[nodiscard]] std::optional<double> stamp();

 private:
  template <typename Number>
  Number number();
  std::string_view take(std::size_t size);

  std::string_view body_;
  std::size_t at_ = 0;
  bool big_endian_ = false;
  bool is_aligned_ = true;     ///< Numbers begin at multiples of their sizes.
  bool has_sequence_ = false;  ///< Headers begin with a number.
};

}  // namespace handway::device
