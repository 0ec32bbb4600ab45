#include "handway/planning/campaigns/run_workers.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "handway/planning/core/objective.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/paths/path_file.h"
#include "handway/planning/queries/motion_likeness.h"

#include <boost/dll/runtime_symbol_info.hpp>
#include <boost/dll/shared_library.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <ctime>
#include <deque>
#include <exception>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <variant>

namespace handway::planning {
namespace {

namespace fs = std::filesystem;

/// Processor time of the calling thread, s.
double thread_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

RunRecord record_of(const RunSpec& spec, const PlanResult& result,
                    const geometric::RobotModel& model) {
  RunRecord record;
  static_cast<PlanStatistics&>(record) = result.statistics;
  record.rejections_per_pair.clear();
  record.rejections.clear();
  record.rejections_per_tenth.clear();
  record.spec = spec;
  record.solved = result.solved();
  record.status = to_string(result.status);
  record.reason = result.reason;
  record.time_s = result.time_s;
  record.smoothing_s = result.smoothing_s;
  record.resolution = result.certificate.resolution;
  record.min_clearance = result.certificate.min_clearance;
  record.certificate_checks = result.certificate.checks;
  if (result.solved()) {
    record.path = to_csv(result.path, model);
    measure_lengths(result.path, model, record);
  }
  return record;
}

PathMeasures measures_of(const PlanningProblem& problem, const Path& path) {
  PathMeasures measures;
  if (const auto likeness = path_quality(problem, path).human_likeness) {
    measures.to_subspace = likeness->mean;
  }
  const auto timed = likeness_trajectory(problem, path);
  if (const auto* trajectory = std::get_if<Trajectory>(&timed)) {
    const MotionLikeness likeness = motion_likeness(problem, *trajectory, nullptr);
    const auto sparc = [](const std::optional<MovementSmoothness>& smoothness) {
      return smoothness ? smoothness->spectral_arc_length : PathMeasures::kNone;
    };
    measures.hand_sparc = sparc(likeness.hand);
    measures.palm_sparc = sparc(likeness.palm);
    measures.arm_deviation = likeness.deviation ? likeness.deviation->arm : PathMeasures::kNone;
  }
  return measures;
}

PlanningProblem open_problem(const fs::path& file, const PluginManager& plugins) {
  const SceneState loaded = load_scene(file, plugins);
  return make_problem(loaded.scene, loaded.basis);
}

}  // namespace

void measure_lengths(const Path& path, const geometric::RobotModel& model, RunRecord& record) {
  record.path_nodes = path.waypoints.size();
  record.path_length = 0.0;
  record.l2_length = 0.0;
  for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
    record.path_length += normalised_distance(model, path.waypoints[i - 1], path.waypoints[i]);
    record.l2_length += (path.waypoints[i] - path.waypoints[i - 1]).norm();
  }
}

void check_again(const PlanningProblem& problem, const Path& path, RunRecord& record) {
  const PathCheckResult check = check_path(problem, path, kCheckResolution);
  record.is_checked = true;
  record.fault = check.valid() ? std::string() : check.faults.front();
}

/// The problems that were used last.
class RunExecutor::OpenProblems {
 public:
  [[nodiscard]] std::shared_ptr<const PlanningProblem> find(int index) {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(problems_, index, &Entry::first);
    if (found == problems_.end()) {
      return nullptr;
    }
    std::rotate(problems_.begin(), found, std::next(found));
    return problems_.front().second;
  }

  void add(int index, std::shared_ptr<const PlanningProblem> problem) {
    constexpr std::size_t kMost = 64;
    const std::lock_guard lock(mutex_);
    problems_.emplace_front(index, std::move(problem));
    if (problems_.size() > kMost) {
      problems_.pop_back();
    }
  }

 private:
  using Entry = std::pair<int, std::shared_ptr<const PlanningProblem>>;

  std::mutex mutex_;
  std::deque<Entry> problems_;  ///< The one that was used last comes first.
};

RunExecutor::RunExecutor(Campaign campaign, const PluginManager& plugins)
    : campaign_(std::move(campaign)), plugins_(plugins), open_(std::make_unique<OpenProblems>()) {
  std::vector<CampaignProblem> problems;
  for (CampaignProblem& problem : campaign_.problems) {
    const geometric::FilesRead notes;
    try {
      auto opened = std::make_shared<const PlanningProblem>(open_problem(problem.file, plugins));
      problem.files = notes.files();
      open_->add(static_cast<int>(problems.size()), std::move(opened));
      problems.push_back(problem);
    } catch (const geometric::InputError& error) {
      if (!campaign_.skip_unreadable) {
        throw;
      }
      left_out_.push_back({problem, error.what()});
    }
  }
  if (problems.empty() && !left_out_.empty()) {
    throw geometric::InputError({left_out_.front().problem.file.string(), "",
                                 fmt::format("none of {} problems that can be read, the first "
                                             "because: {}",
                                             left_out_.size(), left_out_.front().reason),
                                 "at least one", ""});
  }
  campaign_.problems = std::move(problems);
}

