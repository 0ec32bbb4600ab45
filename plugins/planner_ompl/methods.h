#pragma once

#include <ompl/base/Planner.h>
#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/prm/PRM.h>

#include <string>
#include <variant>
#include <vector>

namespace handway::planner_ompl {

/// A parameter of an OMPL planner that becomes a setting.
struct MethodSetting {
  std::string key;  ///< Key in OMPL's ParamSet and in Handway.
  std::string label;
  std::string help;
  std::variant<int, double> initial;
  double lower = 0.0;  ///< Inclusive.
  double upper = 0.0;  ///< Inclusive.
};

/// Properties of a planner: whether it improves paths, and which edges it shows.
struct MethodTraits {
  bool improves = false;  ///< Can shorten a path once it has one.
  bool guesses = false;   ///< Has edges that are not checked yet.
};

/// Planner of OMPL that finds exact solutions on one thread.
struct Method {
  std::string key;      ///< In names, after "ompl-" or "ompl-pmd-".
  std::string name;     ///< OMPL's.
  std::string summary;  ///< Short description of what it grows.
  ompl::base::PlannerPtr (*make)(const ompl::base::SpaceInformationPtr& information) = nullptr;
  std::vector<MethodSetting> settings;
  MethodTraits traits;
};

[[nodiscard]] const std::vector<Method>& methods();

/// OMPL's PRM on one thread. OMPL's own looks for a path on a second thread and grows and expands
/// the roadmap by the clock, so that no two runs are equal; this one does both by the count of
/// milestones and looks for the path after every one.
class SequentialPrm final : public ompl::geometric::PRM {
 public:
  explicit SequentialPrm(const ompl::base::SpaceInformationPtr& information);

  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& stop) override;

  /// Number of milestones, with those without an edge.
  void getPlannerData(ompl::base::PlannerData& data) const override;

 private:
  [[nodiscard]] bool add_ends(const ompl::base::PlannerTerminationCondition& stop);
  void build_until(const ompl::base::PlannerTerminationCondition& done);
  [[nodiscard]] ompl::base::PathPtr announced_path();
};

/// OMPL's LazyPRM with edges of any length. Only the part of its roadmap that was found free is
/// shown.
class CheckedLazyPrm final : public ompl::geometric::LazyPRM {
 public:
  explicit CheckedLazyPrm(const ompl::base::SpaceInformationPtr& information);

  void getPlannerData(ompl::base::PlannerData& data) const override;
};

}  // namespace handway::planner_ompl
