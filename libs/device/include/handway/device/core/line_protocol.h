#pragma once

#include "handway/device/export.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// Common parts of protocols of ASCII lines.
namespace handway::device {

/// Thrown for a line that is not of the protocol.
class LineProtocolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The words of a line.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::vector<std::string_view> words_of(std::string_view line);
/// @throws LineProtocolError if a word is not a finite number.
[[nodiscard]] HANDWAY_DEVICE_EXPORT double number_of(std::string_view word);

/// Quotes received text for a message: one line, at most 160 characters, non-printable and
/// non-ASCII characters as "?".
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string quote(std::string_view text);

/// Cuts bytes into lines. Between two calls of add(), call next() until it returns nothing: then it
/// stores at most one line's beginning.
class HANDWAY_DEVICE_EXPORT LineBuffer {
 public:
  /// Longest line of most protocols, bytes.
  static constexpr std::size_t kLongestLine = 4096;

  LineBuffer() = default;
  explicit LineBuffer(std::size_t longest) : longest_(longest) {}

  void add(std::span<const std::uint8_t> bytes);
  /// The next complete line without its end. @throws LineProtocolError if it is longer
  /// than allowed.
  [[nodiscard]] std::optional<std::string> next();

 private:
  std::size_t longest_ = kLongestLine;
  std::string text_;
  std::size_t begin_ = 0;  ///< Start of the bytes not returned by next() yet.
};

}  // namespace handway::device
