#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace handway::device {

/// A command in the ASCII form of the CyberGlove protocol: a lower-case letter (after '?' for a
/// query), decimal numbers, CR.
struct TextCommand {
  bool query = false;
  char letter = 0;                      ///< Upper-case, as of the binary form.
  std::vector<std::uint8_t> arguments;  ///< As of the binary form: words as two bytes.
};

/// @param line with its CR. @returns nothing if it is no command.
[[nodiscard]] std::optional<TextCommand> read_text_command(std::span<const std::uint8_t> line);

/// `line` CR LF.
[[nodiscard]] std::vector<std::uint8_t> text_line(std::string_view line);

/// "e?" CR LF.
[[nodiscard]] std::vector<std::uint8_t> text_refusal(std::string_view code);

/// The letter in lower case (after `before`, if that isn't 0), then the values as numbers.
[[nodiscard]] std::vector<std::uint8_t> text_answer(char before, char letter,
                                                    std::span<const std::uint8_t> values);

}  // namespace handway::device
