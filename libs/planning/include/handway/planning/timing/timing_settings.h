#pragma once

#include "handway/geometric/io/parameter.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/planning/export.h"
#include "handway/planning/timing/time_path.h"

#include <vector>

namespace handway::planning {

/// Settings of timing a path that users choose, on the command line, in a form or in Python.
struct TimingSettings {
  double speed = TimingOptions{}.speed;
  double period = TimingOptions{}.period;  ///< s
  bool blend = true;                       ///< Round corners by arcs instead of stopping there.
  double deviation = BlendOptions{}.deviation;
  double arc_clearance = 1e-3;  ///< m
  bool jerk = false;
  double margin = 0.0;  ///< m
  /// Following error of joints at their velocity limit, rad or m; negative: it is assumed.
  double following_error = -1.0;

  bool operator==(const TimingSettings&) const = default;
};

/// Describes the settings.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<geometric::BoundParameter> parameters_of(
    TimingSettings& settings);

/// The options of time_path() for a robot, with its own limits.
[[nodiscard]] HANDWAY_PLANNING_EXPORT TimingOptions
timing_options(const TimingSettings& settings, const geometric::RobotModel& model);

}  // namespace handway::planning
