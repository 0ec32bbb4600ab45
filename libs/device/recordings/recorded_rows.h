#pragma once

#include "glove/text_files.h"
#include "handway/device/glove/recording.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

/// Rows of a recording, collected while a text is read.

namespace handway::device {

/// Largest values: counts from 0 to, and angles in rad from minus to, this.
inline constexpr double kHighestCounts = 255.0;
inline constexpr double kWidestAngle = 2.0 * std::numbers::pi;

/// Passes every line that isn't blank to `take`, except a last one that is cut off, as a program
/// leaves that is killed while it writes: a warning names it.
/// @param is_row returns whether a line without its end is a row nevertheless.
void take_rows(const std::filesystem::path& file, const std::vector<TextLine>& lines,
               std::vector<std::string>& warnings,
               const std::function<bool(const TextLine&)>& is_row,
               const std::function<void(const TextLine&)>& take);

/// Rows collected while reading, with the common checks of all formats.
class RecordedRows {
 public:
  /// @param raw names and units of the source's columns; none: the recording keeps none.
  RecordedRows(const std::filesystem::path& file, std::size_t columns, RawColumns raw = {});

  /// @param time s, in the order of the file.
  /// @param raw values of the source's columns, NaN: missing.
  void add(const TextLine& line, double time, const std::vector<double>& values,
           const std::vector<double>& raw = {});
  /// Moves the rows into a recording. Times that run back are corrected with a warning: see
  /// geometric::settle_times(). @throws InputError if it has no rows.
  void move_to(Recording& recording);

 private:
  const std::filesystem::path& file_;
  std::size_t columns_;
  std::vector<double> times_;
  std::vector<std::size_t> lines_;  ///< Line of each row in the file.
  std::vector<double> values_;      ///< Row by row.
  RawColumns raw_;
  std::vector<double> raw_values_;  ///< Row by row.
};

}  // namespace handway::device
