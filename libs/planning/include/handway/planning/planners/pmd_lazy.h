#pragma once

#include "handway/planning/export.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/spaces/target_sampler.h"

#include <string>
#include <vector>

namespace handway::planning {

/// Settings of PmdLazy.
struct PmdLazySettings {
  int k = 15;      ///< Nearest nodes that a new node is joined to.
  int batch = 20;  ///< Nodes added each time start and goal have fallen apart.
  int max_samples = 1000000;
  int smoothing_checks = 300;  ///< Configurations that ShortcutSmoothing may check.
  TargetRegion region = {.near_ends = 0.5, .rho_a = 0.03};  ///< Where nodes are drawn from.
};

/// A roadmap in the paper's sampling regions whose edges are checked only where
/// the shortest path from start to goal leads; edges that are refused go, and new
/// nodes come when no path is left, from a corridor that widens.
///
/// Source: Bohlin, Kavraki, "Path planning using lazy PRM", ICRA 2000,
/// doi:10.1109/ROBOT.2000.844107. Nodes are checked when they are drawn.
class HANDWAY_PLANNING_EXPORT PmdLazy final : public Planner {
 public:
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] PlannerCapabilities capabilities() const override;

  [[nodiscard]] PmdLazySettings& settings() { return settings_; }

 protected:
  void do_plan(PlanningContext& context, PlanResult& result) override;
  [[nodiscard]] std::vector<BoundParameter> own_parameters() override;

 private:
  PmdLazySettings settings_;
};

}  // namespace handway::planning
