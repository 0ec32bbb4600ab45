#pragma once

#include "handway/geometric/robot/robot_model.h"

#include <algorithm>
#include <utility>

/// @file
/// The joint space scaled to [0, 1] per joint, in which the paper measures
/// distances (section 7) and runs the PCA.
namespace handway::geometric {

/// (q - lower) / (upper - lower), shape [variable_count]; 0 for a joint without range.
[[nodiscard]] inline Configuration normalised(const RobotModel& model, const Configuration& q) {
  const Configuration range = model.upper() - model.lower();
  return (range.array() > 0.0).select((q - model.lower()).cwiseQuotient(range), 0.0);
}

/// `p` with every joint clamped to [0, 1]; continuous joints, which have no limits, unchanged.
[[nodiscard]] inline Configuration clamped_to_range(const RobotModel& model, Configuration p) {
  for (int v = 0; v < model.variable_count(); ++v) {
    p[v] = model.is_continuous(v) ? p[v] : std::min(std::max(p[v], 0.0), 1.0);
  }
  return p;
}

/// Periods of normalised joints: 1 for each continuous joint.
[[nodiscard]] inline Periods normalised_turns(const RobotModel& model) {
  Eigen::VectorXd turns(model.variable_count());
  for (int v = 0; v < model.variable_count(); ++v) {
    turns[v] = model.is_continuous(v) ? 1.0 : 0.0;
  }
  return Periods(std::move(turns));
}

/// lower + p * (upper - lower), shape [variable_count].
[[nodiscard]] inline Configuration denormalised(const RobotModel& model, const Configuration& p) {
  return model.lower() + p.cwiseProduct(model.upper() - model.lower());
}

}  // namespace handway::geometric
