#include "recordings/table_recording.h"

#include "glove/sensor_names.h"
#include "glove/text_files.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/table_times.h"
#include "handway/geometric/math/units.h"
#include "recordings/raw_table.h"
#include "recordings/recorded_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace handway::device {
namespace {

using geometric::InputError;

// A non-gap cell of a column.
double cell_of(const NumberTable& table, Eigen::Index row, const ColumnUse& use) {
  return use.gain * table.values(row, use.column) + use.offset;
}

std::string row_name(const std::filesystem::path& file, const NumberTable& table,
                     Eigen::Index row) {
  const auto index = static_cast<std::size_t>(row);
  return table.lines.empty() ? fmt::format("{}, row {}", file.string(), row + 1)
                             : fmt::format("{}:{}", file.string(), table.lines[index]);
}

/// Rows in which all used columns have values; a warning counts the others.
/// @throws InputError if a used cell is text, or if no row is complete.
std::vector<Eigen::Index> rows_without_gaps(const std::filesystem::path& file,
                                            const NumberTable& table, const TableLayout& layout,
                                            std::vector<std::string>& warnings) {
  std::vector<ColumnUse> used = layout.columns;
  used.insert(used.end(), layout.times.begin(), layout.times.end());
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < table.values.rows(); ++row) {
    for (const ColumnUse& use : used) {
      if (std::isinf(table.values(row, use.column))) {
        throw InputError({row_name(file, table, row), fmt::format("column {}", use.column + 1),
                          "no number", "a number", "Leave columns of labels out of the map."});
      }
    }
    if (std::ranges::none_of(used, [&](const ColumnUse& use) {
          return std::isnan(table.values(row, use.column));
        })) {
      rows.push_back(row);
    }
  }
  const auto left_out = static_cast<std::size_t>(table.values.rows()) - rows.size();
  if (rows.empty()) {
    throw InputError({file.string(), "", "a gap in each row", "rows of numbers",
                      "Leave columns that were not measured out of the map."});
  }
  if (left_out > 0) {
    warnings.push_back(fmt::format("{}: {} of {} rows left out, they have gaps", file.string(),
                                   left_out, table.values.rows()));
  }
  return rows;
}

bool bends(int sensor) {
  const std::string_view name = cyberglove_sensors()[static_cast<std::size_t>(sensor)].name;
  return name.ends_with("MPJ") || name.ends_with("PIJ") || name.ends_with("DIJ");
}

/// Names the row and the column of the first value beyond `most`, and the number of such values.
[[noreturn]] void refuse_widest(const std::filesystem::path& file, const NumberTable& table,
                                const TableLayout& layout, double most) {
  Eigen::Index first_row = 0;
  const ColumnUse* first = nullptr;
  Eigen::Index count = 0;
  for (Eigen::Index row = 0; row < table.values.rows(); ++row) {
    for (const ColumnUse& use : layout.columns) {
      const double value = table.values(row, use.column);
      if (std::isfinite(value) && std::abs(value) > most) {
        ++count;
        if (first == nullptr) {
          first = &use;
          first_row = row;
        }
      }
    }
  }
  const std::string value =
      first == nullptr ? "" : fmt::format("{:.6g}", table.values(first_row, first->column));
  throw InputError(
      {row_name(file, table, first_row),
       first == nullptr
           ? ""
           : std::string(cyberglove_sensors()[static_cast<std::size_t>(first->sensor)].name),
       count == 1 ? value : fmt::format("{}, and {} more values like it", value, count - 1),
       "counts from 0 to 255, or angles in rad or degrees",
       std::string(count == 1 ? "Correct the row or take it out, or write" : "Write") +
           " a map of the table's columns (YAML), with gains."});
}

