#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/planning/paths/path.h"

#include <vector>

namespace handway::gui {

/// A path as a motion at even speed, measured in joints normalised to [0, 1].
/// Fractions run from 0 (first waypoint) to 1 (last).
class PathTimeline {
 public:
  PathTimeline() = default;
  PathTimeline(const geometric::RobotModel& model, planning::Path path);

  [[nodiscard]] bool empty() const { return path_.empty(); }
  /// Sum of the normalised distances between waypoints.
  [[nodiscard]] double length() const { return empty() ? 0.0 : distance_.back(); }
  [[nodiscard]] const planning::Path& path() const { return path_; }

  /// Configuration at `fraction`, clamped to [0, 1]. @pre not empty.
  [[nodiscard]] geometric::Configuration at(double fraction) const;
  /// Where waypoint `index` lies. @pre index is one of the path's.
  [[nodiscard]] double fraction_of(std::size_t index) const;
  /// The waypoint next after (before) `fraction`, as a fraction; the ends stay.
  [[nodiscard]] double next_waypoint(double fraction) const;
  [[nodiscard]] double previous_waypoint(double fraction) const;

 private:
  planning::Path path_;
  std::vector<double> distance_;  ///< From the first waypoint to each.
};

}  // namespace handway::gui
