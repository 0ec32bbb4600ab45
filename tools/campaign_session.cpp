#include "campaign_session.h"

#include "campaign_progress.h"
#include "handway/geometric/io/input_error.h"
#include "handway/planning/campaigns/run_database.h"
#include "handway/planning/campaigns/run_executor.h"
#include "interrupt.h"
#include "version.h"

#include <algorithm>
#include <system_error>
#include <thread>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using planning::RunDatabase;

int thread_count(const CampaignSession& session, const planning::Campaign& campaign) {
  if (session.jobs > 0) {
    return session.jobs;
  }
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  return std::max(1, cores / campaign.threads);
}

}  // namespace

std::optional<CampaignOutcome> conduct_campaign(const planning::Campaign& campaign,
                                                const planning::Extensions& extensions,
                                                const CampaignSession& session,
                                                planning::ProcessTeam* team) {
  if (team != nullptr && !team->leads()) {
    team->serve(planning::RunExecutor(campaign, extensions));
    return std::nullopt;
  }
  make_out_folder(session.folder);
  const planning::RunExecutor executor(campaign, extensions);
  RunDatabase database(session.folder / "runs.sqlite", executor.campaign(), kVersion,
                       session.resume ? RunDatabase::Opening::kResume : RunDatabase::Opening::kNew);
  planning::ThreadWorkers threads(thread_count(session, campaign));
  planning::RunWorkers& workers =
      team != nullptr ? static_cast<planning::RunWorkers&>(*team) : threads;
  const std::vector<planning::RunSpec> pending = database.pending();
  CampaignOutcome outcome;
  outcome.workers = workers.count();
  {
    std::stop_source stop;
    const StopsOnInterrupt guard(stop);
    CampaignProgress progress(campaign.name, campaign.run_count() - pending.size(),
                              campaign.run_count(), workers.count());
    workers.carry_out(
        executor, pending,
        [&](std::span<const planning::RunRecord> records) {
          if (!records.empty()) {
            database.add(records);
          }
          outcome.done += records.size();
          progress.add(records);
        },
        stop.get_token());
    outcome.elapsed_s = progress.elapsed_s();
  }
  outcome.records = database.records();
  outcome.versions = database.versions();
  outcome.complete = outcome.records.size() == campaign.run_count();
  return outcome;
}

void make_out_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw geometric::InputError(
        {folder.string(), "", error.message(), "a folder to write to", "Choose another --out"});
  }
}

}  // namespace handway::tools
