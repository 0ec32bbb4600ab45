#pragma once

#include "handway/planning/core/objective.h"
#include "handway/planning/core/planning_context.h"
#include "handway/sampling/sequences/random_stream.h"

#include <optional>
#include <vector>

namespace handway::planning {

/// A free configuration with the hand in the PMD subspace, near `at` and with its arm: the hand at
/// the closest posture or, where that collides, at one beside it that some trials find.
[[nodiscard]] std::optional<Objective::Point> free_in_subspace(PlanningContext& context,
                                                               const Objective& objective,
                                                               const Objective::Point& at,
                                                               sampling::RandomStream& draw);

/// Free motions from an end of the problem into the PMD subspace: the hand goes straight to it; if
/// obstacles forbid that, the arm first goes back a little along the straight motion to the other
/// end. @param other the other end.
/// @returns from the end to the entry, the end alone if it is in the subspace; nothing: not found.
[[nodiscard]] std::optional<std::vector<Configuration>> subspace_entry(
    PlanningContext& context, const Objective& objective, const Configuration& end,
    const Configuration& other, sampling::RandomStream& draw);

}  // namespace handway::planning
