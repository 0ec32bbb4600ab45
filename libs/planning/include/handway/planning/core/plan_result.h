#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::planning {

/// Options of a planner's run.
struct PlanRequest {
  std::uint64_t seed = 1;
  int threads = 1;  ///< ≥ 1; the result does not depend on it.
  double time_limit_s = std::numeric_limits<double>::infinity();
  double resolution = 5e-5;  ///< m; edges closer than this to anything are refused.
  /// Distance of the robot from all else, where the ends allow it; see ContinuousCollisionChecker.
  /// m, ≥ 0.
  double margin = 0.0;
  double optimize_s = 0.0;  ///< Time for optimising the path found, s.
};

/// Outcome of planning.
enum class PlanStatus {
  kSolved,
  kStartInvalid,  ///< In collision or out of limits.
  kGoalInvalid,   ///< In collision or out of limits.
  kSamplesSpent,  ///< The sample budget is used up.
  kTimeLimit,
  kCancelled,
  kStalled,     ///< Sampling is exhausted: going on would change nothing.
  kInfeasible,  ///< No path exists.
};

/// More clearance than this (m) is not distinguished.
inline constexpr double kFarClearance = 0.05;

/// Certificate of a path: every configuration on it has at least this clearance, in every checked
/// pair.
struct Certificate {
  double resolution = 0.0;  ///< m; along edges, moving pairs keep at least this; …
  /// … but next to an end with less, half of the distance there; see
  /// ContinuousCollisionChecker.
  double resolution_at_start = 0.0;
  double resolution_at_goal = 0.0;
  double min_clearance = 0.0;  ///< m, a lower bound over the whole path, at most a fifth too low.
  std::uint64_t checks = 0;    ///< Configurations checked.
};

/// Counts of a planner's work.
struct HANDWAY_PLANNING_EXPORT PlanStatistics {
  std::uint64_t samples = 0;  ///< Hand trials in pmd-prm (numSamples); samples elsewhere.
  std::uint64_t nodes = 0;    ///< Roadmap or tree nodes, with start and goal.
  std::uint64_t edges = 0;
  std::uint64_t passes = 0;      ///< Sweeps of the corridor.
  std::uint64_t max_trials = 0;  ///< Most (j, h) trials that one hypercube needed (Table 2).
  double final_rho_a = 0.0;
  std::vector<std::uint64_t> nodes_per_pmds;  ///< Index: number of PMDs used.
  std::uint64_t node_checks = 0;              ///< Configurations checked as samples.
  std::uint64_t edge_checks = 0;              ///< Configurations checked along edges.
  std::uint64_t edges_tested = 0;
  double sampling_s = 0.0;
  double connection_s = 0.0;
  /// Rejected samples by pair or constraint of the checker's world; for a planner's result …
  std::vector<std::uint64_t> rejections_per_pair;
  /// … by their names, for a constraint with an empty second one.
  std::map<std::pair<std::string, std::string>, std::uint64_t> rejections;
  std::vector<std::uint64_t> rejections_per_tenth;  ///< Counts per tenth of the arm segment.

  /// Adds another search's statistics: sums counts and times, and takes the largest of the rest.
  PlanStatistics& operator+=(const PlanStatistics& other);

  /// Formats "1 sample", "20 samples".
  [[nodiscard]] std::string samples_text() const;
  /// Configurations checked while planning and smoothing.
  [[nodiscard]] std::uint64_t checks() const { return node_checks + edge_checks; }
};

/// Adds the time from construction to stop(), or to destruction, to a sum of seconds.
class PhaseClock {
 public:
  explicit PhaseClock(double& sum) : sum_(sum), begin_(Clock::now()) {}
  ~PhaseClock() { stop(); }
  PhaseClock(const PhaseClock&) = delete;
  PhaseClock& operator=(const PhaseClock&) = delete;

  void stop() {
    if (running_) {
      sum_ += std::chrono::duration<double>(Clock::now() - begin_).count();
      running_ = false;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  double& sum_;
  Clock::time_point begin_;
  bool running_ = true;
};

/// Progress of a search from both ends, along the straight motion from start to goal.
struct SearchReach {
  double from_start = 0.0;        ///< The farthest that is connected to the start, in [0, 1].
  double from_goal = 1.0;         ///< The nearest to the start that is connected to the goal.
  std::uint64_t start_nodes = 0;  ///< Free configurations that are connected to the start.
  std::uint64_t goal_nodes = 0;   ///< Free configurations connected to the goal.
  std::uint64_t nodes = 0;        ///< All nodes found.
  geometric::Configuration farthest_from_start = {};  ///< The one at `from_start`.
  geometric::Configuration farthest_from_goal = {};   ///< The one at `from_goal`.
};

/// A pair that is nearer at an end of the path than the requested margin. Next to this end it keeps
/// less; everything else keeps the margin along the whole path.
struct OutOfMargin {
  bool at_goal = false;  ///< Else at the start.
  geometric::NamedPair pair;
};

/// The cost of an optimised path by the planner's objective, beside a cost that no path between its
/// ends is below (Objective::least_cost()).
struct PathCost {
  double cost = 0.0;
  double least = 0.0;

  /// Largest share of the cost that another path could save, in [0, 1].
  [[nodiscard]] double gap() const { return cost > 0.0 ? std::max(0.0, 1.0 - least / cost) : 0.0; }
};

/// The outcome of planning. `path` is empty unless the status is kSolved.
struct PlanResult {
  PlanStatus status = PlanStatus::kSamplesSpent;
  std::string reason;  ///< One sentence for display.
  Path path;
  Certificate certificate;
  PlanStatistics statistics;
  std::vector<OutOfMargin> out_of_margin;
  /// Index into PlanningProblem::goals of the goal that the path reaches, if there are goal poses.
  std::optional<std::size_t> goal;
  std::optional<SearchReach> reach;  ///< Without a path; nothing if the planner shows no nodes.
  double time_s = 0.0;               ///< Planning alone, wall clock.
  double smoothing_s = 0.0;          ///< Smoothing and optimising, wall clock.
  /// Checks allowed for optimising, in whole rounds; as the parameter of this name they give the
  /// same path again.
  std::uint64_t optimize_checks = 0;
  std::optional<PathCost> cost;  ///< Cost of an optimised path.

  [[nodiscard]] bool solved() const { return status == PlanStatus::kSolved; }
};

/// Word in reports: "solved", "start invalid", …
[[nodiscard]] HANDWAY_PLANNING_EXPORT const char* to_string(PlanStatus status);

/// Explains why a search found no path, one sentence each, as far as it is known: its progress from
/// both ends, whether an end is enclosed, which bodies collided in most rejected samples and where
/// along the motion, and remedies to try. Empty for a path, and if an end is not valid: the
/// result's reason has that.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<std::string> explain_failure(
    const PlanResult& result);

/// Counts the edits of the inputs of results. Two revisions of one document are equal if and only
/// if no edit was made between them; 0 in all is before the first.
struct Revision {
  std::uint64_t scene = 0;   ///< Objects, attachments, start and goal.
  std::uint64_t robot = 0;   ///< Models, and where the robots are mounted.
  std::uint64_t basis = 0;   ///< The hand's postures.
  std::uint64_t limits = 0;  ///< Joint ranges, velocities, accelerations.

  friend bool operator==(const Revision&, const Revision&) = default;
};

/// A result, with its revision: out of date once the document has another one.
template <typename T>
struct Derived {
  T value;
  Revision made_from;
};

}  // namespace handway::planning
