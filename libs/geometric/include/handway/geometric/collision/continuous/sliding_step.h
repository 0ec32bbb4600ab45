#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_model.h"

#include <optional>
#include <span>
#include <vector>

namespace handway::geometric {

/// Largest collision-free step of a robot that is guided by hand.
struct FreeStep {
  Configuration q;          ///< Shape [variable_count].
  std::optional<int> pair;  ///< Pair that stops the step; empty if it is free.
};

/// Goes straight from `from` towards `to` as long as all checked configurations are free: at least
/// one every `resolution`, and near the contact five halvings of that. If `from` itself touches,
/// only `to` counts: a robot in collision can be guided out.
/// @param from, to shape [variable_count].
/// @param resolution largest change of a variable between two configurations, rad or m, > 0.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT FreeStep straight_step(CollisionChecker& checker,
                                                              const Configuration& from,
                                                              const Configuration& to,
                                                              double resolution = 0.02);

/// Returns the step with sliding: first all variables go together as far as they can. Then each
/// group in turn goes on alone, so that a touching finger stops while arm and other fingers move
/// on. Then each remaining variable does.
/// @param groups variables that belong together, such as arm and fingers; may be empty.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT FreeStep sliding_step(CollisionChecker& checker,
                                                             const Configuration& from,
                                                             const Configuration& to,
                                                             std::span<const JointIndices> groups,
                                                             double resolution = 0.02);

}  // namespace handway::geometric
