#pragma once

#include "handway/planning/core/planner.h"
#include "handway/planning/core/planner_registry.h"
#include "methods.h"

#include <string>
#include <variant>
#include <vector>

namespace handway::planner_ompl {

/// One of OMPL's planners over all joints, normalised to [0, 1], with Handway's
/// collision checker and exact motion checks. Only exact solutions count; they are
/// smoothed like those of every other planner.
///
/// Source: Şucan, Moll, Kavraki, "The Open Motion Planning Library", IEEE Robotics &
/// Automation Magazine 19(4), 2012, doi:10.1109/MRA.2012.2205651.
class OmplPlanner final : public planning::Planner {
 public:
  /// @param method must outlive this object.
  explicit OmplPlanner(const Method& method);

  [[nodiscard]] std::string name() const override { return method_.name; }
  [[nodiscard]] std::string description() const override { return method_.description; }
  [[nodiscard]] planning::PlannerCapabilities capabilities() const override { return {}; }
  [[nodiscard]] std::vector<planning::Parameter> parameters() override;

 protected:
  /// @throws geometric::InputError if OMPL refuses a setting.
  void do_plan(planning::PlanningContext& context, planning::PlanResult& result) override;

 private:
  const Method& method_;
  std::vector<std::variant<int, double>> values_;  ///< Of the method's settings.
  int max_samples_ = 1000000;
};

/// Adds a planner for each of methods() to `registry`, and sends what OMPL has to say
/// to the log at level "debug".
void register_planners(planning::PlannerRegistry& registry);

}  // namespace handway::planner_ompl
