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

/// What a planner goes on with, and what it shows.
struct MethodTraits {
  bool improves = false;  ///< Can go on to a shorter path once it has one.
  bool guesses = false;   ///< Has edges that it has not checked.
};

/// One of OMPL's planners that find exact solutions on one thread.
struct Method {
  std::string key;      ///< In names, after "ompl-" or "ompl-pmd-".
  std::string name;     ///< OMPL's.
  std::string summary;  ///< What it grows.
  ompl::base::PlannerPtr (*make)(const ompl::base::SpaceInformationPtr& information) = nullptr;
  std::vector<MethodSetting> settings;
  MethodTraits traits;
};

[[nodiscard]] const std::vector<Method>& methods();

}  // namespace handway::planner_ompl
