#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/extensions/exporter.h"

#include <memory>
#include <vector>

namespace handway::gui {

/// A path as a motion: at even speed, measured in joints normalised to [0, 1], or, once it is
/// timed, as the robot would go it. Fractions of its duration run from 0 (first waypoint) to 1
/// (last).
class PathTimeline {
 public:
  PathTimeline() = default;
  PathTimeline(const geometric::RobotModel& model, planning::Path path);

  /// Sets the motion that playback follows from now on. @pre it is one of this path, or null: at
  /// constant speed.
  void set_motion(std::shared_ptr<const planning::Motion> motion) { motion_ = std::move(motion); }
  [[nodiscard]] const std::shared_ptr<const planning::Motion>& motion() const { return motion_; }

  [[nodiscard]] bool empty() const { return path_.empty(); }
  /// Sum of the normalised distances between waypoints.
  [[nodiscard]] double length() const { return empty() ? 0.0 : distance_.back(); }
  /// Returns the duration in real time if the path is timed; else a convenient one, s.
  [[nodiscard]] double duration() const;
  [[nodiscard]] const planning::Path& path() const { return path_; }

  /// Configuration at `fraction`, clamped to [0, 1]. @pre not empty.
  [[nodiscard]] geometric::Configuration at(double fraction) const;
  /// Returns the fraction of waypoint `index`. @pre index is one of the path's.
  [[nodiscard]] double fraction_of(std::size_t index) const;
  /// Returns the number of waypoints before `fraction`, plus the share of the motion to the next
  /// one.
  [[nodiscard]] double waypoint_at(double fraction) const;
  /// The opposite of waypoint_at().
  [[nodiscard]] double fraction_at(double waypoint) const;
  /// The waypoint next after (before) `fraction`, as a fraction; the ends stay.
  [[nodiscard]] double next_waypoint(double fraction) const;
  [[nodiscard]] double previous_waypoint(double fraction) const;

 private:
  [[nodiscard]] geometric::Configuration at_time(double time) const;

  planning::Path path_;
  std::shared_ptr<const planning::Motion> motion_;  ///< Null: at even speed.
  std::vector<double> distance_;                    ///< From the first waypoint to each.
};

/// The path of one link's origin through the world, m.
struct PalmPath {
  std::vector<Eigen::Vector3d> points;     ///< Close together, along the whole path.
  std::vector<Eigen::Vector3d> waypoints;  ///< One for each of the path's.
};

/// @param link of the robot, for example its palm.
[[nodiscard]] PalmPath palm_path(const geometric::RobotInstance& robot,
                                 const PathTimeline& timeline, int link);

}  // namespace handway::gui
