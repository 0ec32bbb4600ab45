#include "campaign_command.h"

#include "campaign_report.h"
#include "commands.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/printable.h"
#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/run_database.h"
#include "handway/planning/campaigns/run_workers.h"
#include "printing.h"
#include "terminal.h"
#include "version.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

namespace handway::tools {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kTerminalPause(200);
constexpr std::chrono::seconds kLinePause(10);

}  // namespace

CampaignProgress::CampaignProgress(std::string name, std::size_t kept, std::size_t total,
                                   int workers)
    : name_(std::move(name)),
      kept_(kept),
      total_(total),
      terminal_(isatty(STDERR_FILENO) == 1),
      begin_(Clock::now()),
      next_(begin_ + (terminal_ ? Clock::duration::zero() : Clock::duration(kLinePause))) {
  const std::string kept_text = kept == 0 ? "" : fmt::format(", {} of them already done", kept);
  print_error("{}: {} runs{}, {} simultaneously\n", name_, total, kept_text, workers);
}

CampaignProgress::~CampaignProgress() {
  if (done_ > 0) {
    show(true);
  }
}

void CampaignProgress::add(std::span<const planning::RunRecord> records) {
  done_ += records.size();
  for (const planning::RunRecord& record : records) {
    solved_ += record.solved ? 1 : 0;
  }
  if (Clock::now() >= next_) {
    show(false);
  }
}

double CampaignProgress::elapsed_s() const {
  return std::chrono::duration<double>(Clock::now() - begin_).count();
}

std::string CampaignProgress::line() const {
  const std::size_t done = kept_ + done_;
  std::string text = fmt::format("{}: {}/{} runs ({:.0f} %)", name_, done, total_,
                                 100.0 * static_cast<double>(done) / static_cast<double>(total_));
  if (done_ > 0) {
    const double pace = elapsed_s() / static_cast<double>(done_);
    text += fmt::format(", {}/{} solved", solved_, done_);
    text += done == total_ ? fmt::format(", took {}", duration_text(elapsed_s()))
                           : fmt::format(", about {} left",
                                         duration_text(pace * static_cast<double>(total_ - done)));
  }
  return text;
}

void CampaignProgress::show(bool last) {
  if (terminal_) {
    fmt::print(stderr, "\r{}\x1b[K{}", geometric::printable(line()), last ? "\n" : "");
    std::fflush(stderr);
    next_ = Clock::now() + kTerminalPause;
  } else {
    print_error("{}\n", line());
    next_ = Clock::now() + kLinePause;
  }
}

std::string duration_text(double seconds) {
  constexpr long kMinute = 60;
  constexpr long kHour = 3600;
  const long whole = std::lround(seconds);
  if (whole < kMinute) {
    return fmt::format("{} s", whole);
  }
  if (whole < kHour) {
    return fmt::format("{} min {} s", whole / kMinute, whole % kMinute);
  }
  return fmt::format("{} h {} min", whole / kHour, whole % kHour / kMinute);
}

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
                                                const planning::PluginManager& plugins,
                                                const CampaignSession& session,
                                                planning::ProcessTeam* team) {
  if (team != nullptr && !team->leads()) {
    team->serve(planning::RunExecutor(campaign, plugins));
    return std::nullopt;
  }
  make_out_folder(session.folder);
  const planning::RunExecutor executor(campaign, plugins);
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

namespace {

int run_campaign(const CampaignOptions& options, planning::ProcessTeam* team) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  const planning::Campaign campaign = planning::read_campaign(options.file, plugins.planners());
  CampaignSession session;
  session.folder = options.out.empty() ? fs::path(options.file.stem()) : options.out;
  session.resume = options.resume;
  session.jobs = options.jobs;
  const std::optional<CampaignOutcome> outcome = conduct_campaign(campaign, plugins, session, team);
  if (!outcome) {
    return kDone;
  }
  write_campaign_report(campaign, *outcome, session.folder);
  const auto solved = std::ranges::count_if(outcome->records, &planning::RunRecord::solved);
  print_out("{}: {} of {} runs done, {} solved; report in {}\n", campaign.name,
            outcome->records.size(), campaign.run_count(), solved,
            (session.folder / "report.html").string());
  if (!outcome->complete) {
    print_error("handway: interrupted; continue with --resume\n");
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
      // The leader reports for all. An error code here would make mpirun end it before it has.
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
