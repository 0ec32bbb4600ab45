#pragma once

#include "glove/text_files.h"
#include "handway/device/glove/raw_columns.h"
#include "handway/geometric/io/table_times.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace handway::device {

/// A cell without a measurement.
inline constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
/// A cell of text, such as a label.
inline constexpr double kWord = std::numeric_limits<double>::infinity();

/// Numbers in rows, kGap or kWord for other cells.
struct NumberTable {
  std::vector<std::string> names;  ///< Names of columns; empty without a header.
  Eigen::MatrixXd values;          ///< Numbers; dates and clock times in s.
  std::vector<std::size_t> lines;  ///< Line of each row in the file; empty: the row's own number.
  std::vector<std::string> warnings;
  std::vector<geometric::CellContent> contents = {};  ///< Kinds of columns; empty: all numbers.
  /// Columns from which those of the table were derived, a row for each; nothing: the table is the
  /// source itself.
  std::optional<RawColumns> raw = {};

  [[nodiscard]] bool is_spelled(Eigen::Index column) const;
};

/// The table in the lines of a text, without titles above it and remarks.
/// @param skip lines before the table.
/// @param separator nothing: that of its last whole line.
/// @throws InputError if it has no rows, or rows of different lengths.
[[nodiscard]] NumberTable read_text_table(const std::filesystem::path& file,
                                          std::span<const TextLine> all, int skip = 0,
                                          std::optional<char> separator = {});

}  // namespace handway::device
