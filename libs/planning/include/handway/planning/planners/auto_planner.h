#pragma once

#include "handway/planning/export.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/spaces/target_sampler.h"

#include <string>
#include <vector>

namespace handway::planning {

/// Settings of AutoPlanner.
struct AutoPlannerSettings {
  int max_samples = 1000000;   ///< Of all searches together.
  int smoothing_checks = 800;  ///< Configurations that the PathOptimizer may check.
  bool cartesian = true;       ///< Expansive trees grow in poses of the arm's tool.
};

/// The default. Runs a portfolio of searches and takes the path of the first to find one: trees in
/// the joint corridor start alone; where they don't find a path soon, expansive trees (see
/// RrtConnectSettings::expansions; in poses of the tool if the arm has closed-form inverse
/// kinematics), the same from another seed, and trees over all joints join. Budgets are counted in
/// configurations, so that the winner is the same for any number of threads. The path is then
/// optimised.
///
/// With a basis hand postures are sampled in the PMD subspace; without one every joint on its own.
class HANDWAY_PLANNING_EXPORT AutoPlanner final : public Planner {
 public:
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] PlannerCapabilities capabilities() const override;

  [[nodiscard]] AutoPlannerSettings& settings() { return settings_; }
  /// Where each of its searches begins to draw from, in the order of
  /// NodeEvent::search. @param has_basis of the problem.
  [[nodiscard]] std::vector<TargetRegion> regions(bool has_basis) const;

 protected:
  void do_plan(PlanningContext& context, PlanResult& result) override;
  [[nodiscard]] std::vector<BoundParameter> own_parameters() override;

 private:
  AutoPlannerSettings settings_;
};

}  // namespace handway::planning
