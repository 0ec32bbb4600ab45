#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

#include <cstdint>
#include <stop_token>
#include <string_view>
#include <vector>

namespace handway::planning {

struct PregraspOptions {
  int samples = 12000;  ///< Palm poses to try.
  double gap = 0.003;   ///< m that every finger keeps to the object.
  int most = 8;         ///< Pre-grasps to give.
  std::uint64_t seed = 1;
};

/// A free configuration with the fingers around an object, just before they touch it.
struct Pregrasp {
  Configuration q;
  int fingers = 0;         ///< That are near the object.
  double enclosure = 0.0;  ///< 0: all on one side of the object; 1: around it.
  double clearance = 0.0;  ///< Of the robot to everything else that stands still, m, at most 0.05.
  double subspace_distance = 0.0;  ///< From the hand's PMD subspace, normalised joints.
  double arm_travel = 0.0;         ///< From the start, normalised joints.
  double score = 0.0;              ///< In [0, 1]; what they are ranked by.
};

/// Looks for pre-grasps: draws palm orientations (uniform on SO(3)), opened preshapes of the basis'
/// box, and places of the object between the fingertips; solves the arm's inverse kinematics;
/// closes every finger towards the middle until near contact. Kept are those that are free, with
/// two or more fingers around the object; similar ones are left out. Same arguments, same bits.
/// @param object of the scene, that stands still.
/// @returns the best first; empty if there is none, or `stop` was requested.
/// @throws InputError if there is no such object or the hand has no fingers or no basis.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<Pregrasp> find_pregrasps(
    const PlanningProblem& problem, std::string_view object, const PregraspOptions& options = {},
    const std::stop_token& stop = {});

}  // namespace handway::planning
