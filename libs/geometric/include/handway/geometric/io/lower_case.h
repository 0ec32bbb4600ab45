#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace handway::geometric {

/// Returns a text in lower case: ASCII letters in the "C" locale, other bytes as they are.
[[nodiscard]] inline std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace handway::geometric