RunExecutor::~RunExecutor() = default;

std::shared_ptr<const PlanningProblem> RunExecutor::problem(int index) const {
  if (auto known = open_->find(index)) {
    return known;
  }
  auto opened = std::make_shared<const PlanningProblem>(
      open_problem(campaign_.problems[static_cast<std::size_t>(index)].file, plugins_));
  open_->add(index, opened);
  return opened;
}

std::optional<RunRecord> RunExecutor::run(const RunSpec& spec, std::stop_token stop) const {
  const std::shared_ptr<const PlanningProblem> opened = problem(spec.problem);
  const PlanningProblem& problem = *opened;
  const std::unique_ptr<Planner> planner =
      make_planner(campaign_.planners[static_cast<std::size_t>(spec.planner)], plugins_.planners());
  PlanRequest request;
  request.seed = spec.seed;
  request.threads = campaign_.threads;
  request.time_limit_s = campaign_.time_limit_s;
  try {
    const double begin = thread_time();
    const PlanResult result = planner->plan(problem, request, std::move(stop));
    const double cpu_s = thread_time() - begin;
    if (result.status == PlanStatus::kCancelled) {
      return std::nullopt;
    }
    RunRecord record = record_of(spec, result, problem.model());
    if (campaign_.threads == 1) {
      record.cpu_s = cpu_s;
    }
    if (result.solved() && campaign_.check_paths) {
      check_again(problem, result.path, record);
    }
    if (result.solved() && campaign_.measure_motions) {
      record.measures = measures_of(problem, result.path);
    }
    return record;
  } catch (const geometric::InputError& error) {  // it needs what the problem has not
    RunRecord record;
    record.spec = spec;
    record.status = kRefused;
    record.reason = error.what();
    return record;
  }
}

std::unique_ptr<ProcessTeam> join_process_team() {
  constexpr const char* kEntryPoint = "handway_process_team";
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) {  // set by Open MPI's mpirun
    return nullptr;
  }
  const boost::filesystem::path file = boost::dll::program_location().parent_path().parent_path() /
                                       "lib" / "handway-mpi" / "process_team_mpi.so";
  // Stays loaded to the very end: MPI's own threads and handlers live there.
  static auto& library = *new boost::dll::shared_library;
  try {
    library.load(file, boost::dll::load_mode::rtld_global | boost::dll::load_mode::rtld_now);
    return std::unique_ptr<ProcessTeam>(library.get<ProcessTeam*()>(kEntryPoint)());
  } catch (const std::exception& error) {
    throw geometric::InputError({file.string(), "", error.what(),
                                 "the library that talks to mpirun",
                                 "Build Handway with MPI, or start it without mpirun"});
  }
}

void ThreadWorkers::carry_out(const RunExecutor& executor, std::span<const RunSpec> runs,
                              const TakeRecords& take, std::stop_token stop) {
  constexpr std::chrono::milliseconds kMoment(200);  // between two calls of `take`, at most
  int busy =
      static_cast<int>(std::clamp<std::size_t>(runs.size(), 1, static_cast<std::size_t>(count_)));
  std::mutex mutex;  // of `busy`, `records` and `failure`
  std::condition_variable changed;
  std::vector<RunRecord> records;  // for the one that takes them
  std::exception_ptr failure;      // of the first that failed
  const auto change = [&](const auto& what) {
    const std::lock_guard lock(mutex);
    what();
    changed.notify_one();
  };
  std::stop_source all;
  const std::stop_callback forward(stop, [&] { all.request_stop(); });
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < runs.size() && !all.stop_requested(); i = next++) {
        if (std::optional<RunRecord> record = executor.run(runs[i], all.get_token())) {
          change([&] { records.push_back(std::move(*record)); });
        }
      }
    } catch (...) {
      all.request_stop();
      change([&] { failure = failure ? failure : std::current_exception(); });
    }
    change([&] { --busy; });
  };
  std::vector<std::jthread> threads;
  try {
    for (int i = 0, workers = busy; i < workers; ++i) {
      threads.emplace_back(work);
    }
    for (bool last = false; !last;) {
      std::unique_lock lock(mutex);
      changed.wait_for(lock, kMoment, [&] { return !records.empty() || busy == 0; });
      const std::vector<RunRecord> batch = std::exchange(records, {});
      last = busy == 0;
      lock.unlock();
      take(batch);
    }
    if (failure) {
      std::rethrow_exception(failure);
    }
  } catch (...) {
    all.request_stop();
    throw;  // the threads are joined first
  }
}

}  // namespace handway::planning
