#pragma once

#include "handway/geometric/export.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// Times of the rows of a table of other programs: numbers in some unit, since 1970 or since the
/// start; dates and clock times.
namespace handway::geometric {

/// The time in a cell.
struct SpelledTime {
  enum class Kind { kDate, kClock, kDateAndClock };
  Kind kind = Kind::kDate;
  double seconds = 0.0;  ///< Since 1970 (UTC), or since midnight.
};

/// Parses a cell that is a time: ISO 8601 ("2024-03-01T12:00:00.5Z", with a blank for the T, with
/// another zone), a date (also "01.03.2024" and "03/01/2024") or a clock time ("12:00:00.5",
/// "12:00:00,5", "1:00:00 PM").
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<SpelledTime> parse_time(std::string_view cell);

/// Unit of times, as a header gives it.
struct TimeUnit {
  std::optional<double> seconds = {};  ///< Length of the unit, s: 1e-3 of "t_ms" or "time [ms]".
  std::string unknown = {};            ///< A unit without a known length: "ticks".
};

/// Unit and kind of times that a column's name gives.
struct TimeName {
  enum class Kind { kTime, kDate, kSeconds, kNanoseconds };
  Kind kind = Kind::kTime;  ///< The last two are the halves of a stamp of ROS.
  TimeUnit unit = {};       ///< Empty if none is named.
  bool plain = true;        ///< The name has no other meaning.
};

/// Returns nothing if the column is not one of times by its name. Names may be German, French,
/// Spanish or Italian, too.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<TimeName> time_name(std::string_view column);

/// The columns whose sum is the time of a row: one, a date and a clock time, or the two halves of
/// a stamp.
struct TimeColumns {
  /// A column that contributes to the time.
  struct Part {
    std::size_t column = 0;
    double unit = 1.0;  ///< Factor of numbers; dates and clock times are in s.
  };
  std::vector<Part> parts;  ///< Empty: no times.
  TimeUnit unit;            ///< The named one of a single column.

  [[nodiscard]] bool has(std::size_t column) const;
};

/// Kind of a column's cells.
enum class CellContent { kOther, kNumbers, kDates, kClocks, kDatesAndClocks };

/// Returns the content of a column with such a cell.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT CellContent content_of(std::string_view cell);

/// Prefers columns whose names have no other meaning, and of several the first.
/// @param names of all columns.
/// @param contents of each.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT TimeColumns
time_columns(const std::vector<std::string>& names, const std::vector<CellContent>& contents);

/// Converts the times of a table into seconds that never fall.
///   - The unit is the named one. If none is named, its length is not known, or the values
///     contradict it, it follows from their size (of times since 1970) and their steps: rows are
///     less than 5 s apart.
///   - Times since 1970 begin at 0.
///   - A clock without a date that passes midnight continues.
///   - If time runs back, the clock was set: times run on from there by a usual step. A few rows
///     that come too late get the time of the one before.
/// @param times in the order of rows; those that are not finite stay.
/// @param unit the named one.
/// @param spelled whether they are dates or clock times, in s.
/// @param lines line of each row in the file; without them rows are counted from 1.
/// @returns warnings, in words: the unit inferred, and how often and where time ran back.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> settle_times(
    std::vector<double>& times, const TimeUnit& unit = {}, bool spelled = false,
    std::span<const std::size_t> lines = {});

}  // namespace handway::geometric
