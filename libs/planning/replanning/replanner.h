#pragma once

#include "handway/planning/planners/planner.h"
#include "replanning/roadmap_graph.h"

#include <stop_token>

namespace handway::planning {

/// One query of a DynamicRoadmap, see DynamicRoadmap::plan(). Free nodes, edges and the path that
/// it finds go into `memory`. @param planner plans from scratch.
[[nodiscard]] PlanResult replan(RoadmapMemory& memory, Planner& planner,
                                const PlanningProblem& problem, const PlanRequest& request,
                                std::stop_token stop, Observer& observer);

}  // namespace handway::planning
