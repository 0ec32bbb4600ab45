#include "campaign_command.h"

#include "campaign_progress.h"
#include "campaign_report.h"
#include "commands.h"
#include "handway/geometric/io/input_error.h"
#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/run_database.h"
#include "handway/planning/campaigns/run_workers.h"
#include "left_out.h"
#include "printing.h"
#include "terminal.h"
#include "version.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
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

int run_file(const CampaignOptions& options, planning::ProcessTeam* team) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  CampaignSession session;
  session.folder = options.out.empty() ? fs::path(options.file.stem()) : options.out;
  session.resume = options.resume;
  session.paths = options.paths;
  session.jobs = options.jobs;
  return run_campaign(planning::read_campaign(options.file, plugins.planners()), plugins, session,
                      team);
}

void print_other_paths(const OtherPaths& others) {
  if (!others.records.empty()) {
    const auto valid = std::ranges::count_if(
        others.records, [](const planning::RunRecord& record) { return record.fault.empty(); });
    print_out("Paths of other planners: {} checked, {} valid\n", others.records.size(), valid);
  }
  if (!others.skipped.empty()) {
    print_error("handway: {} paths not checked, the first because: {}\n", others.skipped.size(),
                others.skipped.front());
  }
}

}  // namespace

int run_campaign(const planning::Campaign& campaign, const planning::PluginManager& plugins,
                 const CampaignSession& session, planning::ProcessTeam* team) {
  const std::optional<CampaignOutcome> outcome = conduct_campaign(campaign, plugins, session, team);
  if (!outcome) {
    return kDone;
  }
  write_campaign_report(outcome->campaign, *outcome, session.folder);
  const auto solved = std::ranges::count_if(outcome->records, &planning::RunRecord::solved);
  print_out("{}: {} of {} runs done, {} solved; report in {}\n", campaign.name,
            outcome->records.size(), outcome->campaign.run_count(), solved,
            (session.folder / "report.html").string());
  print_other_paths(outcome->others);
  for (const LeftOut& group : grouped(outcome->left_out)) {
    print_error("handway: {} left out: {}\n", group.problems, group.reason);
  }
  if (!outcome->complete) {
    print_error("handway: interrupted; continue with --resume\n");
    return kNoPath;
  }
  return kDone;
}

std::optional<CampaignOutcome> conduct_campaign(const planning::Campaign& campaign,
                                                const planning::PluginManager& plugins,
                                                const CampaignSession& session,
                                                planning::ProcessTeam* team) {
  if (team != nullptr && !team->leads()) {
    team->serve(planning::RunExecutor(campaign, plugins));
    return std::nullopt;
  }
  make_out_folder(session.folder);
  const planning::RunExecutor executor(campaign, plugins);
  CampaignOutcome outcome;
  if (!session.paths.empty()) {
    outcome.others = read_other_paths(session.paths, executor);
  }
  const planning::Campaign& readable = executor.campaign();
  RunDatabase database(session.folder / "runs.sqlite", readable, kVersion,
                       session.resume ? RunDatabase::Opening::kResume : RunDatabase::Opening::kNew);
  planning::ThreadWorkers threads(thread_count(session, campaign));
  planning::RunWorkers& workers =
      team != nullptr ? static_cast<planning::RunWorkers&>(*team) : threads;
  const std::vector<planning::RunSpec> pending = database.pending();
  outcome.workers = workers.count();
  {
    std::stop_source stop;
    const StopsOnInterrupt guard(stop);
    CampaignProgress progress(readable.name, readable.run_count() - pending.size(),
                              readable.run_count(), workers.count());
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
  outcome.complete = outcome.records.size() == readable.run_count();
  outcome.campaign = readable;
  outcome.left_out = executor.left_out();
  return outcome;
}

void make_out_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw geometric::OutputError(
        {folder.string(), "", error.message(), "a folder to write to", "Choose another --out"});
  }
}

int run_in_team(const std::function<int(planning::ProcessTeam*)>& work) {
  const std::unique_ptr<planning::ProcessTeam> team = planning::join_process_team();
  try {
    return work(team.get());
  } catch (const std::exception& error) {
    if (team != nullptr && !team->leads()) {
      // The leader reports for all. An error code here would make mpirun end it before it has.
      team->decline(error.what());
      return kDone;
    }
    throw;
  }
}

int run_campaign_file(const CampaignOptions& options) {
  return run_in_team([&](planning::ProcessTeam* team) { return run_file(options, team); });
}

}  // namespace handway::tools
