#pragma once

#include "handway/geometric/collision/collision_world.h"

#include <memory>

namespace handway::tools {

/// Time of a checker's answers, µs: the median of rounds in which the checkers take turns.
struct CheckerSpeed {
  double configuration_us = 0.0;
  double edge_us = 0.0;  ///< NaN without an edge.
};

/// The default checker against FCL, on the same queries.
struct CollisionBench {
  int configurations = 0;
  double in_collision = 0.0;  ///< Share of the configurations.
  int edges = 0;              ///< Number of edges with free ends.
  double edges_free = 0.0;    ///< Share of these.
  CheckerSpeed fast;
  CheckerSpeed fcl;  ///< Pair by pair.
  double fcl_broadphase_configuration_us = 0.0;
  int disagreements = 0;  ///< Configurations on which checkers disagree.
};

/// Configurations are sampled around the straight motion from `start` to `goal`, up to 5 % of every
/// joint's range off it; edges begin there and are a tenth of the motion long.
[[nodiscard]] CollisionBench bench_collision(
    const std::shared_ptr<const geometric::CollisionWorld>& world,
    const geometric::Configuration& start, const geometric::Configuration& goal);

}  // namespace handway::tools
