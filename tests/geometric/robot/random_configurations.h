#pragma once

#include "handway/geometric/robot/robot_model.h"

#include <cstdint>
#include <random>

namespace handway::test {

/// Uniform configurations within a model's limits, from a seed.
class RandomConfigurations {
 public:
  RandomConfigurations(const geometric::RobotModel& model, std::uint64_t seed)
      : model_(model), engine_(seed) {}

  geometric::Configuration next() {
    geometric::Configuration q(model_.variable_count());
    for (int v = 0; v < model_.variable_count(); ++v) {
      q[v] = uniform(model_.lower()[v], model_.upper()[v]);
    }
    return q;
  }

  double uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(engine_);
  }

 private:
  const geometric::RobotModel& model_;
  std::mt19937_64 engine_;
};

}  // namespace handway::test
