#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/run_record.h"
#include "handway/planning/campaigns/run_workers.h"
#include "handway/planning/core/plugin.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::tools {

struct CampaignSession {
  std::filesystem::path folder;  ///< Made if it is not there; gets `runs.sqlite`.
  bool resume = false;
  int jobs = 0;  ///< Runs at a time; 0: one for each core, shared among the threads of a run.
};

/// What became of a campaign.
struct CampaignOutcome {
  std::vector<planning::RunRecord> records;  ///< Those of earlier sessions included.
  std::vector<std::string> versions;         ///< Of the programs that made them.
  double elapsed_s = 0.0;                    ///< Wall clock of this session.
  std::size_t done = 0;                      ///< Runs of this session.
  int workers = 0;                           ///< 0: nothing was carried out.
  bool complete = false;                     ///< False: it was interrupted.
};

/// Carries out what is left of a campaign, on threads or with a team of processes.
/// Ctrl+C ends it and keeps what is done.
/// @param team may be null.
/// @returns nothing in a process of a team that does not lead it.
/// @throws InputError for what can't be read or written.
[[nodiscard]] std::optional<CampaignOutcome> conduct_campaign(
    const planning::Campaign& campaign, const planning::Extensions& extensions,
    const CampaignSession& session, planning::ProcessTeam* team);

/// Makes a folder and those above it.
/// @throws InputError if that can't be done.
void make_out_folder(const std::filesystem::path& folder);

}  // namespace handway::tools
