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

/// Returns the text in brackets at the end of a column's name, in small letters: "deg/s" of
/// "pan [deg/s]". Empty without brackets.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string unit_in_brackets(std::string_view name);

/// Returns a name as a cell of a table with commas, which cell_names() reads back: quoted if it has
/// a separator, a quote or a line end, or begins as a formula does. Line ends become blanks.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string csv_cell(const std::string& name);

/// Appends the units in a row below the names of columns to these names, as "pan [deg]".
/// @returns whether the row has a unit, and nothing but units and empty cells, for each column;
/// otherwise the names are unchanged.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool append_units(std::vector<std::string>& names,
                                                         const std::vector<std::string_view>& row);

}  // namespace handway::geometric
