#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

namespace handway::planning {

/// How much each property of a path counts in its cost; means are over its length.
struct ObjectiveWeights {
  double length = 1.0;          ///< Per length in joints normalised to [0, 1].
  double human_likeness = 0.0;  ///< Per mean distance of the hand from the PMD subspace.
  double clearance = 0.0;       ///< Per mean share of kFarClearance that is missing.
  double duration = 0.0;        ///< Per second.

  friend bool operator==(const ObjectiveWeights&, const ObjectiveWeights&) = default;
};

/// What a path is made to be.
enum class ObjectivePreset {
  kHumanLike,  ///< The hand stays near the PMD subspace; without a basis as kShortest.
  kShortest,
  kSafest,   ///< Far from obstacles.
  kFastest,  ///< In the least time under the velocity limits.
  kCustom,   ///< ObjectiveSettings::custom.
};

/// A planner's choice of an objective.
struct ObjectiveSettings {
  int preset = static_cast<int>(ObjectivePreset::kHumanLike);  ///< An ObjectivePreset.
  ObjectiveWeights custom;

  [[nodiscard]] HANDWAY_PLANNING_EXPORT ObjectiveWeights
  weights(const PlanningProblem& problem) const;
};

}  // namespace handway::planning
