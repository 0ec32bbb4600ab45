#pragma once

#include "handway/execution/export.h"
#include "handway/planning/core/path.h"

#include <Eigen/Core>

#include <vector>

namespace handway::execution {

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

}  // namespace handway::execution
