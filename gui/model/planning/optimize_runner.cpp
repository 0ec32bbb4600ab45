#include "model/planning/optimize_runner.h"

#include "handway/planning/core/objective.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/paths/anytime_optimizer.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace handway::gui {
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
        optimizer(context, weights, found.path, task.request.seed),
        figures(*problem, {.human_likeness = 1.0}),
        cost_before(optimizer.cost()) {}

  PreparedProblem::Problem problem;
  planning::PlanResult found;  ///< Result it began with.
  planning::ObjectiveWeights weights;
  planning::Observer silent;
  planning::PlanningContext context;
  planning::AnytimeOptimizer optimizer;
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
  progress.cost = {work_->optimizer.cost(), work_->optimizer.least_cost()};
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
  work_->optimizer.set_patience(std::isfinite(limit) ? std::numeric_limits<std::uint64_t>::max()
                                                     : planning::AnytimeOptimizer::kPatience);
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
  result.cost = outcome.last.cost;
  outcome.repeatable = work_->found.optimize_checks == 0;
  result.statistics += work_->context.statistics();
  result.reason = fmt::format(
      "Optimised for {:.1f} s with {} checks: cost {:.4g}, before {:.4g}, no path below "
      "{:.4g}.{}",
      work_->seconds, work_->checks, outcome.last.cost.cost, outcome.last.cost_before,
      outcome.last.cost.least, outcome.last.converged ? " Converged." : "");
  planning::PlanningContext certifying(*work_->problem, unlimited(task.request), discarded,
                                       work_->silent);
  result.certificate = certifying.validator().certify(result.path);
  return outcome;
}

}  // namespace handway::gui
