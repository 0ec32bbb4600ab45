#pragma once

#include "handway/planning/core/path.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

#include <cstdint>
#include <string>
#include <vector>

namespace handway::planning {

/// What a check of a path found.
struct PathCheckResult {
  std::vector<std::string> faults;   ///< A sentence each; empty: the path is valid.
  std::uint64_t configurations = 0;  ///< Checked ones.
  std::uint64_t collisions = 0;      ///< Of these, in collision or violating a constraint.
  double min_clearance_mm = 0.0;     ///< At the checked configurations; 0 if one collides.
  std::string closest_pair;          ///< "A with B" at the smallest clearance.

  [[nodiscard]] bool valid() const { return faults.empty(); }
};

/// Checks a path without trusting whoever made it: joint limits, both ends
/// against the problem's, constraints, and collisions on the raw triangles (FclChecker) at
/// configurations so close that no point of the robot moves more than
/// `resolution` (m) from one to the next.
[[nodiscard]] HANDWAY_PLANNING_EXPORT PathCheckResult check_path(const PlanningProblem& problem,
                                                                 const Path& path,
                                                                 double resolution);

}  // namespace handway::planning