/// Infers counts, rad or degrees, and the sign of bending, from the numbers.
/// @returns the inference in words.
std::string settle_numbers(const std::filesystem::path& file, const NumberTable& table,
                           TableLayout& layout) {
  double least = 0.0;
  double most = 0.0;
  bool whole = true;
  bool in_degrees = false;
  bool in_radians = false;
  int bending = 0;
  int negative = 0;
  for (const ColumnUse& use : layout.columns) {
    double sum = 0.0;
    for (const double value : table.values.col(use.column)) {
      if (std::isfinite(value)) {
        least = std::min(least, value);
        most = std::max(most, value);
        whole &= value == std::round(value);
        sum += use.gain * value;
      }
    }
    bending += bends(use.sensor) ? 1 : 0;
    negative += bends(use.sensor) && sum < 0.0 ? 1 : 0;
    if (const auto column = static_cast<std::size_t>(use.column); column < table.names.size()) {
      const std::vector<std::string> words = words_of_name(table.names[column]);
      in_degrees |= has_word(words, {"deg", "degree", "degrees"}) ||
                    table.names[column].find("\u00B0") != std::string::npos;
      in_radians |= has_word(words, {"rad", "radian", "radians"});
    }
  }
  constexpr double kMostDegrees = 360.0;
  const double widest = std::max(-least, most);
  if (whole && least >= 0.0 && most <= kHighestCounts && !in_degrees && !in_radians) {
    layout.kind = RecordingKind::kCounts;
    return "counts";
  }
  if (widest > kMostDegrees) {
    refuse_widest(file, table, layout, kMostDegrees);
  }
  in_degrees |= widest > kWidestAngle && !in_radians;
  constexpr int kEnough = 4;
  const bool turned = bending >= kEnough && 4 * negative >= 3 * bending;
  for (ColumnUse& use : layout.columns) {
    use.gain *=
        (in_degrees ? geometric::kDegree : 1.0) * (turned ? virtual_hand_sign(use.sensor) : 1.0);
  }
  return std::string(in_degrees ? "degrees" : "rad") +
         (turned ? ", bent fingers negative (turned)" : "");
}

}  // namespace

std::vector<double> times_of(const std::filesystem::path& file, const NumberTable& table,
                             const TableLayout& layout, const std::vector<Eigen::Index>& rows,
                             std::vector<std::string>& warnings) {
  std::vector<double> times;
  std::vector<std::size_t> lines;
  for (const Eigen::Index row : rows) {
    double time = layout.times.empty() ? static_cast<double>(row) / layout.rate : 0.0;
    for (const ColumnUse& use : layout.times) {
      time += cell_of(table, row, use);
    }
    times.push_back(time);
    if (!table.lines.empty()) {
      lines.push_back(table.lines[static_cast<std::size_t>(row)]);
    }
  }
  if (!layout.times.empty()) {
    const bool spelled = table.is_spelled(layout.times.front().column);
    for (const std::string& warning :
         geometric::settle_times(times, layout.time_unit, spelled, lines)) {
      warnings.push_back(fmt::format("{}: {}", file.string(), warning));
    }
  }
  return times;
}

Recording recording_of(const std::filesystem::path& file, const NumberTable& table,
                       const TableLayout& layout) {
  Recording recording;
  recording.header.kind = layout.kind;
  recording.header.origin = file.filename().string();
  for (const ColumnUse& use : layout.columns) {
    recording.header.sensors.push_back(use.sensor);
  }
  recording.warnings = table.warnings;
  const std::vector<Eigen::Index> rows = rows_without_gaps(file, table, layout, recording.warnings);
  const std::vector<double> times = times_of(file, table, layout, rows, recording.warnings);
  recording.raw = raw_columns_of_rows(table, layout, rows);
  recording.times = Eigen::VectorXd::Map(times.data(), std::ssize(times));
  recording.values.resize(recording.times.size(), static_cast<Eigen::Index>(layout.columns.size()));
  for (Eigen::Index to = 0; to < recording.times.size(); ++to) {
    const Eigen::Index row = rows[static_cast<std::size_t>(to)];
    for (std::size_t c = 0; c < layout.columns.size(); ++c) {
      const ColumnUse& use = layout.columns[c];
      const double value = cell_of(table, row, use);
      const bool counts = layout.kind == RecordingKind::kCounts;
      if (counts ? value < 0.0 || value > kHighestCounts : std::abs(value) > kWidestAngle) {
        throw InputError(
            {row_name(file, table, row),
             std::string(cyberglove_sensors()[static_cast<std::size_t>(use.sensor)].name),
             fmt::format("{:.4g}", value), counts ? "counts from 0 to 255" : "an angle in rad",
             counts ? "" : "If these are degrees, map them with \"unit: deg\"."});
      }
      recording.values(to, static_cast<Eigen::Index>(c)) = value;
    }
  }
  return recording;
}

Recording recording_by_numbers(const std::filesystem::path& file, const NumberTable& table,
                               TableLayout layout) {
  std::string taken = settle_numbers(file, table, layout) + " by its numbers";
  if (!layout.order.empty()) {
    taken += ", in the order of " + layout.order;
  }
  if (layout.times.empty()) {
    taken += fmt::format(", {:g} rows a second", layout.rate);
  }
  if (!layout.left_over.empty()) {
    taken += fmt::format("; passed over: {}", fmt::join(layout.left_over, ", "));
  }
  Recording recording = recording_of(file, table, layout);
  recording.warnings.push_back(fmt::format("{}: taken for {}", file.string(), taken));
  return recording;
}

}  // namespace handway::device
