#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/planning/core/planning_problem.h"

#include <string_view>

namespace handway::planning {

/// A roadmap or tree node for an observer.
struct NodeEvent {
  int id = 0;
  const geometric::Configuration& q;
  int pmd_count = 0;   ///< Principal directions used for the sample; 0: none.
  double step = 0.0;   ///< Place on the arm segment, [0, 1]: its hypercube or arm_progress().
  double rho_a = 0.0;  ///< Half-side of the hypercube it was sampled from.
  int search = 0;      ///< Number of the search that found it, if several run in parallel.
};

class AlgorithmObserver;

/// Callbacks of a planner while it plans, called on the planner's own thread and in the same order
/// on every run. By default they do nothing.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void on_node(const NodeEvent& /*node*/) {}
  virtual void on_edge(int /*from*/, int /*to*/) {}
  /// The search among several whose path is the planner's.
  virtual void on_winner(int /*search*/) {}
  /// Called with the stretch of the arm segment that is still being searched.
  virtual void on_search_range(double /*d_ini*/, double /*d_goal*/) {}
  /// Called with a free path from start to goal that is being optimised.
  virtual void on_path(const Path& /*path*/) {}
  /// `fraction` of the sample budget that is spent, in [0, 1], and the present activity.
  virtual void on_progress(double /*fraction*/, std::string_view /*activity*/) {}

  /// Observer of the steps of the paper's algorithms, too; null: none.
  [[nodiscard]] virtual AlgorithmObserver* algorithm() { return nullptr; }
};

/// A line of one of the paper's listings (section 5, Algorithms 1 to 4), counted from the first
/// statement, lines that only end a block included.
struct AlgorithmLine {
  int algorithm = 0;
  int line = 0;

  friend bool operator==(const AlgorithmLine&, const AlgorithmLine&) = default;
};

/// Lines of the algorithms at which a planner reports something.
namespace algorithm_lines {
inline constexpr AlgorithmLine kArmFree{1, 4};         ///< Is the arm's sample self-collision-free?
inline constexpr AlgorithmLine kNoArm{1, 9};           ///< All samples for the arm are used up.
inline constexpr AlgorithmLine kHandFreeOfSelf{2, 6};  ///< Is the sample in self-collision?
inline constexpr AlgorithmLine kHandFree{2, 7};        ///< Does it collide with an object?
inline constexpr AlgorithmLine kAddNode{3, 1};         ///< The sample becomes a node.
inline constexpr AlgorithmLine kNeighbours{3, 2};      ///< The nodes nearest to it.
inline constexpr AlgorithmLine kSameComponent{3, 4};   ///< Are the two joined already?
inline constexpr AlgorithmLine kLocalPlan{3, 5};   ///< Is the straight motion between them free?
inline constexpr AlgorithmLine kAddEdge{3, 6};     ///< The motion becomes an edge.
inline constexpr AlgorithmLine kWiden{4, 7};       ///< Another pass, with wider hypercubes.
inline constexpr AlgorithmLine kHypercube{4, 12};  ///< The next hypercube.
inline constexpr AlgorithmLine kJoined{4, 20};     ///< Are start and goal joined?
inline constexpr AlgorithmLine kSearchRange{4,
                                            23};  ///< The stretch of the arm's segment to search.
inline constexpr AlgorithmLine kFailure{4, 35};   ///< No path was found.
}  // namespace algorithm_lines

/// Step that a planner has just done in a line. Fields that the line does not use are as below.
struct AlgorithmStep {
  AlgorithmLine line;
  bool yes = true;  ///< The answer, if the line is a condition.
  const geometric::Configuration* q =
      nullptr;    ///< The sample in question; valid during the call alone.
  int from = -1;  ///< Nodes of the roadmap: an edge, or (from) one node.
  int to = -1;
  int pair = -1;          ///< Colliding pair of the checker's world, if the answer is no.
  int count = 0;          ///< Neighbours found, or axes of the hand's subspace.
  double position = 0.0;  ///< Along the arm segment; start of a range.
  double range_end = 0.0;
  double rho_a = 0.0;
};

/// An Observer that is notified of every step of pmd-prm and full-prm, on the planner's own
/// thread and in the same order on every run. With a plain Observer, planners skip these
/// events.
class AlgorithmObserver : public Observer {
 public:
  [[nodiscard]] AlgorithmObserver* algorithm() final { return this; }
  virtual void on_step(const AlgorithmStep& step) = 0;
};

}  // namespace handway::planning
