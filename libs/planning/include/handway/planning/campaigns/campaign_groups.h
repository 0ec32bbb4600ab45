#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/campaign_statistics.h"
#include "handway/planning/export.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace handway::planning {

/// The runs of a planner on all problems that have the same value of a tag, without those that it
/// refused.
struct CampaignGroup {
  std::string key;    ///< Key of the tag; empty: all problems of the campaign.
  std::string value;  ///< Value of the tag.
  std::size_t problems = 0;
  CampaignCell cell;  ///< Its problem is -1.
  /// Length of the path divided by that of the group's first planner, for each problem and seed for
  /// which both found one.
  std::vector<double> length_ratios;

  /// Number of paths that have a certificate of clearance.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT std::size_t certified() const;
  /// Number of paths that were checked again.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT std::size_t checked() const;
  /// Number of those without a fault.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT std::size_t valid() const;
  /// Processor times of all runs for which they are known, s; infinite for those without a path.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<double> processor_times() const;
};

/// Returns a group for each value of each tag and each planner that has runs, tag by tag, then
/// those of all problems. Nothing if no problem has a tag.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<CampaignGroup> campaign_groups(
    const Campaign& campaign, std::span<const CampaignCell> cells);

}  // namespace handway::planning
