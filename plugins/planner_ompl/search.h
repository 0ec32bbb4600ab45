#pragma once

#include "draws.h"
#include "handway/planning/core/parameter.h"
#include "handway/planning/core/planning_context.h"
#include "joint_cube.h"
#include "methods.h"

#include <ompl/base/ProblemDefinition.h>

#include <vector>

namespace handway::planner_ompl {

/// One run of one of OMPL's planners.
class Search {
 public:
  /// Sets OMPL up. `context` must outlive this object.
  /// @param settings of the method, for OMPL's parameters of these keys.
  /// @throws geometric::InputError if OMPL refuses a setting.
  Search(planning::PlanningContext& context, const Method& method,
         const std::vector<planning::Parameter>& settings, int max_samples);

  /// Searches, then tells the observer the nodes and edges there are in the end.
  /// Sets status, reason if there is something to add, path and statistics.
  void run(planning::PlanResult& result);

 private:
  void set_up(const Method& method, const std::vector<planning::Parameter>& settings);
  [[nodiscard]] bool has_to_end();
  [[nodiscard]] planning::Path path() const;
  void publish_graph();

  planning::PlanningContext& context_;
  std::uint64_t max_samples_;
  JointCube cube_;
  Draws draws_;
  ompl::base::SpaceInformationPtr information_;
  ompl::base::ProblemDefinitionPtr definition_;
  ompl::base::PlannerPtr planner_;
};

}  // namespace handway::planner_ompl
