#include "handway/geometric/collision/continuous/sliding_step.h"

#include <algorithm>
#include <cmath>

namespace handway::geometric {

namespace {

constexpr int kHalvings = 5;

// @pre `from` is free.
FreeStep advance(CollisionChecker& checker, const Configuration& from, const Configuration& to,
                 double resolution) {
  const Configuration delta = to - from;
  const double longest = delta.lpNorm<Eigen::Infinity>();
  const int steps = static_cast<int>(std::ceil(longest / resolution));
  double reached = 0.0;
  double beyond = 1.0;
  FreeStep step{from, std::nullopt};
  for (int i = 1; i <= steps && !step.pair; ++i) {
    beyond = static_cast<double>(i) / steps;
    step.pair = checker.first_collision(i == steps ? to : from + beyond * delta);
    reached = step.pair ? reached : beyond;
  }
  if (!step.pair) {
    step.q = to;
    return step;
  }
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (reached + beyond);
    if (const auto pair = checker.first_collision(from + middle * delta)) {
      beyond = middle;
      step.pair = pair;
    } else {
      reached = middle;
    }
  }
  step.q = from + reached * delta;
  return step;
}

void slide_along(CollisionChecker& checker, const Configuration& to, std::span<const int> variables,
                 double resolution, FreeStep& step) {
  Configuration goal = step.q;
  for (const int variable : variables) {
    goal[variable] = to[variable];
  }
  if (goal != step.q) {
    step.q = advance(checker, step.q, goal, resolution).q;
  }
}

}  // namespace

FreeStep straight_step(CollisionChecker& checker, const Configuration& from,
                       const Configuration& to, double resolution) {
  if (!checker.first_collision(from)) {
    return advance(checker, from, to, resolution);
  }
  const std::optional<int> pair = checker.first_collision(to);
  return {pair ? from : to, pair};
}

FreeStep sliding_step(CollisionChecker& checker, const Configuration& from, const Configuration& to,
                      std::span<const JointIndices> groups, double resolution) {
  FreeStep step = straight_step(checker, from, to, resolution);
  if (!step.pair || checker.first_collision(step.q)) {
    return step;
  }
  for (const JointIndices& group : groups) {
    slide_along(checker, to, group, resolution, step);
  }
  for (int variable = 0; variable < to.size(); ++variable) {
    slide_along(checker, to, std::span(&variable, 1), resolution, step);
  }
  if (step.q == to) {
    step.pair.reset();
  }
  return step;
}

}  // namespace handway::geometric
