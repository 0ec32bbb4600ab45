#pragma once

#include <ompl/base/Planner.h>

#include <string>
#include <variant>
#include <vector>

namespace handway::planner_ompl {

/// A parameter of an OMPL planner that is offered as a setting.
struct MethodSetting {
  std::string key;  ///< In OMPL's ParamSet and in Handway alike.
  std::string label;
  std::string help;
  std::variant<int, double> initial;
  double lower = 0.0;  ///< Inclusive.
  double upper = 0.0;  ///< Inclusive.
};

/// One of OMPL's planners that stop at their first exact solution.
struct Method {
  std::string name;  ///< In the registry.
  std::string description;
  ompl::base::PlannerPtr (*make)(const ompl::base::SpaceInformationPtr& information) = nullptr;
  std::vector<MethodSetting> settings;
};

[[nodiscard]] const std::vector<Method>& methods();

}  // namespace handway::planner_ompl
