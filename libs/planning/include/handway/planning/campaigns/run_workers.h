#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/planning/extensions/plugin.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::planning {

/// A problem that is not part of a campaign because it can't be read.
struct LeftOutProblem {
  CampaignProblem problem;
  std::string reason;  ///< A sentence.
};

/// Carries out single runs of a campaign; may be called by several threads at once. Of many
/// problems only the last ones that were used are kept in memory.
class HANDWAY_PLANNING_EXPORT RunExecutor {
 public:
  /// Opens all problems, to find their files.
  /// @param plugins must outlive it.
  /// @throws InputError if one can't be read or has no start or goal, or, with
  /// Campaign::skip_unreadable, if all of them can't.
  RunExecutor(Campaign campaign, const PluginManager& plugins);
  ~RunExecutor();
  RunExecutor(const RunExecutor&) = delete;
  RunExecutor& operator=(const RunExecutor&) = delete;

  /// Plans with checkers without caches from other runs.
  /// @returns nothing if it was cancelled.
  [[nodiscard]] std::optional<RunRecord> run(const RunSpec& spec, std::stop_token stop = {}) const;

  /// The campaign without the problems that were left out, each with all files that it was read
  /// from.
  [[nodiscard]] const Campaign& campaign() const { return campaign_; }
  /// Problems left out because of Campaign::skip_unreadable.
  [[nodiscard]] const std::vector<LeftOutProblem>& left_out() const { return left_out_; }

  /// Returns a problem of campaign().
  [[nodiscard]] std::shared_ptr<const PlanningProblem> problem(int index) const;

 private:
  class OpenProblems;

  Campaign campaign_;
  const PluginManager& plugins_;
  std::vector<LeftOutProblem> left_out_;
  std::unique_ptr<OpenProblems> open_;
};

/// Sets the number of waypoints and the lengths of a run's path.
HANDWAY_PLANNING_EXPORT void measure_lengths(const Path& path, const geometric::RobotModel& model,
                                             RunRecord& record);

/// Checks a run's path with check_path() at kCheckResolution, and records the first fault.
HANDWAY_PLANNING_EXPORT void check_again(const PlanningProblem& problem, const Path& path,
                                         RunRecord& record);

/// Called with finished runs, a few at a time and now and then with none; on the thread that called
/// carry_out(). Its exceptions end the work.
using TakeRecords = std::function<void(std::span<const RunRecord>)>;

/// Workers that carry out a campaign's runs: threads, or processes.
class HANDWAY_PLANNING_EXPORT RunWorkers {
 public:
  virtual ~RunWorkers() = default;

  /// Number of runs that are carried out at a time.
  [[nodiscard]] virtual int count() const = 0;

  /// Carries out `runs`, dealt out one by one, and passes every record on as soon as it is
  /// finished. Returns when all are done or, after a request by `stop`, when the last run that was
  /// not cancelled has been passed on.
  /// @throws exceptions of `take` or of a run, once no worker is busy any more.
  virtual void carry_out(const RunExecutor& executor, std::span<const RunSpec> runs,
                         const TakeRecords& take, std::stop_token stop) = 0;
};

/// Threads of this process, one run a thread.
class HANDWAY_PLANNING_EXPORT ThreadWorkers : public RunWorkers {
 public:
  /// @param count ≥ 1.
  explicit ThreadWorkers(int count) : count_(count) {}

  [[nodiscard]] int count() const override { return count_; }
  void carry_out(const RunExecutor& executor, std::span<const RunSpec> runs,
                 const TakeRecords& take, std::stop_token stop) override;

 private:
  int count_;
};

/// Several processes that work on the same campaign: one leads, the others serve it.
class HANDWAY_PLANNING_EXPORT ProcessTeam : public RunWorkers {
 public:
  [[nodiscard]] virtual bool leads() const = 0;
  /// Carries out the leader's runs until the leader ends it. @pre !leads()
  virtual void serve(const RunExecutor& executor) = 0;
  /// Sends the leader the reason why this process can't serve. @pre !leads()
  virtual void decline(const std::string& reason) = 0;
};

/// The team of processes in which `mpirun` started this one; null without mpirun.
/// @throws InputError if the library for the team is missing.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::unique_ptr<ProcessTeam> join_process_team();

}  // namespace handway::planning
