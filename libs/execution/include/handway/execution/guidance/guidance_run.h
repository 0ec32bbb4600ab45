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

/// The curve of a robot's link along a path, with a mapping between arc lengths on the curve and
/// places on the path.
///
/// A place on a path is the index of a waypoint plus the fraction of the edge to the next: 2.5 is
/// the middle of the third edge.
class HANDWAY_EXECUTION_EXPORT PathToolCurve {
 public:
  /// @param link name of the link.
  /// @throws InputError if the path has no waypoints, or one of another size, or the robot has no
  /// such link.
  PathToolCurve(const std::shared_ptr<const geometric::RobotModel>& model, planning::Path path,
                const std::string& link);

  [[nodiscard]] const planning::Path& path() const { return path_; }
  /// The link's curve in the frame of the robot's base, m.
  [[nodiscard]] const std::shared_ptr<const device::ToolCurve>& curve() const { return curve_; }

  /// Returns the place on the path at arc length `s` (m) of the curve. If the link is at rest there
  /// while joints move, returns the last such place.
  [[nodiscard]] double place_at(double s) const;
  /// Returns the arc length of the curve at a place on the path, m.
  [[nodiscard]] double arc_length_at(double place) const;
  [[nodiscard]] geometric::Configuration configuration(double place) const;
  [[nodiscard]] double last_place() const { return places_.back(); }

 private:
  planning::Path path_;
  std::shared_ptr<const device::ToolCurve> curve_;
  std::vector<double> places_;  ///< Places of the curve's points, ascending.
};

/// Returns the name of the link that a haptic device guides: the arm's last, or the robot's last
/// without an arm. @param arm variables of the arm.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT std::string tool_link(const geometric::RobotModel& model,
                                                             const geometric::JointIndices& arm);

/// Moves along a path towards a guided place, forwards and backwards, within the velocity limits of
/// the joints. The motion never leaves the path, so everything certified for the path holds.
class HANDWAY_EXECUTION_EXPORT GuidedMotion {
 public:
  /// @param velocity limits, shape [variable_count], rad/s or m/s, > 0.
  /// @throws std::invalid_argument if the path has no waypoints, or shapes differ.
  GuidedMotion(planning::Path path, Eigen::VectorXd velocity);

  /// Moves towards `target` for `dt` (s). @param target place on the path: the index of a waypoint
  /// plus the fraction of the edge to the next. @returns the place reached.
  double advance(double target, double dt);

  [[nodiscard]] double place() const { return place_; }

 private:
  planning::Path path_;
  Eigen::VectorXd velocity_;
  std::vector<double> durations_;  ///< Duration of each edge at the velocity limits, s.
  double place_ = 0.0;
};

/// State of a guidance after one sample of the haptic device.
struct GuidanceSample {
  double time = 0.0;  ///< Time since the beginning, s.
  device::HapticSample handle;
  device::GuideStep step;
  double place = 0.0;          ///< Place on the path to which the robot is guided.
  geometric::Configuration q;  ///< Configuration of the robot at that place.
};

/// Result of a guidance.
struct GuidanceOutcome {
  bool arrived = false;  ///< The end of the path was reached.
  std::string fault;     ///< Message of the fault that ended the guidance; empty: none.
  double time = 0.0;     ///< Time of the last sample, s.
  int samples = 0;
  double largest_deviation = 0.0;  ///< Largest distance of the hand from the curve, m.
  double strongest = 0.0;          ///< Largest force requested of the device, N.
};

/// Callbacks of a guidance, called on its thread. An exception of a callback is a fault: it ends
/// the guidance and the force, and the robot stays at the last configuration it was sent to.
struct GuidanceListeners {
  std::function<void(const GuidanceSample&)> on_sample = [](const GuidanceSample&) {};
  /// Moves a robot to a configuration; called every 50 ms and on arrival.
  std::function<void(const geometric::Configuration&)> lead = [](const geometric::Configuration&) {
  };
};

/// Guides a hand along a path and moves the robot along with it, until the robot is at the path's
/// end, `stop` is requested or a fault occurs. The force ends in each of these cases.
/// @param device connected device. @param guide for curve.curve(). @param motion on curve.path().
[[nodiscard]] HANDWAY_EXECUTION_EXPORT GuidanceOutcome
run_guidance(device::HapticDevice& device, device::ForceGuide& guide, const PathToolCurve& curve,
             GuidedMotion& motion, const std::stop_token& stop, const GuidanceListeners& listeners);

}  // namespace handway::execution
