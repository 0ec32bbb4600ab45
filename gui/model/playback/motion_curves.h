#pragma once

#include "handway/planning/core/exporter.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/paths/path.h"
#include "handway/sampling/postures/recorded_postures.h"

#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::gui {

/// A path with times, or why it can't have any.
struct PathMotion {
  std::shared_ptr<const planning::Motion> motion;  ///< Null if there is a fault.
  std::string fault;                               ///< A sentence.
};

/// The path as a robot goes it that is as fast as its joints allow, with arcs where they are free.
/// @throws geometric::InputError for waypoints that are no configurations of the robot.
[[nodiscard]] PathMotion motion_of(const planning::PlanningProblem& problem,
                                   const planning::Path& path);

/// What the points of a motion have beside joints; all of shape [points].
struct MotionCurves {
  /// m, at most kMostClearance; empty, as `closest` is, where only hands are looked at.
  std::vector<double> clearance;
  std::vector<std::string> closest;  ///< "A with B", empty where nothing is near.
  /// How human the hand looks, see planning::HandLikeness; empty: nothing to compare with.
  std::vector<double> to_subspace;
  std::vector<double> to_recorded;
};

/// More clearance (m) is not told apart.
inline constexpr double kMostClearance = 0.1;

/// @param postures of a person, may be null.
/// @param stop ends it early; what it returns then is of no use.
[[nodiscard]] MotionCurves motion_curves(
    const planning::PlanningProblem& problem,
    const std::shared_ptr<const sampling::RecordedPostures>& postures,
    const planning::Trajectory& trajectory, const std::stop_token& stop);

/// The same without clearance, which takes nearly all of the time.
[[nodiscard]] MotionCurves hand_curves(
    const planning::PlanningProblem& problem,
    const std::shared_ptr<const sampling::RecordedPostures>& postures,
    const planning::Trajectory& trajectory, const std::stop_token& stop);

}  // namespace handway::gui
