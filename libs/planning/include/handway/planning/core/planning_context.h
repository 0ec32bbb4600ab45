#pragma once

#include "handway/geometric/collision/edge_checker.h"
#include "handway/planning/core/observer.h"
#include "handway/planning/core/planner.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/sampling/samplers/sampler.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

namespace handway::planning {

/// What a planner works with during one run: the problem, the collision
/// questions with their counters, time and cancellation, and threads.
///
/// For the planner's own thread, apart from the functions handed to parallel().
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

  /// Start and goal, with what is so near there that edges keep less than the resolution. Empty if
  /// either is no configuration of the robot.
  [[nodiscard]] const std::vector<geometric::EdgeEnd>& ends() const { return ends_; }

  /// kCancelled or kTimeLimit once the run has to end.
  [[nodiscard]] std::optional<PlanStatus> interruption() const;

  /// The pair that touches in `q`, if any.
  [[nodiscard]] std::optional<int> collision(const Configuration& q);

  /// The same for pairs of the arm alone, whatever the hand does (Algorithm 1's
  /// SELFCOLLISION of an arm configuration).
  [[nodiscard]] bool arm_collides(const Configuration& q);

  /// Outcome of `count` independent configurations, the first free one in order.
  struct FirstFree {
    std::optional<int> index;          ///< Nothing: none is free.
    std::vector<int> rejecting_pairs;  ///< One for each of those before it, in order.
  };
  /// Asks `candidate(i)` for i = 0, 1, … on all threads and stops at the first
  /// free one; the answer is that of asking one after the other.
  [[nodiscard]] FirstFree first_free(int count, const std::function<Configuration(int)>& candidate);

  struct Edge {
    Configuration from;
    Configuration to;
  };
  /// Edges to ask for in order. When one is asked for, other threads check those
  /// that are likely to be asked for next.
  class HANDWAY_PLANNING_EXPORT EdgeBatch {
   public:
    /// Is edge `index` free? Adds to the statistics when first asked for.
    [[nodiscard]] bool is_free(std::size_t index);

   private:
    friend class PlanningContext;
    EdgeBatch(PlanningContext& context, std::vector<Edge> edges);
    void check_from(std::size_t first);

    PlanningContext& context_;
    std::vector<Edge> edges_;
    std::vector<std::optional<geometric::EdgeResult>> results_;
  };
  [[nodiscard]] EdgeBatch edges(std::vector<Edge> edges);
  /// @param most_checks as EdgeChecker::check(): an edge so close to something that
  /// more configurations would have to be looked at is refused. Every edge is once the
  /// run has to end.
  [[nodiscard]] bool edge_free(
      const Configuration& from, const Configuration& to,
      std::uint64_t most_checks = std::numeric_limits<std::uint64_t>::max());

  /// Whether an edge or a configuration is free of some pairs, and of which it is not.
  [[nodiscard]] geometric::EdgeResult edge_among(std::span<const int> pairs,
                                                 const Configuration& from,
                                                 const Configuration& to);
  [[nodiscard]] std::optional<int> collision_among(std::span<const int> pairs,
                                                   const Configuration& q);

  /// Are configurations evenly spread over an edge free of collision? At least
  /// `count` of them, 2^n - 1. Quick, and no proof; an edge that fails is not free.
  [[nodiscard]] bool edge_plausible(const Configuration& from, const Configuration& to, int count) {
    return !edge_probe(from, to, count);
  }
  /// The same; a pair that touches, if the edge fails.
  [[nodiscard]] std::optional<int> edge_probe(const Configuration& from, const Configuration& to,
                                              int count);

  /// How the samplers of make_sampler() choose their points; at first at random.
  void set_sampler(sampling::SamplerKind kind) { sampler_ = kind; }
  /// Where a search takes its points of the unit cube from. @param valid what samplers that look
  /// for obstacles ask; on this context's thread.
  [[nodiscard]] std::unique_ptr<sampling::Sampler> make_sampler(
      int dimension, std::uint64_t seed, sampling::ValidityPredicate valid) const;

  /// A context for a search that runs beside others on the same problem: with one
  /// thread and statistics of its own, and this context's clock, time limit and
  /// cancellation. @param stop ends it alone. Both must outlive it, and so must this context.
  [[nodiscard]] std::unique_ptr<PlanningContext> make_child(Observer& observer,
                                                            std::stop_token stop) const;
  /// The same for a search between other ends, in the same scene. @param problem must outlive it.
  [[nodiscard]] std::unique_ptr<PlanningContext> make_child(const PlanningProblem& problem,
                                                            Observer& observer,
                                                            std::stop_token stop) const;

  /// Calls `work(0)` … `work(count - 1)` on all threads; one after the other on a single one.
  void run_on_threads(int count, const std::function<void(int)>& work);

  /// Counters that every planner shares; the planner adds its own.
  [[nodiscard]] PlanStatistics& statistics() { return statistics_; }
  /// Notes a rejected sample drawn at `step` of the arm segment.
  void count_rejection(int pair, double step);

  /// The smallest clearance along `path` and what it took to know it; the resolution
  /// at most if the run had to end before it was known. @pre its edges are free.
  [[nodiscard]] Certificate certify(const Path& path);

 private:
  struct Worker;
  struct Threads;

  Worker& own_worker();
  /// `edge`, once the statistics know of it.
  const geometric::EdgeResult& counted(const geometric::EdgeResult& edge);

  const PlanningProblem& problem_;
  const PlanningContext* parent_ = nullptr;
  PlanRequest request_;
  sampling::SamplerKind sampler_ = sampling::SamplerKind::kRandom;
  std::stop_token stop_;
  Observer& observer_;
  std::chrono::steady_clock::time_point begin_;
  std::vector<int> arm_pairs_;
  std::vector<geometric::EdgeEnd> ends_;
  PlanStatistics statistics_;
  int last_rejecting_pair_ = 0;  ///< Asked first: neighbours in space collide in the same pair.
  std::unique_ptr<Threads> threads_;
};

}  // namespace handway::planning
