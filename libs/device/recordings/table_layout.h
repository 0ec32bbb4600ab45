#pragma once

#include "handway/device/glove/recording.h"
#include "handway/geometric/io/table_times.h"
#include "recordings/number_table.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace handway::device {

/// Use of a column.
struct ColumnUse {
  int sensor = -1;
  Eigen::Index column = 0;
  double gain = 1.0;  ///< value · gain + offset is counts, or rad with flexion positive.
  double offset = 0.0;
};

/// Layout of a table of postures.
struct TableLayout {
  RecordingKind kind = RecordingKind::kAngles;
  std::vector<ColumnUse> columns;
  std::vector<ColumnUse> times;        ///< Their sum is the time; may be empty.
  geometric::TimeUnit time_unit;       ///< The named one.
  double rate = 1.0;                   ///< Hz, without times.
  std::string order;                   ///< Order of columns without names; may be empty.
  std::vector<std::string> left_over;  ///< Names of columns that don't belong to the glove.
};

/// Rate of a glove's table without times, Hz.
inline constexpr double kUsualRate = 100.0;

/// The columns between labels on either side; times before them are dates and clock times, or
/// numbers that rise all along.
struct MeasuredColumns {
  Eigen::Index first = 0;  ///< Behind the times.
  Eigen::Index end = 0;
  std::vector<ColumnUse> times;
};
[[nodiscard]] MeasuredColumns measured_columns(const NumberTable& table);

/// Finds the columns of times by their names.
void find_times(const NumberTable& table, TableLayout& layout);

/// Columns in the order of a glove's records, from column `first` on.
/// @param sensors 18 or 22.
[[nodiscard]] std::vector<ColumnUse> glove_columns(int sensors, Eigen::Index first);

/// Columns of a glove without names, from column `first` on.
/// @param count 18 or 22, in the order of a glove's records; or VirtualHand's.
/// @param virtual_hand whether they are VirtualHand's 23 angles, or its first 22.
[[nodiscard]] TableLayout layout_of_columns(Eigen::Index count, Eigen::Index first,
                                            bool virtual_hand);

/// The columns by the names of their header; without such names by their number, as a glove's or
/// VirtualHand's.
/// @throws InputError if they are neither.
[[nodiscard]] TableLayout layout_of(const std::filesystem::path& file, const NumberTable& table);

}  // namespace handway::device
