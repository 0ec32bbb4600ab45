#pragma once

#include "handway/planning/core/planning_context.h"
#include "handway/planning/planners/planner.h"
#include "replanning/node_harvest.h"
#include "replanning/roadmap_memory.h"
#include "replanning/way_checker.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace handway::planning {

/// One query of a LivingRoadmap.
class Replanner final : public Planner {
 public:
  /// All must outlive this object. @param harvest the observer that plan() is given.
  Replanner(RoadmapMemory& memory, Planner& planner, NodeHarvest& harvest)
      : memory_(memory), planner_(planner), harvest_(harvest) {
    objective() = planner.objective();
  }

  [[nodiscard]] std::string name() const override { return "living-roadmap"; }
  [[nodiscard]] std::string description() const override {
    return "Roadmap that is kept while the scene changes";
  }
  [[nodiscard]] PlannerCapabilities capabilities() const override {
    return planner_.capabilities();
  }

 protected:
  void do_plan(PlanningContext& context, PlanResult& result) override;
  [[nodiscard]] std::vector<Parameter> own_parameters() override { return {}; }

 private:
  [[nodiscard]] std::optional<Path> known_path(PlanningContext& context, WayChecker& checker);
  [[nodiscard]] std::optional<Path> repaired_path(PlanningContext& context, WayChecker& checker);
  [[nodiscard]] std::vector<int> free_waypoints(PlanningContext& context, WayChecker& checker);
  [[nodiscard]] std::optional<Path> detour(PlanningContext& context, const Configuration& from,
                                           const Configuration& to);
  [[nodiscard]] Path along(const PlanningProblem& problem, const std::vector<int>& way) const;

  RoadmapMemory& memory_;
  Planner& planner_;
  NodeHarvest& harvest_;
};

}  // namespace handway::planning
