#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/planning/paths/safety_clearance.h"
#include "handway/planning/timing/blended_path.h"
#include "handway/planning/timing/kinematic_limits.h"
#include "handway/planning/timing/motion_stage.h"
#include "handway/planning/timing/trajectory.h"

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::planning {

/// A timed motion, ready for export.
struct Motion {
  std::string name;  ///< Letters, digits and "_"; the first a letter: for files and programs.
  std::shared_ptr<const geometric::RobotModel> model;
  geometric::JointIndices arm;           ///< Joints of the arm, in order.
  geometric::JointIndices hand;          ///< Joints of the hand, in order.
  JointKinematicLimits limits;           ///< The robot's, at full speed.
  double speed = 1.0;                    ///< Share of full speed in (0, 1] of the timing.
  Path path;                             ///< The waypoints, …
  std::vector<double> waypoint_times;    ///< … and their times, s; shape [waypoints].
  Trajectory trajectory;                 ///< At a fixed period, but for MotionStage::waits.
  std::vector<MotionStage> stages = {};  ///< In their order, the first from waypoint 0; or none.
};

/// Returns the stage in which a motion is at `time` (s); null if it has no stages. At the border of
/// two stages it is the one that ends there.
[[nodiscard]] HANDWAY_PLANNING_EXPORT const MotionStage* stage_at(const Motion& motion,
                                                                  double time);

/// Returns the outputs that the stages of a motion set, each name and value once, in their order.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<geometric::OutputStep> outputs_of(
    const Motion& motion);

/// Options of timing a path.
struct TimingOptions {
  double speed = 1.0;     ///< In (0, 1]: slows the whole motion down.
  double period = 0.004;  ///< s between points; 4 ms is the cycle of a CS8 controller.
  BlendOptions blends;    ///< Their shape is ignored: it follows from limit_jerk.
  bool limit_jerk = false;
  JointKinematicLimits limits;    ///< If of size 0: those of the robot.
  Configuration measured_start;   ///< If of size 0: the start is not compared.
  double start_tolerance = 1e-3;  ///< rad or m, of that comparison.
  std::stop_token stop = {};      ///< Timing ends with geometric::PreparationStopped.
  SafetyMargin safety;            ///< Required clearance.
};

/// Largest share of a limit that a motion uses, and its place.
struct LimitShare {
  std::string joint;
  double time = 0.0;   ///< s
  double share = 0.0;  ///< 1: at the limit.
};

/// Results of validating a trajectory before it runs.
struct PreflightReport {
  std::vector<TrajectoryFault> faults;  ///< Empty: cleared to run.
  /// Warnings that are no faults, a sentence each: holding_warnings().
  std::vector<std::string> warnings;
  std::size_t points = 0;
  double duration = 0.0;  ///< s
  LimitShare velocity;
  LimitShare acceleration;
  double min_clearance = 0.0;         ///< m, at the points; more than 0.05 m is not distinguished.
  double min_clearance_time = 0.0;    ///< s
  std::string closest_pair;           ///< "A with B"
  std::vector<AssumedLimit> assumed;  ///< Assumed limits that it was checked against.
  /// Place where the clearance is least compared with following errors and the margin; empty:
  /// sufficient everywhere. Its `place` is a time, s.
  std::optional<ClearanceShortfall> shortfall;
  bool assumed_following_error = false;  ///< True if none was measured.

  [[nodiscard]] bool cleared() const { return faults.empty(); }
  /// Returns whether it may run, but without a safe distance from everything.
  [[nodiscard]] bool is_tight() const { return cleared() && shortfall.has_value(); }
  /// Returns whether the shortfall is between the ends of the motion, where another path can have
  /// more clearance. @pre is_tight().
  [[nodiscard]] HANDWAY_PLANNING_EXPORT bool is_under_way() const;
  /// Advice about the shortfall, a sentence. @pre is_tight().
  [[nodiscard]] HANDWAY_PLANNING_EXPORT std::string advice() const;
};

/// Checks all that is known without the robot: check_trajectory(), the start against the measured
/// one and the straight motion from there, and collisions for every configuration between the
/// points (they are followed in straight lines), with the clearance along time. A trajectory that
/// fails check_trajectory() is not checked further. The clearance of a cleared one is compared
/// with options.safety: a joint's following error is in proportion to its velocity, and decays
/// after it.
/// @param options only limits (not of size 0), measured start, the resolution of blends and safety
/// are used.
[[nodiscard]] HANDWAY_PLANNING_EXPORT PreflightReport preflight(const PlanningProblem& problem,
                                                                const Trajectory& trajectory,
                                                                const TimingOptions& options);

/// Text for display, one finding per line.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string to_text(const PreflightReport& report);

/// A JSON object: `cleared`, `verdict` ("cleared", "tight" or "not cleared"), `faults` (`joint`,
/// `time_s`, `value`, `text`), `warnings`, `points`, `duration_s`, `velocity` and `acceleration`
/// (`joint`, `time_s`, `share`), `min_clearance_mm`, `min_clearance_time_s`, `closest_pair`,
/// `assumed_limits`
/// (`joint`, `limit`: rate_name(), `value`), `shortfall` (null, or `a`, `b`, `time_s`,
/// `clearance_mm`, `needed_mm`, `following_mm`, `margin_mm`, `following_error`, `advice`),
/// `assumed_following_error`. What is no finite number is null.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string to_json(const PreflightReport& report);

/// A path made into a motion, with the results of its checks.
struct TimedPath {
  Motion motion;       ///< Only to be used if cleared().
  BlendResult blends;  ///< Its fault, if the path itself is not free.
  PreflightReport preflight;
  double least_duration = 0.0;  ///< s: no motion through the waypoints is faster at this speed.

  [[nodiscard]] bool cleared() const { return blends.path && preflight.cleared(); }
};

/// Makes a motion from a path: certified_blends(), time_optimal() or jerk_limited(), align_stops(),
/// sample(), and preflight() of the result. Neither arcs nor straight parts leave free space.
/// @param name of the motion, see Motion::name.
/// @throws InputError for waypoints that are not configurations of the robot within its limits, and
/// for options out of their ranges; PreparationStopped if the options' stop is requested.
[[nodiscard]] HANDWAY_PLANNING_EXPORT TimedPath time_path(const PlanningProblem& problem,
                                                          const Path& path, const std::string& name,
                                                          const TimingOptions& options = {});

/// `text` made a Motion::name: characters other than letters, digits or "_" become "_", and "path_"
/// is put before a text that does not begin with a letter.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string motion_name(std::string text);

}  // namespace handway::planning
