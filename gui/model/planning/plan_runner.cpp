#include "model/planning/plan_runner.h"

#include "handway/planning/core/objective.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/paths/path_optimizer.h"
#include "model/planning/palm_roadmap.h"

#include <QElapsedTimer>

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <limits>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kReportEveryMs = 120;

}  // namespace

// Lives on the planner's thread; gathers progress and passes it on now and then, so that a fast
// planner does not flood the event queue.
class PlanRunner::Reporter : public RoadmapWatch {
 public:
  Reporter(PlanRunner& runner, const planning::PlanningProblem& problem, int palm_link)
      : RoadmapWatch(problem, palm_link), runner_(runner) {
    clock_.start();
  }

  void on_node(const planning::NodeEvent& node) override {
    RoadmapWatch::on_node(node);
    flush();
  }

  void on_progress(double fraction, std::string_view activity) override {
    fraction_ = fraction;
    activity_ = QString::fromUtf8(activity.data(), static_cast<int>(activity.size()));
    flush();
  }

  void notify() {
    QMetaObject::invokeMethod(
        &runner_,
        [&runner = runner_, fraction = fraction_, activity = activity_, roadmap = take()] {
          emit runner.progressed(fraction, activity);
          emit runner.roadmap_found(roadmap);
        },
        Qt::QueuedConnection);
  }

 private:
  void flush() {
    if (clock_.elapsed() < kReportEveryMs) {
      return;
    }
    clock_.restart();
    if (has_news()) {
      notify();
      return;
    }
    QMetaObject::invokeMethod(
        &runner_,
        [&runner = runner_, fraction = fraction_, activity = activity_] {
          emit runner.progressed(fraction, activity);
        },
        Qt::QueuedConnection);
  }

  PlanRunner& runner_;
  double fraction_ = 0.0;
  QString activity_;
  QElapsedTimer clock_;
};

PlanRunner::PlanRunner(QObject* parent) : QObject(parent) {
  connect(&job_, &LatestJob::failed, this, &PlanRunner::failed);
}

PlanRunner::~PlanRunner() { stop_.request_stop(); }

void PlanRunner::start(std::shared_ptr<planning::Planner> planner,
                       std::shared_ptr<const PreparedProblem> problem,
                       const planning::PlanRequest& request, int palm_link) {
  stop_ = {};
  job_.run([this, planner = std::move(planner), problem = std::move(problem), request, palm_link,
            stop = stop_.get_token()](const std::stop_token&) -> LatestJob::Answer {
    planning::PlanResult result;
    result.status = planning::PlanStatus::kCancelled;
    if (const PreparedProblem::Problem prepared = problem->wait(stop)) {
      Reporter reporter(*this, *prepared, palm_link);
      result = planner->plan(*prepared, request, stop, &reporter);
      reporter.notify();
    }
    return [this, result = std::move(result)] { emit finished(result); };
  });
  emit progressed(0.0, tr("preparing collision checks"));
}

void PlanRunner::cancel() { stop_.request_stop(); }

namespace {

void find_motion(const planning::PlanningProblem& problem,
                 const std::shared_ptr<const sampling::RecordedPostures>& postures,
                 const std::stop_token& stop, SeedOutcome& outcome) {
  outcome.motion = motion_of(problem, outcome.result.path).motion;
  if (outcome.motion) {
    outcome.curves = std::make_shared<const MotionCurves>(
        hand_curves(problem, postures, outcome.motion->trajectory, stop));
  }
}

}  // namespace

/// State that the jobs share.
struct SeedRunner::Shared {
  SeedRuns runs;
  std::stop_token stop;
  std::atomic<int> next = 0;
};

SeedRunner::~SeedRunner() { stop_.request_stop(); }

void SeedRunner::start(SeedRuns runs) {
  running_ = true;
  ++generation_;
  stop_ = {};
  to_come_ = runs.count;
  auto shared = std::make_shared<Shared>();
  shared->runs = std::move(runs);
  shared->stop = stop_.get_token();
  for (const auto& planner : shared->runs.planners) {
    jobs_.run(
        [this, shared, planner, generation = generation_] { work(shared, planner, generation); });
  }
}

