#pragma once

#include <optional>
#include <string_view>
#include <vector>

/// Pieces of text files with numbers.
namespace handway::device {

/// Without blanks, quotes and the end of line around it.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Trimmed parts between separators; ' ' separates by any run of blanks.
[[nodiscard]] std::vector<std::string_view> cells(std::string_view line, char separator);

/// The finite number that the whole cell is, or nothing.
[[nodiscard]] std::optional<double> finite_number(std::string_view cell);

}  // namespace handway::device
