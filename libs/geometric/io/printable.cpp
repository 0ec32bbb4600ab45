#include "handway/geometric/io/printable.h"

#include <fmt/format.h>

#include <cstddef>

namespace handway::geometric {
namespace {

/// A character and its number of bytes; 0xFFFD for an invalid byte.
struct Character {
  char32_t code = 0;
  std::size_t size = 1;
};

Character character_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[at + i]); };
  constexpr char32_t kNone = 0xFFFD;
  const unsigned first = byte(0);
  if (first < 0x80) {
    return {first, 1};
  }
  const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || at + size > text.size()) {
    return {kNone, 1};
  }
  char32_t code = first & (0xFFU >> (size + 1));
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) {
      return {kNone, 1};
    }
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  return {code, size};
}

bool is_control(char32_t code) {
  const bool lower = code < 0x20 && code != '\t' && code != '\n';
  const bool upper = code >= 0x7F && code < 0xA0;
  const bool direction = code == 0x061C || code == 0x200E || code == 0x200F ||
                         (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
  const bool line = code == 0x2028 || code == 0x2029;
  return lower || upper || direction || line;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const Character character = character_at(text, at);
    if (is_control(character.code) || (character.code == 0xFFFD && character.size == 1)) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(character.code));
    } else {
      result += text.substr(at, character.size);
    }
    at += character.size;
  }
  return result;
}

}  // namespace handway::geometric
