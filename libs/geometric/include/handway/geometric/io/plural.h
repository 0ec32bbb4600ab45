#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace handway::geometric {

/// Returns a count with its noun, for messages: "1 column", "2 columns".
/// @param noun in the singular; its plural adds an s.
[[nodiscard]] inline std::string plural(std::integral auto count, std::string_view noun) {
  std::string text = std::to_string(count) + ' ';
  return text.append(noun).append(count == 1 ? "" : "s");
}

}  // namespace handway::geometric
