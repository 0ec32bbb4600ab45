#include "recordings/table_layout.h"

#include "glove/sensor_names.h"
#include "glove/text_files.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/io/table_times.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>

namespace handway::device {
namespace {

using geometric::InputError;

constexpr Eigen::Index kAngles = 23;           // VirtualHand's, without the last, unwired slot
constexpr Eigen::Index kAnglesWithLabel = 22;  // and without the wrist's abduction

bool rises(const Eigen::MatrixXd& values, Eigen::Index column) {
  constexpr Eigen::Index kEnough = 5;
  const Eigen::Index last = values.rows() - 1;
  return last + 1 >= kEnough &&
         (values.col(column).tail(last).array() > values.col(column).head(last).array()).all();
}

/// Columns of VirtualHand's angles, from column `first` on.
std::vector<ColumnUse> virtual_hand_columns(Eigen::Index first, Eigen::Index count) {
  std::vector<ColumnUse> columns;
  for (int sensor = 0; sensor < kGloveSensors; ++sensor) {
    const int slot = cyberglove_sensors()[static_cast<std::size_t>(sensor)].slot;
    if (slot < count) {
      columns.push_back({sensor, first + slot, virtual_hand_sign(sensor)});
    }
  }
  return columns;
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Columns by the names of their header.
/// @throws InputError if none is a sensor's, or two are of the same sensor.
TableLayout named_layout(const std::filesystem::path& file, const NumberTable& table) {
  TableLayout layout;
  layout.rate = kUsualRate;
  find_times(table, layout);
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    ColumnUse use{-1, static_cast<Eigen::Index>(c)};
    const auto column = table.values.col(use.column).array();
    if (std::ranges::count(layout.times, use.column, &ColumnUse::column) > 0) {
      continue;
    }
    const std::optional<int> sensor = sensor_by_any_name(table.names[c]);
    if (!sensor || !column.isFinite().any()) {
      if (!table.names[c].empty()) {
        layout.left_over.push_back(table.names[c]);
      }
      continue;
    }
    use.sensor = *sensor;
    if (std::ranges::count(layout.columns, *sensor, &ColumnUse::sensor) > 0) {
      throw InputError({file.string(), fmt::format("column \"{}\"", table.names[c]),
                        "a sensor for the second time", "every sensor once",
                        "Say which by a map of the table (YAML)."});
    }
    layout.columns.push_back(use);
  }
  if (layout.columns.empty()) {
    std::string advice;
    for (const std::string& name : layout.left_over) {
      advice += advice.empty() ? geometric::advise_name(name, sensor_names()) : "";
    }
    throw InputError({file.string(), "", joined(table.names),
                      "columns named as the glove's sensors",
                      advice + (advice.empty() ? "Write" : " Or write") +
                          " a map of the table's columns (YAML)."});
  }
  return layout;
}

/// Finds columns without names: 18 or 22 in the order of a glove's records, or VirtualHand's 23
/// angles, or its 22 and a label; times before them, if the first column rises all along. Labels
/// may be on either side.
TableLayout numbered_layout(const std::filesystem::path& file, const NumberTable& table) {
  const auto [first, end, times] = measured_columns(table);
  const Eigen::Index measured = end - first;
  const bool labelled = end < table.values.cols();
  const bool virtual_hand = measured == kAngles || (measured == kAnglesWithLabel && labelled);
  if (!virtual_hand && measured != 18 && measured != kGloveSensors) {
    throw InputError(
        {file.string(), "",
         fmt::format("{} {}", geometric::plural(measured + std::ssize(times), "column"),
                     table.names.empty() ? "without names" : "of which none is called as a sensor"),
         "names of sensors above them; or 18 or 22, in the order of a glove's "
         "records, or 23, VirtualHand's; or 63, x, y and z of 21 landmarks",
         "Write a map of the table's columns (YAML); handway pca --joints-of ROBOT reads "
         "tables of a robot hand's joints"});
  }
  TableLayout layout = layout_of_columns(measured, first, virtual_hand);
  layout.times = times;
  return layout;
}

}  // namespace

std::vector<ColumnUse> glove_columns(int sensors, Eigen::Index first) {
  std::vector<ColumnUse> columns;
  for (const int sensor : cyberglove_wired(sensors)) {
    columns.push_back({sensor, first + static_cast<Eigen::Index>(columns.size())});
  }
  return columns;
}

void find_times(const NumberTable& table, TableLayout& layout) {
  if (table.names.empty()) {
    return;
  }
  const geometric::TimeColumns found = geometric::time_columns(table.names, table.contents);
  for (const geometric::TimeColumns::Part& part : found.parts) {
    layout.times.push_back({-1, static_cast<Eigen::Index>(part.column), part.unit});
  }
  layout.time_unit = found.unit;
}

MeasuredColumns measured_columns(const NumberTable& table) {
  const auto is_label = [&](Eigen::Index column) {
    return table.values.col(column).array().isInf().any();
  };
  MeasuredColumns columns{0, table.values.cols(), {}};
  while (columns.end > 0 && is_label(columns.end - 1)) {
    --columns.end;
  }
  while (columns.first < columns.end && is_label(columns.first)) {
    ++columns.first;
  }
  while (columns.first < columns.end && table.is_spelled(columns.first)) {
    columns.times.push_back({-1, columns.first++});
  }
  if (columns.times.empty() && columns.first < columns.end && rises(table.values, columns.first)) {
    columns.times.push_back({-1, columns.first++});
  }
  return columns;
}

TableLayout layout_of_columns(Eigen::Index count, Eigen::Index first, bool virtual_hand) {
  TableLayout layout;
  if (virtual_hand) {
    layout.columns = virtual_hand_columns(first, count);
    layout.rate = 1.0;  // postures, rather than a motion
    layout.order = "VirtualHand, whose signs were turned";
  } else {
    layout.columns = glove_columns(static_cast<int>(count), first);
    layout.rate = kUsualRate;
    layout.order = fmt::format("a glove of {} sensors", count);
  }
  return layout;
}

TableLayout layout_of(const std::filesystem::path& file, const NumberTable& table) {
  const auto known = std::ranges::count_if(
      table.names, [](const std::string& name) { return sensor_by_any_name(name).has_value(); });
  const bool by_number =
      table.names.empty() || (known == 0 && table.values.cols() >= kAnglesWithLabel);
  return by_number ? numbered_layout(file, table) : named_layout(file, table);
}

}  // namespace handway::device
