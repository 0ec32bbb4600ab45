#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/campaign_statistics.h"

#include <span>
#include <string>

namespace handway::tools {

/// The runs on one problem as OMPL's benchmark log, which `ompl_benchmark_statistics` makes a
/// database for Planner Arena of (https://ompl.kavrakilab.org/benchmark.html).
/// @param cells of one problem, one a planner.
[[nodiscard]] std::string ompl_log(const planning::Campaign& campaign,
                                   std::span<const planning::CampaignCell> cells);

}  // namespace handway::tools
