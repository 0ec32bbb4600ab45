#pragma once

#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/prm/PRM.h>

namespace handway::planner_ompl {

/// OMPL's PRM on one thread. OMPL's own looks for a path on a second thread and grows
/// and expands the roadmap by the clock, so that no run is like another; here it does
/// both by the count of milestones and looks for the path after every one. If its
/// objective asks for a better path than the first, it goes on until it is stopped.
class SequentialPrm : public ompl::geometric::PRM {
 public:
  explicit SequentialPrm(const ompl::base::SpaceInformationPtr& information, bool star = false);

  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& stop) override;

  /// Milestones without an edge included.
  void getPlannerData(ompl::base::PlannerData& data) const override;

 private:
  [[nodiscard]] bool add_ends(const ompl::base::PlannerTerminationCondition& stop);
  void build_until(const ompl::base::PlannerTerminationCondition& done);
  [[nodiscard]] ompl::base::PathPtr announced_path();
};

/// PRM* in the same way.
class SequentialPrmStar final : public SequentialPrm {
 public:
  explicit SequentialPrmStar(const ompl::base::SpaceInformationPtr& information)
      : SequentialPrm(information, true) {}
};

/// OMPL's LazyPRM with edges of any length. Of its roadmap is shown what was found free;
/// the rest is guesses.
class CheckedLazyPrm : public ompl::geometric::LazyPRM {
 public:
  explicit CheckedLazyPrm(const ompl::base::SpaceInformationPtr& information, bool star = false);

  void getPlannerData(ompl::base::PlannerData& data) const override;
};

/// LazyPRM*, shown in the same way.
class CheckedLazyPrmStar final : public CheckedLazyPrm {
 public:
  explicit CheckedLazyPrmStar(const ompl::base::SpaceInformationPtr& information)
      : CheckedLazyPrm(information, true) {}
};

}  // namespace handway::planner_ompl
