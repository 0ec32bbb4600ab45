#include "campaign_command.h"

#include "campaign_report.h"
#include "campaign_session.h"
#include "exit_codes.h"
#include "handway/planning/campaigns/campaign_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <optional>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;

int run_campaign(const CampaignOptions& options, planning::ProcessTeam* team) {
  planning::Extensions extensions;
  extensions.load_plugins(planning::plugin_directory());
  const planning::Campaign campaign = planning::read_campaign(options.file, extensions.planners());
  CampaignSession session;
  session.folder = options.out.empty() ? fs::path(options.file.stem()) : options.out;
  session.resume = options.resume;
  session.jobs = options.jobs;
  const std::optional<CampaignOutcome> outcome =
      conduct_campaign(campaign, extensions, session, team);
  if (!outcome) {
    return kDone;
  }
  write_campaign_report(campaign, *outcome, session.folder);
  const auto solved = std::ranges::count_if(outcome->records, &planning::RunRecord::solved);
  fmt::print("{}: {} of {} runs done, {} solved; report in {}\n", campaign.name,
             outcome->records.size(), campaign.run_count(), solved,
             (session.folder / "report.html").string());
  if (!outcome->complete) {
    fmt::print(stderr, "handway: interrupted; go on with --resume\n");
    return kNoPath;
  }
  return kDone;
}

}  // namespace

int run_in_team(const std::function<int(planning::ProcessTeam*)>& work) {
  const std::unique_ptr<planning::ProcessTeam> team = planning::join_process_team();
  try {
    return work(team.get());
  } catch (const std::exception& error) {
    if (team != nullptr && !team->leads()) {
      // The leader speaks for all. An error code here would make mpirun end it before it has.
      team->decline(error.what());
      return kDone;
    }
    throw;
  }
}

int run_campaign_file(const CampaignOptions& options) {
  return run_in_team([&](planning::ProcessTeam* team) { return run_campaign(options, team); });
}

}  // namespace handway::tools
