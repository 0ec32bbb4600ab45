#include "handway/planning/campaigns/run_workers.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/paths/path_file.h"

#include <boost/dll/runtime_symbol_info.hpp>
#include <boost/dll/shared_library.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>
#include <utility>

namespace handway::planning {
namespace {

double length_of(const Path& path, const geometric::RobotModel& model) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
    length += normalised_distance(model, path.waypoints[i - 1], path.waypoints[i]);
  }
  return length;
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
    record.path_nodes = result.path.waypoints.size();
    record.path_length = length_of(result.path, model);
    record.path = to_csv(result.path, model);
  }
  return record;
}

}  // namespace

RunExecutor::RunExecutor(Campaign campaign, const PluginManager& plugins)
    : campaign_(std::move(campaign)), plugins_(plugins) {
  for (CampaignProblem& problem : campaign_.problems) {
    const geometric::FilesRead notes;
    const SceneState loaded = load_scene(problem.file, plugins);
    problem.files = notes.files();
    problems_.push_back(make_problem(loaded.scene, loaded.basis));
  }
}

std::optional<RunRecord> RunExecutor::run(const RunSpec& spec, std::stop_token stop) const {
  const PlanningProblem& problem = problems_[static_cast<std::size_t>(spec.problem)];
  const std::unique_ptr<Planner> planner =
      make_planner(campaign_.planners[static_cast<std::size_t>(spec.planner)], plugins_.planners());
  PlanRequest request;
  request.seed = spec.seed;
  request.threads = campaign_.threads;
  request.time_limit_s = campaign_.time_limit_s;
  try {
    const PlanResult result = planner->plan(problem, request, std::move(stop));
    if (result.status == PlanStatus::kCancelled) {
      return std::nullopt;
    }
    return record_of(spec, result, problem.model());
  } catch (const geometric::InputError& error) {  // it needs what the problem has not
    RunRecord record;
    record.spec = spec;
    record.status = "refused";
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
