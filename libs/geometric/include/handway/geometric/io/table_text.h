#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/io/number_text.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// Lines and cells of tables of other programs.
namespace handway::geometric {

/// A line of a text file without its end.
struct TextLine {
  std::string_view text;
  std::size_t number = 0;  ///< From 1.
  bool ended = true;       ///< False for a last line without its end.
};

/// All lines of a text, as views into it.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<TextLine> text_lines(std::string_view text);

/// The separator of a line's cells: tab, semicolon or comma, the first that it has outside of
/// quotes; a blank if none, or if its commas are decimal ones.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT char separator_of(std::string_view line);

/// The number of a cell as parse_number() reads it, with a decimal comma too. Where cells are
/// separated by commas, such a cell is quoted.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<double> parse_cell(std::string_view cell);

/// The words of a column's name in small letters: runs of letters or digits; a capital after a
/// small letter begins another word ("timestampNs", "Time [µs]").
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> words_of_column(
    std::string_view name);

}  // namespace handway::geometric
