#pragma once

#include "handway/planning/core/planner.h"
#include "handway/planning/export.h"
#include "handway/planning/planners/target_region.h"

#include <string>
#include <vector>

namespace handway::planning {

/// Settings of PmdAuto.
struct PmdAutoSettings {
  int max_samples = 1000000;   ///< Of all searches together.
  int smoothing_checks = 200;  ///< Configurations that ShortcutSmoothing may check.
  bool cartesian = true;       ///< Search in poses of the arm's tool too.
  bool lazy = true;            ///< Search a lazy roadmap too.
};

/// Races the planners with PMDs and takes the path of the first to find one: trees
/// in the joint corridor start alone; where they don't find a path soon, trees in
/// the Cartesian corridor (if the arm has closed-form inverse kinematics), a lazy
/// roadmap and trees from other seeds join. Budgets are counted in configurations,
/// so that the winner is the same for any number of threads.
class HANDWAY_PLANNING_EXPORT PmdAuto final : public Planner {
 public:
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] PlannerCapabilities capabilities() const override;
  [[nodiscard]] std::vector<Parameter> parameters() override;

  [[nodiscard]] PmdAutoSettings& settings() { return settings_; }
  /// Where each of the searches that race begins to draw from, in the order of
  /// NodeEvent::search.
  [[nodiscard]] std::vector<TargetRegion> regions() const;

 protected:
  void do_plan(PlanningContext& context, PlanResult& result) override;

 private:
  PmdAutoSettings settings_;
};

}  // namespace handway::planning
