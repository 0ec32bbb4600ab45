#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/planning/grasps/pregrasp_search.h"

#include <string>
#include <string_view>

namespace handway::planning {

/// The text of a grasp file (YAML): what was asked for, and for each grasp the palm's pose in the
/// object's frame (m, degrees), the joints of the pre-grasp, of the grasp and of its squeeze (rad
/// or m), contacts in the object's frame, and quality.
/// @param object that find_pregrasps() found `grasps` of, with `options`.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string grasp_file_text(const PlanningProblem& problem,
                                                                  std::string_view object,
                                                                  const PregraspOptions& options,
                                                                  const Pregrasps& grasps);

}  // namespace handway::planning
