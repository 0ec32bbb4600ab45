#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/export.h"
#include "handway/planning/planners/planner_registry.h"

#include <filesystem>

namespace handway::planning {

/// Reads a campaign file (YAML; docs/campaigns.md).
///
/// Problems are paths relative to the campaign's folder or names of scenes that ship;
/// `${NAME}` in them is the environment's. A problem marked optional is left out where
/// its file, or a variable in its name, is missing. Every combination of a planner's lists
/// of values becomes a CampaignPlanner of its own, and so does each value under `vary`;
/// two that come to the same parameters become one.
///
/// @throws InputError naming file, line and element of what is wrong, planners, parameters
/// and their ranges included. The problems themselves are not opened.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Campaign read_campaign(const std::filesystem::path& file,
                                                             const PlannerRegistry& registry);

/// Is this a YAML file with the key `campaign` at its top? Never throws.
[[nodiscard]] HANDWAY_PLANNING_EXPORT bool is_campaign(const std::filesystem::path& file);

}  // namespace handway::planning
