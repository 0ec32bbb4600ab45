#pragma once

#include "handway/geometric/export.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// Numbers in text files, and lines of cells with numbers.
namespace handway::geometric {

/// Returns the finite number that the whole of `text` spells, in any locale; surrounding blanks are
/// ignored. Nothing for anything else, NaN and infinity included.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<double> parse_number(std::string_view text);

/// The shortest text that parse_number() reads back as the same number.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string number_text(double value);

/// Trims blanks, quotes and the end of line.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string_view trimmed(std::string_view text);

/// Trimmed parts between separators; ' ' separates by any run of blanks. Separators within a fully
/// quoted cell do not count.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string_view> cells(std::string_view line,
                                                                           char separator);

/// The texts of cells() as names, which may have quotes: two in a row within a quoted cell are one.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> cell_names(std::string_view line,
                                                                           char separator);

}  // namespace handway::geometric
