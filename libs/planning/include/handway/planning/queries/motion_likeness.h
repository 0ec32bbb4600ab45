#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/planning/queries/movement_smoothness.h"
#include "handway/planning/timing/trajectory.h"
#include "handway/sampling/postures/posture_table.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <stop_token>
#include <string>
#include <variant>

namespace handway::planning {

/// Largest distances of an arm's motion from the straight one with the same ends, in joint space
/// ("rectilinear segment", paper, sections 5.1 and 7).
struct StraightDeviation {
  double arm = 0.0;  ///< Distance of the arm's joints from the segment, normalised joints.
  /// Distance of the palm from its nearest position on the straight motion of all joints, m.
  double palm = 0.0;
};

/// Error of a hand's motion reconstructed from the functional components of recorded motions
/// (sampling::MotionComponents), RMS over time and the joints that count; for sliding joints in m.
struct ComponentError {
  double error = 0.0;            ///< rad
  double recorded_median = 0.0;  ///< Median error of recorded motions, held out in turn, rad.
  double recorded_95 = 0.0;      ///< Bound of 95 % of those errors, rad.
  std::size_t motions = 0;       ///< Number of recorded motions.
  std::size_t components = 0;
};

/// Measures of a timed motion that tell it from a human one: how smooth it is, how straight, and
/// how well functions of time of recorded hands represent it. Each is empty where it doesn't apply.
struct MotionLikeness {
  double duration = 0.0;  ///< s
  std::optional<MovementSmoothness>
      hand;  ///< Smoothness of the norm of its rates in normalised joints.
  std::optional<MovementSmoothness> palm;  ///< Smoothness of the speed of the palm's origin.
  std::optional<StraightDeviation> deviation;
  std::optional<ComponentError> components;
  std::string no_components;  ///< Reason why `components` is empty, a sentence; or empty.
};

/// Times a path for motion_likeness(): jerk-limited at full speed, with smooth arcs, at a period of
/// 10 ms. Measures of smoothness need a limited jerk, which time_optimal() has not.
/// @returns the trajectory, or a sentence that says why the path can't be timed.
/// @throws InputError as certified_blends(); PreparationStopped if `stop` is requested.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::variant<Trajectory, std::string> likeness_trajectory(
    const PlanningProblem& problem, const Path& path, const std::stop_token& stop = {});

/// Measures a motion.
///
/// The hand's motion is compared with the recorded ones as sampling::whole_motion(); its joints are
/// those of the basis.
/// @param trajectory at a fixed period, but for the last point; may be empty.
/// @param recorded postures of a person; null: there are no components.
/// @pre `recorded` is of the problem's basis.
[[nodiscard]] HANDWAY_PLANNING_EXPORT MotionLikeness
motion_likeness(const PlanningProblem& problem, const Trajectory& trajectory,
                const sampling::RecordedPostures* recorded);

/// Returns the planned joints at even times from the beginning to the end of a motion, in
/// normalised joints, shape [sampling::kMotionPoints, joints]: for warped_distance().
/// @pre the trajectory is not empty.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Eigen::MatrixXd comparable_motion(
    const PlanningProblem& problem, const Trajectory& trajectory);

}  // namespace handway::planning
