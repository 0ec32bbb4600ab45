#include "model/planning/seed_runner.h"

#include <atomic>
#include <exception>
#include <utility>

namespace handway::gui {
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

}  // namespace handway::gui
