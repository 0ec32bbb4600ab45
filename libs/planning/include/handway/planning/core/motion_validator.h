#pragma once

#include "handway/geometric/collision/continuous/continuous_collision_checker.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace handway::planning {

class ThreadPool;

/// Least clearance of an end of a path, m.
inline constexpr double kLeastEndClearance = 2.0 * geometric::kLeastResolution;

/// Returns whether `q`, which is free of collision, keeps `clearance` (m) from everything, and
/// kLeastEndClearance from the limit of each constraint.
[[nodiscard]] bool keeps_end_clearance(geometric::CollisionChecker& checker, const Configuration& q,
                                       double clearance);

/// Checks validity of configurations and motions of a run: free of collision, obeying the scene's
/// constraints, keeping the request's margin. Edges are certified along the whole of their motion.
/// Checks are counted in the run's statistics.
///
/// For the planner's own thread.
class HANDWAY_PLANNING_EXPORT MotionValidator {
 public:
  /// @param problem, request, statistics, threads must outlive this object.
  /// @param is_interrupted called from any thread; once it is true, every edge is refused.
  MotionValidator(const PlanningProblem& problem, const PlanRequest& request,
                  PlanStatistics& statistics, ThreadPool& threads,
                  std::function<bool()> is_interrupted);
  ~MotionValidator();
  MotionValidator(const MotionValidator&) = delete;
  MotionValidator& operator=(const MotionValidator&) = delete;

  /// Start and goal, with the pairs that are so near there that edges keep less than the
  /// resolution. Empty if either is not a configuration of the robot.
  [[nodiscard]] const std::vector<geometric::EdgeEnd>& ends() const { return ends_; }
  /// Describes why the start (0) or the goal (1) can't be an end of a path, as "is out of limits:
  /// …"; empty if it can.
  [[nodiscard]] std::string invalid_end_reason(std::size_t end);

  /// The pair that touches in `q`, if any.
  [[nodiscard]] std::optional<int> collision(const Configuration& q);

  /// Returns whether pairs of the arm alone touch, whatever the hand does (Algorithm 1's
  /// SELFCOLLISION of an arm configuration).
  [[nodiscard]] bool arm_collides(const Configuration& q);

  /// Outcome of `count` independent configurations, the first free one in order.
  struct FirstFree {
    std::optional<int> index;                ///< Empty: none is free.
    geometric::PairIndices rejecting_pairs;  ///< One for each one before it, in order.
  };
  /// Tests `candidate(i)` for i = 0, 1, … on all threads and stops at the first free one; the
  /// result is that of testing one after the other.
  [[nodiscard]] FirstFree first_free(int count, const std::function<Configuration(int)>& candidate);

  /// A straight motion between two configurations.
  struct Edge {
    Configuration from;
    Configuration to;
  };
  /// Edges to check in order: the function returns whether the edge of an index is free, and counts
  /// it in the statistics. Meanwhile other threads check the edges that are likely to be requested
  /// next. This object must outlive it.
  [[nodiscard]] std::function<bool(std::size_t)> edges(std::vector<Edge> edges);
  /// @param most_checks as ContinuousCollisionChecker::check(): an edge so close to an obstacle
  /// that it needs more configurations is refused.
  [[nodiscard]] bool edge_free(
      const Configuration& from, const Configuration& to,
      std::uint64_t most_checks = std::numeric_limits<std::uint64_t>::max());

  /// Checks whether an edge or a configuration is free of collisions of some pairs.
  [[nodiscard]] geometric::EdgeResult edge_among(std::span<const int> pairs,
                                                 const Configuration& from,
                                                 const Configuration& to);
  [[nodiscard]] std::optional<int> collision_among(std::span<const int> pairs,
                                                   const Configuration& q);

  /// Returns whether configurations evenly spread over an edge are free of collision: at least
  /// `count` of them, 2^n - 1. Quick, and no proof; an edge that fails is not free.
  [[nodiscard]] bool edge_plausible(const Configuration& from, const Configuration& to, int count) {
    return !edge_probe(from, to, count);
  }
  /// Returns the first colliding pair among `count` samples on the edge, if any.
  [[nodiscard]] std::optional<int> edge_probe(const Configuration& from, const Configuration& to,
                                              int count);

  /// The smallest clearance along `path` and its cost in checks; at most the resolution if the run
  /// had to end before it was known. @pre its edges are free.
  [[nodiscard]] Certificate certify(const Path& path);

 private:
  struct Worker;
  struct Workers;

  /// Returns `edge`, counted in the statistics.
  const geometric::EdgeResult& counted(const geometric::EdgeResult& edge);

  const PlanningProblem& problem_;
  const PlanRequest& request_;
  PlanStatistics& statistics_;
  ThreadPool& threads_;
  geometric::PairIndices arm_pairs_;
  std::vector<geometric::EdgeEnd> ends_;
  int last_rejecting_pair_ = 0;  ///< Tested first: neighbours in space collide in the same pair.
  std::unique_ptr<Workers> workers_;
};

}  // namespace handway::planning
