#pragma once

#include "draws.h"
#include "handway/geometric/io/parameter.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/spaces/target_sampler.h"
#include "methods.h"
#include "motion_check.h"
#include "state_map.h"

#include <ompl/base/PlannerData.h>
#include <ompl/base/ProblemDefinition.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace handway::planner_ompl {

/// Limits of the number of samples of a search.
struct SampleBudget {
  int all = 1000000;
  int improvement = 0;  ///< Part of `all` after the first path; 0: stop at it.
};

/// One run of one of OMPL's planners.
class Search {
 public:
  /// Sets OMPL up. `context` must outlive this object.
  /// @param settings of the method, for OMPL's parameters of these keys.
  /// @param region, hand source of the states; the region must outlive this object.
  /// @throws geometric::InputError if OMPL refuses a setting.
  Search(planning::PlanningContext& context, const Method& method, std::unique_ptr<StateMap> map,
         const std::vector<geometric::Parameter>& settings, SampleBudget budget,
         const planning::TargetRegion& region, planning::HandSpace hand);

  /// Searches, then reports the final nodes and edges to the observer. Sets status, reason if it
  /// has one to add, path and statistics.
  void run(planning::PlanResult& result);

 private:
  void set_up(const Method& method, const std::vector<geometric::Parameter>& settings);
  void set_goal_and_start();
  void set_objective();
  [[nodiscard]] bool has_to_end();
  [[nodiscard]] planning::Path path() const;
  /// Returns whether all motions of `path` were found free, or are. OMPL cuts some motions, and the
  /// cut may be beside them, at a joint's limit.
  [[nodiscard]] bool proved(const planning::Path& path);
  [[nodiscard]] std::vector<std::pair<int, int>> edges_of(
      const ompl::base::PlannerData& graph,
      const std::vector<planning::Configuration>& nodes) const;
  void publish_graph();

  planning::PlanningContext& context_;
  MethodTraits traits_;
  SampleBudget budget_;
  std::unique_ptr<StateMap> map_;
  Draws draws_;
  ompl::base::SpaceInformationPtr information_;
  ompl::base::ProblemDefinitionPtr definition_;
  std::shared_ptr<MotionCheck> motions_;
  ompl::base::PlannerPtr planner_;
  std::optional<std::uint64_t> first_path_at_;  ///< Number of samples at that time.
};

/// Planner of OMPL over all joints or over the controls of the paper's method
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
  [[nodiscard]] std::vector<geometric::BoundParameter> own_parameters() override;

 private:
  [[nodiscard]] std::vector<geometric::BoundParameter> method_parameters();

  const Method& method_;
  planning::HandSpace space_;
  std::vector<std::variant<int, double>> values_;  ///< Values of the method's settings.
  SampleBudget budget_;
  planning::TargetRegion region_ = {.near_ends = 0.5, .max_pmds = 4};
};

/// Adds two planners for each of methods(), "ompl-KEY" and "ompl-pmd-KEY", to `registry`, and sends
/// OMPL's messages to the log at level "debug".
void register_planners(planning::PlannerRegistry& registry);

}  // namespace handway::planner_ompl
