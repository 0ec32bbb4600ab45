#pragma once

#include "handway/device/haptic/force_guide.h"
#include "handway/execution/export.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/planning/core/path.h"

#include <memory>
#include <string>
#include <vector>

namespace handway::execution {

/// The way that a robot's link goes along a path, and which place of the path belongs to which of
/// the way.
///
/// A place of a path is a waypoint's index with the share of the way to the next: 2.5 is in the
/// middle of the third edge.
class HANDWAY_EXECUTION_EXPORT PathToolCurve {
 public:
  /// @param link that is looked at.
  /// @throws InputError if the path has no waypoints, or one of another size, or the robot has no
  /// such link.
  PathToolCurve(const std::shared_ptr<const geometric::RobotModel>& model, planning::Path path,
                const std::string& link);

  [[nodiscard]] const planning::Path& path() const { return path_; }
  /// m, in the frame of the robot's base.
  [[nodiscard]] const std::shared_ptr<const device::ToolCurve>& curve() const { return curve_; }

  /// The place of the path where the link is at `s` (m of the curve). Where the link stands while
  /// other joints move, the last such place.
  [[nodiscard]] double place_at(double s) const;
  /// Where the link is at this place, m of the curve.
  [[nodiscard]] double arc_length_at(double place) const;
  [[nodiscard]] geometric::Configuration configuration(double place) const;
  [[nodiscard]] double last_place() const { return places_.back(); }

 private:
  planning::Path path_;
  std::shared_ptr<const device::ToolCurve> curve_;
  std::vector<double> places_;  ///< Of the curve's points, rising.
};

/// The link that a haptic device stands for: the last of the arm, or the robot's last link.
/// @param arm variables of the arm, in order.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT std::string tool_link(const geometric::RobotModel& model,
                                                             const std::vector<int>& arm);

}  // namespace handway::execution