void SeedRunner::cancel() {
  if (running_) {
    stop_.request_stop();
    ++generation_;
    running_ = false;
    emit ended(true);
  }
}

void SeedRunner::work(const std::shared_ptr<Shared>& shared,
                      const std::shared_ptr<planning::Planner>& planner, int generation) {
  const SeedRuns& runs = shared->runs;
  try {
    const PreparedProblem::Problem problem = runs.problem->wait(shared->stop);
    for (int i = shared->next++; problem && i < runs.count && !shared->stop.stop_requested();
         i = shared->next++) {
      SeedOutcome outcome;
      outcome.request = runs.request;
      outcome.request.seed += static_cast<std::uint64_t>(i);
      outcome.request.threads = 1;
      outcome.result = planner->plan(*problem, outcome.request, shared->stop);
      if (outcome.result.solved()) {
        find_motion(*problem, runs.postures, shared->stop, outcome);
      }
      QMetaObject::invokeMethod(
          this, [this, generation, outcome = std::move(outcome)] { take(generation, outcome); },
          Qt::QueuedConnection);
    }
  } catch (const std::exception& error) {
    QMetaObject::invokeMethod(
        this,
        [this, generation, message = QString::fromUtf8(error.what())] {
          take_failure(generation, message);
        },
        Qt::QueuedConnection);
  }
}

void SeedRunner::take(int generation, const SeedOutcome& outcome) {
  if (generation != generation_) {
    return;
  }
  emit found(outcome);
  if (generation == generation_ && --to_come_ == 0) {
    running_ = false;
    emit ended(false);
  }
}

void SeedRunner::take_failure(int generation, const QString& message) {
  if (generation == generation_) {
    stop_.request_stop();
    ++generation_;
    running_ = false;
    emit failed(message);
  }
}

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kReportEvery = 0.1;  // s

double since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

planning::PlanRequest unlimited(planning::PlanRequest request) {
  request.time_limit_s = std::numeric_limits<double>::infinity();
  return request;
}

}  // namespace

/// An optimisation that can go on. Nothing interrupts its context: rounds are done to their end.
struct OptimizeRunner::Work {
  Work(const OptimizeTask& task, PreparedProblem::Problem of)
      : problem(std::move(of)),
        found(task.found),
        weights(task.objective.weights(*problem)),
        context(*problem, unlimited(task.request), {}, silent),
        optimizer(context, weights, found.path, task.request.seed,
                  planning::PathOptimizer::kThorough),
        figures(*problem, {.human_likeness = 1.0}),
        cost_before(optimizer.cost()) {}

  PreparedProblem::Problem problem;
  planning::PlanResult found;  ///< Result it began with.
  planning::ObjectiveWeights weights;
  planning::Observer silent;
  planning::PlanningContext context;
  planning::PathOptimizer optimizer;
  planning::Objective figures;
  double cost_before;
  double seconds = 0.0;
  std::uint64_t checks = 0;
};

OptimizeRunner::OptimizeRunner(QObject* parent) : QObject(parent) {
  connect(&job_, &LatestJob::failed, this, &OptimizeRunner::failed);
}

OptimizeRunner::~OptimizeRunner() { stop_.request_stop(); }

void OptimizeRunner::start(OptimizeTask task) {
  stop_ = {};
  const int generation = ++generation_;
  job_.run([this, generation, task = std::move(task),
            stop = stop_.get_token()](const std::stop_token& discarded) -> LatestJob::Answer {
    const PreparedProblem::Problem problem = task.problem->wait(discarded);
    if (!problem) {
      return nullptr;
    }
    take_up(task, problem);
    OptimizeOutcome outcome = run(task, generation, stop, discarded);
    return [this, outcome = std::move(outcome)] { emit finished(outcome); };
  });
}

void OptimizeRunner::stop() { stop_.request_stop(); }

