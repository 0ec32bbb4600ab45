#pragma once

#include "handway/planning/core/planning_problem.h"

#include <string>
#include <vector>

namespace handway::tools {

/// The links of a hand: `palm` and all that it carries.
[[nodiscard]] std::vector<int> hand_links(const geometric::RobotModel& model, int palm);

/// `q` with the hand closed around objects: one finger after the other turns its joints down the
/// gradient of its distance to the nearest of them, until it keeps only `gap` to anything, the
/// hand's other links included, or its joints are at their limits. A finger that keeps less already
/// stays. Same arguments, same bits.
/// @param hand variables of the hand. @param palm the link that its fingers hang from.
/// @param objects names of bodies that stand still. @param gap m, > 0.
[[nodiscard]] geometric::Configuration close_hand(geometric::CollisionChecker& checker,
                                                  const std::vector<int>& hand, int palm,
                                                  const std::vector<std::string>& objects,
                                                  geometric::Configuration q, double gap);

}  // namespace handway::tools
