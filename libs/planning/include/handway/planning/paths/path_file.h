#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

#include <filesystem>
#include <string>
#include <vector>

namespace handway::planning {

/// A path as CSV: a header "time" and the names of all moving joints, coupled ones included; then
/// one row per waypoint, seconds and rad (or m). Numbers are the shortest that read back to the
/// same bits, times as csv_time().
///
/// A polyline has no timing of its own: waypoints are spaced so that the slowest
/// joint of each stretch runs at its velocity limit (1 rad/s where it has none).
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string to_csv(const Path& path,
                                                         const geometric::RobotModel& model);

/// Seconds in files: rounded to nanoseconds, the shortest text that reads back to that ("0.036",
/// not the "0.036000000000000004" of a sum).
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string csv_time(double time);

/// Replaces `file` with to_csv(). @throws InputError if it can't be written.
HANDWAY_PLANNING_EXPORT void write_path_csv(const Path& path, const geometric::RobotModel& model,
                                            const std::filesystem::path& file);

/// Joints that a path's file lacks, as the file of an arm's controller lacks the hand's.
struct JointsAtRest {
  geometric::Configuration q;           ///< Their values: those of the start.
  std::vector<std::string> names = {};  ///< Their names.
  /// Jumps of continuous joints by about a whole turn, which were replaced by the short rotation:
  /// one for each joint, as "joint J jumps by -356° after waypoint 2".
  std::vector<std::string> jumps = {};
  std::vector<std::string> passed_over = {};  ///< Columns and names of no moving joint.

  /// A sentence that names file, joints (of many the first), jumps and ignored columns, without a
  /// full stop; empty if the file has all joints and nothing else, and no jump.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT std::string remark(const std::filesystem::path& file) const;
};

/// Returns whether a file is more likely such a table or message than anything else, by its name or
/// its beginning. False if it can't be read.
[[nodiscard]] HANDWAY_PLANNING_EXPORT bool is_path_file(const std::filesystem::path& file);

/// Reads tables by geometric::read_joint_table(): paths of this program, and tables of robots,
/// plotters and data sets. Columns may come in any order. Those of times, velocities and of
/// anything but joints are ignored, unless their name is a misspelling of a missing joint. The
/// columns of coupled joints may be missing; if present, they must agree with the coupling within
/// 1e-4, and determine the joint that they follow if it has no column. Angles are in rad; columns
/// may name degrees ("pan [deg]").
///
/// A trajectory_msgs/JointTrajectory as YAML or JSON, also within other messages, is a path through
/// its positions. Names of other joints are ignored as other columns are.
///
/// Continuous joints go from each waypoint to the next by at most half a turn: recordings that keep
/// angles within ±π jump there. A longer rotation gets waypoints between.
/// @param rest set to the missing joints; without it every joint must be in the file.
/// @throws InputError naming line and column or element for anything else, and for angles that are
/// beyond limits but look like degrees.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Path read_path(const geometric::RobotModel& model,
                                                     const std::filesystem::path& file,
                                                     JointsAtRest* rest = nullptr);

}  // namespace handway::planning
