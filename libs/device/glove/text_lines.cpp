#include "text_lines.h"

namespace handway::device {

std::vector<TextLine> text_lines(std::string_view text) {
  std::vector<TextLine> lines;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = text.find('\n', begin);
    const bool ended = end != std::string_view::npos;
    lines.push_back({text.substr(begin, ended ? end - begin : end), lines.size() + 1, ended});
    begin = ended ? end + 1 : text.size();
  }
  return lines;
}

}  // namespace handway::device
