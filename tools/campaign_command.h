#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/run_workers.h"
#include "handway/planning/extensions/plugin.h"
#include "other_paths.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace handway::tools {

struct CampaignSession {
  std::filesystem::path folder;  ///< Created if missing; gets `runs.sqlite`.
  bool resume = false;
  std::filesystem::path paths = {};  ///< Paths of other planners: read_other_paths(); or empty.
  int jobs = 0;  ///< Runs at a time; 0: one for each core, shared among the threads of a run.
};

/// Result of a campaign.
struct CampaignOutcome {
  std::vector<planning::RunRecord> records;  ///< Runs, with those of earlier sessions.
  std::vector<std::string> versions;         ///< Versions of the programs that made them.
  double elapsed_s = 0.0;                    ///< Wall clock of this session.
  std::size_t done = 0;                      ///< Runs of this session.
  int workers = 0;                           ///< 0: no run was carried out.
  bool complete = false;                     ///< False if interrupted.
  planning::Campaign campaign = {};          ///< Without the problems that were left out.
  std::vector<planning::LeftOutProblem> left_out = {};
  OtherPaths others = {};  ///< Paths of other planners.
};

/// Carries out the rest of a campaign, on threads or with a team of processes. Ctrl+C ends it and
/// keeps finished runs.
/// @param team may be null.
/// @returns nothing in a process of a team other than the leader.
/// @throws InputError for files that can't be read or written.
[[nodiscard]] std::optional<CampaignOutcome> conduct_campaign(
    const planning::Campaign& campaign, const planning::PluginManager& plugins,
    const CampaignSession& session, planning::ProcessTeam* team);

/// Makes a folder and those above it.
/// @throws InputError if that fails.
void make_out_folder(const std::filesystem::path& folder);

struct CampaignOptions {
  std::filesystem::path file;
  std::filesystem::path out;  ///< Empty: named after the file.
  bool resume = false;
  std::filesystem::path paths;  ///< Paths of other planners; empty: none.
  int jobs = 0;                 ///< 0: as many as there are cores.
};

/// `handway bench CAMPAIGN.yaml`: carries out a campaign and writes its report.
/// @returns the exit code; 1 if it was interrupted.
[[nodiscard]] int run_campaign_file(const CampaignOptions& options);

/// Carries out a campaign, writes its report and prints a summary.
/// @returns the exit code; 1 if it was interrupted.
[[nodiscard]] int run_campaign(const planning::Campaign& campaign,
                               const planning::PluginManager& plugins,
                               const CampaignSession& session, planning::ProcessTeam* team);

/// Runs `work` in the team of processes that `mpirun` started, or without a team (null). Only the
/// leading process of a team reports errors.
[[nodiscard]] int run_in_team(const std::function<int(planning::ProcessTeam*)>& work);

}  // namespace handway::tools
