#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/planning/planners/planner.h"

#include <memory>
#include <stop_token>

namespace handway::planning {

/// Source of a path, from the cheapest to the most expensive.
enum class ReplanSource {
  kNone,      ///< No path.
  kLastPath,  ///< The last path; it is still free.
  kRoadmap,   ///< Over the valid part of the roadmap.
  kRepair,    ///< The last path with a detour around the obstacle.
  kPlanner,   ///< Planned from scratch.
};

/// Plans repeatedly in a scene that changes little from one time to the next.
///
/// It keeps a roadmap of earlier checks. A node or edge that was free stays free of
/// all unchanged objects, so that only pairs with changed objects are checked again,
/// and only along candidate paths. One that was refused stays refused until the object
/// that refused it changes. A plan is, in this order: the shortest path over edges
/// that were free before, which mostly is the last one; a path over other edges of the
/// roadmap; the last path, with a detour from where it is blocked to where it is free
/// again (a bidirectional search in the paper's regions, there); a path planned from
/// scratch. All but an unchanged path are smoothed, and all results go into the
/// roadmap.
///
/// Roadmap whose answers are deterministic, for any number of threads. For one call at a time.
///
/// Sources: Bohlin, Kavraki, "Path planning using lazy PRM", ICRA 2000,
/// doi:10.1109/ROBOT.2000.844107; Jaillet, Siméon, "A PRM-based motion planner for
/// dynamically changing environments", IROS 2004, doi:10.1109/IROS.2004.1389625.
class HANDWAY_PLANNING_EXPORT DynamicRoadmap {
 public:
  /// @param planner plans the first path, and others from scratch if repair fails; null: auto.
  /// @param max_nodes limit beyond which all but the last path's nodes are removed.
  explicit DynamicRoadmap(PlanningProblem problem, std::unique_ptr<Planner> planner = nullptr,
                          int max_nodes = 3000);
  ~DynamicRoadmap();

  /// The present problem. After a change, this or plan() makes a new checker.
  [[nodiscard]] const PlanningProblem& problem();

  /// Applies the changes of objects that lead to another scene, and takes its start and goal, which
  /// plan() checks like the ends of any problem. @returns false, without any effect, if that is not
  /// sufficient: other robots, attached objects or constraints, or a missing end.
  [[nodiscard]] bool follow(const geometric::Scene& scene);
  /// Follows the scene of a problem that was made elsewhere, as above. It becomes the present
  /// problem, so that none has to be derived from the scene.
  [[nodiscard]] bool follow(const PlanningProblem& next);

  /// Takes a path that was planned for problem() elsewhere as the last one: plan() keeps it for as
  /// long as it is free. @param path valid, from start to goal; an empty one has no effect.
  void adopt(const Path& path);

  /// Plans as Planner::plan(). On failure, the roadmap and the last path stay for the next call.
  /// @param observer is notified of the nodes that this call adds.
  [[nodiscard]] PlanResult plan(const PlanRequest& request, std::stop_token stop = {},
                                Observer* observer = nullptr);

  /// Source of the path of the last plan().
  [[nodiscard]] ReplanSource source() const;

 private:
  struct Replanner;
  std::unique_ptr<Replanner> replanner_;
};

/// Text for display: "Previous path still valid", "Found in the roadmap", …
[[nodiscard]] HANDWAY_PLANNING_EXPORT const char* to_string(ReplanSource source);

}  // namespace handway::planning
