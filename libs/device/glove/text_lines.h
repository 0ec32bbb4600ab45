#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace handway::device {

/// A line of a text file without its end.
struct TextLine {
  std::string_view text;
  std::size_t number = 0;  ///< From 1.
  bool ended = true;       ///< False for a last line without its end.
};

/// All lines of a text, of which they stay a part.
[[nodiscard]] std::vector<TextLine> text_lines(std::string_view text);

}  // namespace handway::device
