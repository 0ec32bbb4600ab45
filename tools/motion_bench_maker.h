#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/planners/planner.h"

#include <filesystem>
#include <string>
#include <vector>

namespace handway::tools {

/// Returns a campaign of all problems of MotionBenchMaker below a folder: planning scenes
/// (`scene0001.yaml`) with a request beside each. A set is a folder; the problems have the tags
/// `set` and `robot`, and names such as "box_panda/0001". Problems that can't be read are left out.
///
/// C. Chamzas et al., "MotionBenchMaker: a tool to generate and benchmark motion planning
/// datasets", IEEE RA-L 7(2), 2022, doi:10.1109/LRA.2021.3133603.
/// @param planners names in the registry; empty: `auto`, `rrt-connect` and `ompl-rrt-connect`.
/// @throws InputError if there is no such folder or it has no problem, or for an unknown planner.
[[nodiscard]] planning::Campaign motion_bench_maker_campaign(
    const std::filesystem::path& folder, const std::vector<std::string>& planners,
    const planning::PlannerRegistry& registry);

}  // namespace handway::tools
