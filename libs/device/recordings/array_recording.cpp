#include "recordings/array_recording.h"

#include "glove/sensor_names.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/table_times.h"
#include "recordings/landmark_recording.h"
#include "recordings/mano_recording.h"
#include "recordings/series_table.h"
#include "recordings/table_layout.h"
#include "recordings/table_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace handway::device {
namespace {

using geometric::InputError;

constexpr Eigen::Index kVirtualHandAngles = 23;

bool has_glove_columns(std::size_t columns) {
  return columns == 18 || columns == kGloveSensors || columns == kVirtualHandAngles;
}

bool is_recordable(const ArrayFile& arrays, const RecordingVariable& variable) {
  if (!variable.problem.empty() || variable.type == kText || variable.shape.size() < 2 ||
      variable.shape.front() < 2) {
    return false;
  }
  if (has_landmarks(variable)) {
    return true;
  }
  const std::vector<std::string> names = arrays.column_names(variable);
  return names.empty() ? has_glove_columns(columns_of(variable)) : are_sensors(names);
}

/// The variable to read. @throws InputError if it is not clear.
std::string chosen_variable(const ArrayFile& arrays) {
  return only_variable(
      arrays, recordable_variables(arrays),
      "one array of a glove (18, 22 or 23 columns, or columns named as its sensors), of landmarks "
      "(n x 21 x 3, or n x 63) or of postures of MANO (n x 45, or n x 48)",
      choose_advice);
}

Recording recording_of_landmarks(const std::filesystem::path& file, const Series& series) {
  std::vector<double> times = series.times;
  std::vector<std::string> warnings = series.warnings;
  for (const std::string& warning : geometric::settle_times(times, series.time_unit)) {
    warnings.push_back(fmt::format("{}: {}", file.string(), warning));
  }
  std::vector<SeenHand> hands;
  for (Eigen::Index row = 0; row < series.values.rows(); ++row) {
    SeenHand& hand = hands.emplace_back();
    for (Eigen::Index i = 0; i < series.values.cols(); ++i) {
      hand.points(i % 3, i / 3) = series.values(row, i);
    }
    if (const auto index = static_cast<std::size_t>(row);
        index < times.size() && std::isfinite(times[index])) {
      hand.time = times[index];
    }
  }
  Recording recording = recording_of_hands(file, hands, {1.0});
  recording.warnings.insert(recording.warnings.begin(), warnings.begin(), warnings.end());
  return recording;
}

TableLayout layout_of_series(const std::filesystem::path& file, const Series& series) {
  TableLayout layout;
  NumberTable table = table_of(series);
  const Eigen::Index columns = series.values.cols();
  const bool timed = !series.times.empty();
  if (timed && series.names.empty() && has_glove_columns(static_cast<std::size_t>(columns))) {
    layout = layout_of_columns(columns, 0, columns == kVirtualHandAngles);
  } else {
    if (timed) {  // the times are known: columns are measurements
      table.values.conservativeResize(Eigen::NoChange, columns);
      table.names.resize(series.names.size());
      table.contents.pop_back();
    }
    layout = layout_of(file, table);
  }
  if (timed) {
    layout.times = time_columns_of(series);
    layout.time_unit = series.time_unit;
  }
  return layout;
}

}  // namespace

bool are_sensors(const std::vector<std::string>& names) {
  const auto known = std::ranges::count_if(
      names, [](const std::string& name) { return sensor_by_any_name(name).has_value(); });
  return known > 0 && 2 * known >= std::ssize(names);
}

std::string choose_advice(const std::string& variable) {
  return fmt::format(
      "Choose a variable by FILE#{0}, columns of it by FILE#{0}[0:22], or name it and its columns "
      "in a map (YAML). "
      "handway pca --joints-of ROBOT reads the joints of a robot hand.",
      variable);
}

std::vector<RecordingVariable> recordable_variables(const ArrayFile& arrays) {
  std::vector<RecordingVariable> fitting;
  std::ranges::copy_if(
      arrays.variables(), std::back_inserter(fitting),
      [&](const RecordingVariable& variable) { return is_recordable(arrays, variable); });
  if (fitting.empty()) {  // trackers often write landmarks, which are measured, beside parameters
    std::ranges::copy_if(arrays.variables(), std::back_inserter(fitting),
                         [&](const RecordingVariable& variable) {
                           return variable.problem.empty() && variable.shape.size() > 1 &&
                                  variable.shape.front() > 1 && has_mano_poses(arrays, variable);
                         });
  }
  return without_raw(fitting);
}

Recording read_array_recording(const ArrayFile& arrays, const std::string& variable) {
  const Series series = arrays.series(variable.empty() ? chosen_variable(arrays) : variable);
  const std::filesystem::path& file = arrays.path();
  if (series.values.rows() == 0) {
    throw InputError(
        {file.string(), "variable " + series.variable.name, "no rows", "at least one", ""});
  }
  if (has_landmarks(series.variable)) {
    return recording_of_landmarks(file, series);
  }
  if (has_mano_poses(arrays, series.variable)) {
    return recording_of_mano(arrays, series);
  }
  NumberTable table = table_of(series);
  table.raw = arrays.raw_columns(series.variable);
  if (table.raw && table.raw->values.rows() != table.values.rows()) {
    table.raw.reset();
  }
  return recording_by_numbers(file, table, layout_of_series(file, series));
}

}  // namespace handway::device
