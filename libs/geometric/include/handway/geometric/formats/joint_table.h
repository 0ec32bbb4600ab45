#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/io/table_times.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// Values of a robot's joints over time, as its driver, a simulation, a plotter or a data set
/// writes them: the common part of recordings of a hand's joints and files of paths.
namespace handway::geometric {

/// Function from a joint's exact name to its number; nothing for joints that were not requested.
using JointLookup = std::function<std::optional<int>(std::string_view)>;

/// Rows in file order, with gaps.
struct JointTable {
  using ColumnCounts = std::vector<int>;

  /// A cell of a joint that is not a number.
  struct BadCell {
    std::size_t line = 0;
    std::string column;
    std::string text;
  };

  std::vector<double> times;            ///< Times in the file; NaN: missing. For settle_times().
  TimeUnit time_unit;                   ///< The named unit of times.
  bool times_are_spelled = false;       ///< Times are dates or clock times.
  std::vector<Eigen::VectorXd> values;  ///< rad, m, or the file's unit; NaN: missing.
  std::vector<std::size_t> lines;       ///< Line of each row; empty for messages.
  std::set<std::string> others;         ///< Columns and joints that were not requested.
  ColumnCounts columns;                 ///< Number of columns of each joint.
  std::optional<BadCell> bad_cell;      ///< The first one.
  bool units_are_named = false;         ///< Columns name their unit; degrees were converted.
  bool holds = false;                   ///< Missing values repeat the row before.
  bool is_cut_off = false;              ///< The last row or message was incomplete.
};

/// Reads such a file. The content decides its kind:
///   - a table of text with the joints' names above the columns, alone or in a longer name:
///     "pan", "pan_pos", "pan [deg]", "/joint_states/pan/position". Values are converted from the
///     unit of position_unit(). Velocities and efforts are ignored. Times are found by
///     time_columns();
///   - tables whose rows contain the names, as `rostopic echo -p` and `ros2 topic echo --csv`
///     write them, or lists of names and positions in two cells;
///   - sensor_msgs/JointState messages, one after the other as `ros2 topic echo` prints them, as
///     lines of JSON or in a list; or a trajectory_msgs/JointTrajectory.
/// @param count of the joints that `lookup` knows.
/// @param what what the file should be, for messages.
/// @throws InputError for a row or message with different numbers of names and values, and for a
/// column of a joint in an unknown unit.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT JointTable
read_joint_table(const std::filesystem::path& file, const JointLookup& lookup, int count,
                 const std::string& what);

/// Returns the joint whose positions are in a column of this name.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<int> joint_of_column(const JointLookup& lookup,
                                                                          std::string_view column);

/// Unit of a column of positions.
struct PositionUnit {
  double factor = 1.0;    ///< Factor of its values to rad or m.
  bool is_angle = false;  ///< It is named, and one of angles.
};

/// Returns the unit that a column's name has beyond the joint's own name: degrees of "pan [deg]".
/// @param where file and line, for messages.
/// @throws InputError for another unit in brackets, such as "pan [ticks]".
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT PositionUnit position_unit(const JointLookup& lookup,
                                                                  std::string_view column,
                                                                  const std::string& where);

/// Returns whether a file with the beginning `head` has ROS joint states, as YAML or JSON.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool has_joint_messages(std::string_view head);

}  // namespace handway::geometric
