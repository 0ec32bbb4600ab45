#pragma once

#include "handway/geometric/robot/robot_model.h"

/// The joint space scaled to [0, 1] per joint, in which the paper measures
/// distances (section 7) and runs the PCA.
namespace handway::geometric {

/// (q - lower) / (upper - lower), shape [variable_count]; 0 for a joint without range.
[[nodiscard]] inline Configuration normalised(const RobotModel& model, const Configuration& q) {
  const Configuration range = model.upper() - model.lower();
  return (range.array() > 0.0).select((q - model.lower()).cwiseQuotient(range), 0.0);
}

/// lower + p * (upper - lower), shape [variable_count].
[[nodiscard]] inline Configuration denormalised(const RobotModel& model, const Configuration& p) {
  return model.lower() + p.cwiseProduct(model.upper() - model.lower());
}

}  // namespace handway::geometric