void OptimizeRunner::discard() {
  ++generation_;
  stop_.request_stop();
  job_.cancel();
}

void OptimizeRunner::take_up(const OptimizeTask& task, const PreparedProblem::Problem& problem) {
  const bool goes_on = work_ && work_->problem == problem &&
                       work_->weights == task.objective.weights(*problem) &&
                       work_->optimizer.path().waypoints == task.found.path.waypoints;
  if (!goes_on) {
    work_ = std::make_unique<Work>(task, problem);
  }
}

OptimizeProgress OptimizeRunner::progress(double seconds, double limit_s) const {
  OptimizeProgress progress;
  progress.path = work_->optimizer.path();
  progress.seconds = seconds;
  progress.limit_s = limit_s;
  progress.cost_before = work_->cost_before;
  progress.cost = work_->optimizer.cost();
  double outside = 0.0;
  for (std::size_t i = 0; i + 1 < progress.path.waypoints.size(); ++i) {
    const planning::MotionSums motion =
        work_->figures.measure(work_->figures.point(progress.path.waypoints[i]),
                               work_->figures.point(progress.path.waypoints[i + 1]));
    progress.length += motion.length;
    outside += motion.outside;
  }
  if (work_->problem->basis && progress.length > 0.0) {
    progress.hand_distance = outside / progress.length;
  }
  progress.converged = work_->optimizer.converged();
  return progress;
}

OptimizeOutcome OptimizeRunner::run(const OptimizeTask& task, int generation,
                                    const std::stop_token& stop, const std::stop_token& discarded) {
  const Clock::time_point begin = Clock::now();
  const double limit = task.request.optimize_s;
  double reported = -kReportEvery;
  work_->checks += work_->optimizer.advance_in_rounds([&](std::uint64_t) {
    const double seconds = since(begin);
    if (seconds - reported >= kReportEvery) {
      reported = seconds;
      QMetaObject::invokeMethod(
          this,
          [this, generation, so_far = progress(seconds, limit)] {
            if (generation == generation_ && is_running()) {
              emit progressed(so_far);
            }
          },
          Qt::QueuedConnection);
    }
    return seconds < limit && !stop.stop_requested() && !discarded.stop_requested();
  });
  OptimizeOutcome outcome;
  outcome.last = progress(since(begin), limit);
  work_->seconds += outcome.last.seconds;
  planning::PlanResult& result = outcome.result;
  result = work_->found;
  result.status = planning::PlanStatus::kSolved;
  result.path = outcome.last.path;
  result.smoothing_s += work_->seconds;
  result.optimize_checks += work_->checks;
  outcome.repeatable = work_->found.optimize_checks == 0;
  result.statistics += work_->context.statistics();
  result.reason =
      fmt::format("Optimised for {:.1f} s with {} checks: cost {:.4g}, before {:.4g}.{}",
                  work_->seconds, work_->checks, outcome.last.cost, outcome.last.cost_before,
                  outcome.last.converged ? " Converged." : "");
  planning::PlanningContext certifying(*work_->problem, unlimited(task.request), discarded,
                                       work_->silent);
  result.certificate = certifying.validator().certify(result.path);
  return outcome;
}

TimingRunner::TimingRunner(QObject* parent) : QObject(parent) {
  connect(&job_, &LatestJob::failed, this, &TimingRunner::failed);
}

void TimingRunner::start(std::shared_ptr<const PreparedProblem> problem, planning::Path path,
                         const std::string& name, const planning::TimingOptions& options) {
  job_.run([this, problem = std::move(problem), path = std::move(path), name,
            options](const std::stop_token& stop) -> LatestJob::Answer {
    const PreparedProblem::Problem ready = problem->wait(stop);
    if (!ready) {
      return {};
    }
    const auto motion =
        std::make_shared<const planning::TimedPath>(time_path(*ready, path, name, options));
    return [this, motion, revision = problem->revision()] { emit timed({motion, revision}); };
  });
}

}  // namespace handway::gui
