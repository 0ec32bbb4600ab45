#include "recordings/joint_series.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/plural.h"
#include "recordings/array_recording.h"
#include "recordings/topic_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string_view>

namespace handway::device {
namespace {

using geometric::InputError;
using geometric::JointTable;

constexpr double kMissingJoint = std::numeric_limits<double>::quiet_NaN();

int joints_named(const std::vector<std::string>& names, const WantedJoints& joints) {
  std::set<int> found;
  for (const std::string& name : names) {
    if (const std::optional<int> joint = geometric::joint_of_column(joints.lookup, name)) {
      found.insert(*joint);
    }
  }
  return static_cast<int>(found.size());
}

bool is_table(const RecordingVariable& variable) {
  return variable.problem.empty() && variable.type != kText && variable.shape.size() == 2 &&
         variable.shape.front() > 1;
}

/// Returns whether a name is one of positions, as data sets use it.
bool names_positions(const std::string& name) {
  constexpr std::array<std::string_view, 8> kPositions{
      "qpos",           "q",         "joint_pos", "joint_positions",
      "joint_position", "positions", "position",  "state"};
  const std::string leaf = name.substr(name.find_last_of("/.") + 1);
  return std::ranges::any_of(kPositions, [&](std::string_view known) {
    return leaf == known || (known.size() > 1 && leaf.ends_with(fmt::format("_{}", known)));
  });
}

/// Those that fit a condition; all if none does.
template <typename Condition>
std::vector<RecordingVariable> preferred(const std::vector<RecordingVariable>& all,
                                         const Condition& condition) {
  std::vector<RecordingVariable> fitting;
  std::ranges::copy_if(all, std::back_inserter(fitting), condition);
  return fitting.empty() ? all : fitting;
}

std::vector<RecordingVariable> positions_first(const std::vector<RecordingVariable>& all) {
  return preferred(
      preferred(all,
                [](const RecordingVariable& variable) {
                  return variable.type == "sensor_msgs/msg/JointState" ||
                         variable.type == "sensor_msgs/JointState";
                }),
      [](const RecordingVariable& variable) { return names_positions(variable.name); });
}

/// The only one of some variables, of which `columns` are taken as an example.
std::string only_of(const ArrayFile& arrays, const std::vector<RecordingVariable>& fitting,
                    const std::string& expected, std::size_t columns) {
  return only_variable(arrays, fitting, expected, [columns](const std::string& name) {
    return fmt::format("Choose a variable by FILE#{0}, and columns of it by FILE#{0}[0:{1}].", name,
                       columns);
  });
}

/// The joint of each column. @throws InputError if columns have no names and another number.
std::vector<std::optional<int>> joints_of_columns(const ArrayFile& arrays, const Series& series,
                                                  const WantedJoints& joints,
                                                  std::vector<std::string>& warnings) {
  std::vector<std::optional<int>> found;
  for (const std::string& name : series.names) {
    found.push_back(geometric::joint_of_column(joints.lookup, name));
  }
  if (series.names.empty()) {
    const Eigen::Index columns = series.values.cols();
    if (columns != joints.count) {
      throw InputError(
          {arrays.path().string(), "variable " + series.variable.name,
           geometric::plural(columns, "column") + " without names",
           fmt::format("{}, in the order of the joints of {}", joints.count, joints.robot),
           fmt::format("Choose columns by FILE#{}[0:{}].", series.variable.name, joints.count)});
    }
    for (int joint = 0; joint < joints.count; ++joint) {
      found.emplace_back(joint);
    }
    warnings.push_back(
        fmt::format("columns of {} have no names: they are taken in the order of "
                    "the joints of {}",
                    series.variable.name, joints.robot));
  }
  return found;
}

}  // namespace

std::vector<RecordingVariable> joint_variables(const ArrayFile& arrays,
                                               const WantedJoints& joints) {
  std::vector<RecordingVariable> named;
  std::vector<RecordingVariable> counted;
  int most = 1;
  for (const RecordingVariable& variable : arrays.variables()) {
    if (!is_table(variable)) {
      continue;
    }
    const std::vector<std::string> names = arrays.column_names(variable);
    const int found = joints_named(names, joints);
    if (found > most) {
      named.clear();
      most = found;
    }
    if (found == most) {
      named.push_back(variable);
    } else if (names.empty() && columns_of(variable) == static_cast<std::size_t>(joints.count)) {
      counted.push_back(variable);
    }
  }
  return positions_first(without_raw(named.empty() ? counted : named));
}

JointTable read_joint_series(const ArrayFile& arrays, const std::string& variable,
                             const WantedJoints& joints, std::vector<std::string>& warnings) {
  const Series series = arrays.series(
      variable.empty()
          ? only_of(arrays, joint_variables(arrays, joints),
                    fmt::format("one variable with columns named as joints of {}, or with {} "
                                "columns",
                                joints.robot, joints.count),
                    static_cast<std::size_t>(joints.count))
          : variable);
  const std::vector<std::optional<int>> columns =
      joints_of_columns(arrays, series, joints, warnings);
  warnings.insert(warnings.end(), series.warnings.begin(), series.warnings.end());
  JointTable table;
  table.time_unit = series.time_unit;
  table.columns.assign(static_cast<std::size_t>(joints.count), 0);
  std::vector<geometric::PositionUnit> units(columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c]) {
      if (!series.names.empty()) {
        units[c] = geometric::position_unit(joints.lookup, series.names[c], arrays.path().string());
        table.units_are_named |= units[c].is_angle;
      }
      ++table.columns[static_cast<std::size_t>(*columns[c])];
    } else {
      table.others.insert(series.names[c]);
    }
  }
  for (Eigen::Index row = 0; row < series.values.rows(); ++row) {
    const auto index = static_cast<std::size_t>(row);
    table.times.push_back(index < series.times.size() ? series.times[index] : kMissingJoint);
    Eigen::VectorXd& values =
        table.values.emplace_back(Eigen::VectorXd::Constant(joints.count, kMissingJoint));
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const double value = series.values(row, static_cast<Eigen::Index>(c));
      if (columns[c] && std::isnan(values[*columns[c]]) && std::isfinite(value)) {
        values[*columns[c]] = value * units[c].factor;
      }
    }
  }
  return table;
}

std::string only_table(const ArrayFile& arrays) {
  std::vector<RecordingVariable> tables;
  std::ranges::copy_if(arrays.variables(), std::back_inserter(tables),
                       [](const RecordingVariable& variable) {
                         return is_table(variable) && columns_of(variable) > 1;
                       });
  tables = preferred(
      tables, [](const RecordingVariable& variable) { return !is_pose_type(variable.type); });
  return only_of(arrays, positions_first(without_raw(tables)), "one table of numbers", 7);
}

}  // namespace handway::device
