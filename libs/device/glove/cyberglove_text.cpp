#include "cyberglove_text.h"

#include <cctype>
#include <charconv>
#include <string>

namespace handway::device {

namespace {

// The sampling period is given in words of two bytes.
bool takes_words(char letter) { return letter == 'T'; }

bool append_number(std::string_view text, bool word, std::vector<std::uint8_t>& out) {
  unsigned value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || value > (word ? 65535U : 255U)) {
    return false;
  }
  if (word) {
    out.push_back(static_cast<std::uint8_t>(value >> 8U));
  }
  out.push_back(static_cast<std::uint8_t>(value));
  return true;
}

}  // namespace

std::optional<TextCommand> read_text_command(std::span<const std::uint8_t> line) {
  const std::string text(line.begin(), line.end());
  TextCommand command;
  std::size_t at = 0;
  if (text.starts_with('?')) {
    command.query = true;
    ++at;
  }
  if (at >= text.size() || std::islower(static_cast<unsigned char>(text[at])) == 0) {
    return std::nullopt;
  }
  command.letter = static_cast<char>(std::toupper(static_cast<unsigned char>(text[at])));
  ++at;
  while ((at = text.find_first_not_of(" \r\n", at)) != std::string::npos) {
    const std::size_t end = std::min(text.find_first_of(" \r\n", at), text.size());
    if (!append_number(std::string_view(text).substr(at, end - at), takes_words(command.letter),
                       command.arguments)) {
      return std::nullopt;
    }
    at = end;
  }
  return command;
}

std::vector<std::uint8_t> text_line(std::string_view line) {
  std::vector<std::uint8_t> out(line.begin(), line.end());
  out.push_back('\r');
  out.push_back('\n');
  return out;
}

std::vector<std::uint8_t> text_refusal(std::string_view code) { return text_line(code); }

std::vector<std::uint8_t> text_answer(char before, char letter,
                                      std::span<const std::uint8_t> values) {
  std::string text;
  if (before != 0) {
    text += before;
  }
  text += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  for (const std::uint8_t value : values) {
    text += ' ' + std::to_string(value);
  }
  return text_line(text);
}

}  // namespace handway::device
