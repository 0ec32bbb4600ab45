#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/run_record.h"
#include "handway/planning/export.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace handway::planning {

/// A run with all that it takes to carry it out again.
struct ArchivedRun {
  std::string problem;  ///< Its name in the campaign.
  std::filesystem::path file;
  CampaignPlanner planner;
  std::uint64_t seed = 1;
  bool solved = false;
  std::string status;   ///< As RunRecord's.
  double time_s = 0.0;  ///< Planning alone, wall clock.
  std::uint64_t samples = 0;
  std::uint64_t path_nodes = 0;
  double min_clearance_mm = 0.0;
};

/// All runs of a run database, in the order of problems, planners and seeds. Another program may be
/// adding to it.
/// @throws InputError if it can't be read or is no run database.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<ArchivedRun> read_runs(
    const std::filesystem::path& file);

/// The same of a run that was just made.
[[nodiscard]] HANDWAY_PLANNING_EXPORT ArchivedRun archived(const Campaign& campaign,
                                                           const RunRecord& record);

}  // namespace handway::planning
