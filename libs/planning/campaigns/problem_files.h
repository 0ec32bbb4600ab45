#pragma once

#include "handway/geometric/io/yaml_element.h"
#include "handway/planning/campaigns/campaign.h"

#include <filesystem>
#include <vector>

namespace handway::planning {

/// The problems under a campaign's key `problems`.
/// @param folder of the campaign's file.
/// @throws InputError naming the element of one that is not there.
[[nodiscard]] std::vector<CampaignProblem> campaign_problems(const geometric::YamlElement& list,
                                                             const std::filesystem::path& folder);

}  // namespace handway::planning
