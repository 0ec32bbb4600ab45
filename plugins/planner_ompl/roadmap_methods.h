#pragma once

#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/prm/PRM.h>

namespace handway::planner_ompl {

/// OMPL's PRM on one thread. OMPL's own looks for a path on a second thread and grows
/// and expands the roadmap by the clock, so that no run is like another; here it does
/// both by the count of milestones and looks for the path after every one.
class SequentialPrm final : public ompl::geometric::PRM {
 public:
  explicit SequentialPrm(const ompl::base::SpaceInformationPtr& information);

  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& stop) override;

  /// Milestones without an edge included.
  void getPlannerData(ompl::base::PlannerData& data) const override;

 private:
  [[nodiscard]] bool add_ends(const ompl::base::PlannerTerminationCondition& stop);
  void build_until(const ompl::base::PlannerTerminationCondition& done);
  [[nodiscard]] ompl::base::PathPtr announced_path();
};

/// OMPL's LazyPRM with edges of any length. Of its roadmap is shown what was found free;
/// the rest is guesses.
class CheckedLazyPrm final : public ompl::geometric::LazyPRM {
 public:
  explicit CheckedLazyPrm(const ompl::base::SpaceInformationPtr& information);

  void getPlannerData(ompl::base::PlannerData& data) const override;
};

}  // namespace handway::planner_ompl
