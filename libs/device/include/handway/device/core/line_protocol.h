#pragma once

#include "handway/device/export.h"

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// What protocols of lines of ASCII words have in common.
namespace handway::device {

/// A line that is none of the protocol.
class LineProtocolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The words of a line.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::vector<std::string_view> words_of(std::string_view line);
/// @throws LineProtocolError if a word is no finite number.
[[nodiscard]] HANDWAY_DEVICE_EXPORT double number_of(std::string_view word);

/// Cuts bytes into lines.
class HANDWAY_DEVICE_EXPORT LineBuffer {
 public:
  void add(std::span<const std::uint8_t> bytes);
  /// The next whole line without its end. @throws LineProtocolError if one is longer than 4096.
  [[nodiscard]] std::optional<std::string> next();

 private:
  std::string text_;
};

}  // namespace handway::device
