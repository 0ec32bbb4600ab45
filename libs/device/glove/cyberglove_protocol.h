#pragma once

#include "handway/device/core/byte_link.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <string_view>
#include <vector>

namespace handway::device {

/// The answer of a CyberGlove interface unit to one command.
struct CyberGloveReply {
  std::vector<std::uint8_t> data;
  char error = 0;  ///< '?', 'g', 's' or 'y' if it refused, else 0.
};

/// Searches `bytes` for ECHO DATA 00, or for ECHO 'e' LETTER 00 of a refusal, after any other
/// bytes. The data may hold 00.
[[nodiscard]] std::optional<CyberGloveReply> find_reply(std::span<const std::uint8_t> bytes,
                                                        std::span<const std::uint8_t> echo,
                                                        std::size_t data_length);

/// The four bytes that set a sampling rate: two big-endian words with
/// rate = 115200 / (w1 w2) Hz.
/// @param rate Hz, from 0.5 to 1000; rounded to the nearest that the words can encode.
[[nodiscard]] std::array<std::uint8_t, 4> sampling_words(double rate);

/// Queries and settings of a CyberGlove interface unit, by its binary commands.
class CyberGloveCommands {
 public:
  CyberGloveCommands(ByteLink& link, std::chrono::milliseconds timeout)
      : link_(link), timeout_(timeout) {}

  /// Ends a stream that may be running, and discards pending bytes.
  void stop_stream(const std::stop_token& stop);

  /// Sends "?X". @returns its data; nothing if none of three tries had a good answer.
  [[nodiscard]] std::optional<CyberGloveReply> query(char letter, std::size_t data_length,
                                                     const std::stop_token& stop);

  /// "X ARGUMENTS".
  [[nodiscard]] std::optional<CyberGloveReply> set(char letter,
                                                   std::span<const std::uint8_t> arguments,
                                                   const std::stop_token& stop);

  /// Shortest time from a command to its answer, s; 0 before the first answer.
  [[nodiscard]] double round_trip() const { return round_trip_; }

 private:
  std::optional<CyberGloveReply> ask(std::span<const std::uint8_t> command,
                                     std::span<const std::uint8_t> echo, std::size_t data_length,
                                     const std::stop_token& stop);
  void drain(std::chrono::milliseconds quiet, std::chrono::milliseconds at_most,
             const std::stop_token& stop);

  ByteLink& link_;
  std::chrono::milliseconds timeout_;
  double round_trip_ = 0.0;
};

/// A command in the ASCII form of the CyberGlove protocol: a lower-case letter (after '?' for a
/// query), decimal numbers, CR.
struct TextCommand {
  bool query = false;
  char letter = 0;                      ///< In upper case, as in the binary form.
  std::vector<std::uint8_t> arguments;  ///< Binary form: words as two bytes.
};

/// @param line with its CR. @returns nothing if it is not a command.
[[nodiscard]] std::optional<TextCommand> read_text_command(std::span<const std::uint8_t> line);

/// `line` CR LF.
[[nodiscard]] std::vector<std::uint8_t> text_line(std::string_view line);

/// "e?" CR LF.
[[nodiscard]] std::vector<std::uint8_t> text_refusal(std::string_view code);

/// The letter in lower case (after `before`, if that isn't 0), then the values as numbers.
[[nodiscard]] std::vector<std::uint8_t> text_answer(char before, char letter,
                                                    std::span<const std::uint8_t> values);

}  // namespace handway::device
