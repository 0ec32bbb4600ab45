#pragma once

#include "handway/planning/core/path.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/replanning/living_roadmap.h"
#include "replanning/living_graph.h"
#include "replanning/scene_changes.h"

namespace handway::planning {

/// What a LivingRoadmap keeps from one query to the next.
struct RoadmapMemory {
  RoadmapMemory(const LivingRoadmapSettings& limits, const geometric::RobotModel& model);

  /// The node at `q`, added if need be.
  int node_at(const PlanningProblem& problem, const Configuration& q);

  /// The edge between `a` and `b`, added if need be.
  Freedom& edge_between(int a, int b);

  /// Keeps a path whose edges are free in this revision, and forgets the rest if it is too much.
  void remember(const PlanningProblem& problem, const Path& path);

  LivingRoadmapSettings settings;
  SceneChanges changes;
  LivingGraph graph;
  Path last_path;  ///< Empty: none was found yet.
  ReplanReport report;
};

}  // namespace handway::planning
