#pragma once

#include "handway/device/haptic/force_guide.h"
#include "handway/device/haptic/haptic_device.h"
#include "handway/execution/export.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/planning/core/planning_problem.h"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::execution {

/// The curve of a robot's link along a path, and which place of the path belongs to which of
/// its points.
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

/// Goes along a path towards a place that somebody leads it to, forwards and backwards, no faster
/// than the joints may. It never leaves the path, so what was certified of the path holds.
class HANDWAY_EXECUTION_EXPORT GuidedMotion {
 public:
  /// @param velocity limits, shape [variable_count], rad/s or m/s, > 0.
  /// @throws std::invalid_argument if the path has no waypoints, or shapes differ.
  GuidedMotion(planning::Path path, Eigen::VectorXd velocity);

  /// Goes on for `dt` (s) towards `target`. @param target a place: a waypoint's index with the
  /// share of the way to the next. @returns the place where it is then.
  double advance(double target, double dt);

  [[nodiscard]] double place() const { return place_; }

 private:
  planning::Path path_;
  Eigen::VectorXd velocity_;
  std::vector<double> durations_;  ///< Of each edge, at the limits, s.
  double place_ = 0.0;
};

/// What came of one sample of a haptic device.
struct GuidanceSample {
  double time = 0.0;  ///< s since the beginning.
  device::HapticSample handle;
  device::GuideStep step;
  double place = 0.0;          ///< Where on its path the robot is led to.
  geometric::Configuration q;  ///< The robot there.
};

/// How a guidance ended.
struct GuidanceOutcome {
  bool arrived = false;  ///< At the path's end.
  std::string fault;     ///< Why not; empty if it was asked to stop.
  double time = 0.0;     ///< s
  int samples = 0;
  double largest_deviation = 0.0;  ///< Of the hand from the curve, m.
  double strongest = 0.0;          ///< Force that was asked for, N.
};

/// What else takes part in a guidance; both are called on its thread. What they throw is a fault
/// and ends the guidance: no force then, and the robot rests where it was led to last.
struct GuidanceListeners {
  std::function<void(const GuidanceSample&)> on_sample = [](const GuidanceSample&) {};
  /// Leads a robot to a configuration; called every 50 ms.
  std::function<void(const geometric::Configuration&)> lead = [](const geometric::Configuration&) {
  };
};

/// Guides a hand along a path, and leads the robot where the hand is, until it is at the end, is
/// asked to stop, or something goes wrong. However it ends, there is no force then.
/// @param device connected. @param guide of curve.curve(). @param motion on curve.path().
[[nodiscard]] HANDWAY_EXECUTION_EXPORT GuidanceOutcome
run_guidance(device::HapticDevice& device, device::ForceGuide& guide, const PathToolCurve& curve,
             GuidedMotion& motion, const std::stop_token& stop, const GuidanceListeners& listeners);

}  // namespace handway::execution
