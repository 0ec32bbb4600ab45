#pragma once

#include "handway/planning/core/motion_validator.h"
#include "handway/planning/core/observer.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/sampling/samplers/sampler.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

namespace handway::planning {

/// Environment of a planner during one run: the problem, the validator of motions, samplers,
/// statistics, time and cancellation, and threads.
///
/// For the planner's own thread, apart from the functions passed to run_on_threads().
class HANDWAY_PLANNING_EXPORT PlanningContext {
 public:
  PlanningContext(const PlanningProblem& problem, const PlanRequest& request, std::stop_token stop,
                  Observer& observer);
  ~PlanningContext();
  PlanningContext(const PlanningContext&) = delete;
  PlanningContext& operator=(const PlanningContext&) = delete;

  [[nodiscard]] const PlanningProblem& problem() const { return problem_; }
  [[nodiscard]] const PlanRequest& request() const { return request_; }
  [[nodiscard]] Observer& observer() { return observer_; }
  [[nodiscard]] double elapsed_s() const;

  /// kCancelled or kTimeLimit once the run has to end.
  [[nodiscard]] std::optional<PlanStatus> interruption() const;

  /// Checker of configurations and motions.
  [[nodiscard]] MotionValidator& validator() { return *validator_; }

  /// Sets how the samplers of make_sampler() choose their points; at first at random.
  void set_sampler(sampling::SamplerKind kind) { sampler_ = kind; }
  /// Makes the sampler of points of the unit cube for a search. @param valid predicate for samplers
  /// that look for obstacles; called on this context's thread.
  [[nodiscard]] std::unique_ptr<sampling::Sampler> make_sampler(
      int dimension, std::uint64_t seed, sampling::ValidityPredicate valid) const;

  /// A context for a search that runs beside others, or between other ends in the same scene: with
  /// one thread and its own statistics, and this context's clock, time limit and cancellation.
  /// @param stop ends it alone. All must outlive it, and so must this context.
  [[nodiscard]] std::unique_ptr<PlanningContext> make_child(const PlanningProblem& problem,
                                                            Observer& observer,
                                                            std::stop_token stop) const;

  /// Calls `work(0)` … `work(count - 1)` on all threads; one after the other on a single one.
  void run_on_threads(int count, const std::function<void(int)>& work);

  /// Counters shared by all planners; the planner adds its own.
  [[nodiscard]] PlanStatistics& statistics() { return statistics_; }
  /// Records a rejected sample at `step` of the arm segment.
  void count_rejection(int pair, double step);

 private:
  const PlanningProblem& problem_;
  const PlanningContext* parent_ = nullptr;
  PlanRequest request_;
  sampling::SamplerKind sampler_ = sampling::SamplerKind::kRandom;
  std::stop_token stop_;
  Observer& observer_;
  std::chrono::steady_clock::time_point begin_;
  PlanStatistics statistics_;
  std::unique_ptr<ThreadPool> threads_;
  std::unique_ptr<MotionValidator> validator_;
};

}  // namespace handway::planning
