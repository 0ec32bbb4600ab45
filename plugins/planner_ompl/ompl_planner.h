#pragma once

#include "handway/planning/planners/planner.h"
#include "handway/planning/planners/planner_registry.h"
#include "handway/planning/spaces/target_sampler.h"
#include "methods.h"
#include "search.h"

#include <string>
#include <variant>
#include <vector>

namespace handway::planner_ompl {

/// One of OMPL's planners over all joints or over the controls of the paper's method
/// (planning::make_control_space), with Handway's collision checker and exact motion checks. Only
/// exact solutions count; they are smoothed like those of every other planner.
///
/// Source: Şucan, Moll, Kavraki, "The Open Motion Planning Library", IEEE Robotics &
/// Automation Magazine 19(4), 2012, doi:10.1109/MRA.2012.2205651.
class OmplPlanner final : public planning::Planner {
 public:
  /// @param method must outlive this object.
  OmplPlanner(const Method& method, planning::HandSpace space);

  [[nodiscard]] std::string name() const override;
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] planning::PlannerCapabilities capabilities() const override;

 protected:
  /// @throws geometric::InputError if OMPL refuses a setting.
  void do_plan(planning::PlanningContext& context, planning::PlanResult& result) override;
  [[nodiscard]] std::vector<planning::BoundParameter> own_parameters() override;

 private:
  [[nodiscard]] std::vector<planning::BoundParameter> method_parameters();

  const Method& method_;
  planning::HandSpace space_;
  std::vector<std::variant<int, double>> values_;  ///< Of the method's settings.
  SampleBudget budget_;
  planning::TargetRegion region_ = {.near_ends = 0.5, .max_pmds = 4};
};

/// Adds two planners for each of methods(), "ompl-KEY" and "ompl-pmd-KEY", to `registry`, and sends
/// what OMPL has to say to the log at level "debug".
void register_planners(planning::PlannerRegistry& registry);

}  // namespace handway::planner_ompl
