#include "glove/text_files.h"

#include <fmt/format.h>

namespace handway::device {

std::string at_line(const std::filesystem::path& file, const TextLine& line) {
  return fmt::format("{}:{}", file.string(), line.number);
}

std::string text_field(const std::string& key, const std::string& text) {
  if (text.empty()) {
    return "";
  }
  std::string quoted;
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
    }
    quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return key + ": \"" + quoted + "\"\n";
}

}  // namespace handway::device
