#pragma once

#include "handway/planning/campaigns/run_workers.h"
#include "handway/planning/core/plugin.h"

#include <filesystem>
#include <functional>

namespace handway::tools {

struct CampaignOptions {
  std::filesystem::path file;
  std::filesystem::path out;  ///< Empty: named after the file.
  bool resume = false;
  int jobs = 0;  ///< 0: as many as there are cores.
};

/// `handway bench CAMPAIGN.yaml`: carries out a campaign and writes its report.
/// @returns the exit code; 1 if it was interrupted.
[[nodiscard]] int run_campaign_file(const CampaignOptions& options);

/// Runs `work` in the team of processes that `mpirun` started, or with none (null). Of
/// a team, only the process that leads tells what went wrong.
[[nodiscard]] int run_in_team(const std::function<int(planning::ProcessTeam*)>& work);

}  // namespace handway::tools
