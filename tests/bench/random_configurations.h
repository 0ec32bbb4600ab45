#pragma once

#include "handway/geometric/robot/robot_model.h"

#include <random>
#include <vector>

namespace handway::test {

/// Returns the same configurations at each call, evenly distributed.
/// @param lower, upper shares of each joint's range between which its values are.
inline std::vector<geometric::Configuration> random_configurations(
    const geometric::RobotModel& model, int count, double lower = 0.0, double upper = 1.0) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> share(lower, upper);
  std::vector<geometric::Configuration> configurations;
  for (int k = 0; k < count; ++k) {
    geometric::Configuration q(model.variable_count());
    for (int v = 0; v < model.variable_count(); ++v) {
      q[v] = model.lower()[v] + share(engine) * (model.upper()[v] - model.lower()[v]);
    }
    configurations.push_back(q);
  }
  return configurations;
}

}  // namespace handway::test
