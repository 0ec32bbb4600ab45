#include "handway/planning/grasps/given_grasps.h"

#include "grasps/grasping_hand.h"
#include "grasps/sampler_pool.h"
#include "handway/planning/edits/scene_edits.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace handway::planning {

MeasuredGrasps measure_given_grasps(const PlanningProblem& problem, std::string_view object,
                                    const std::vector<GivenGrasp>& given,
                                    const PregraspOptions& options, const std::stop_token& stop) {
  const geometric::SceneObject& needed = graspable_object(problem, object);
  const PlanningProblem of_hand = with_nearest_hand(problem, needed);
  SamplerPool samplers(of_hand, needed, options, stop);
  std::vector<std::optional<SampleResult>> results(given.size());
  samplers.run(given.size(), [&](GraspSampler& sampler, std::size_t i) {
    SampleResult result = sampler.given(given[i]);
    if (!stop.stop_requested()) {
      results[i] = std::move(result);
    }
  });
  MeasuredGrasps measured{{{}, "", samplers.front().palm()}, {}};
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (!results[i]) {
      continue;
    }
    if (results[i]->candidate) {
      measured.grasps.found.push_back(std::move(results[i]->candidate->grasp));
      measured.grasps.found.back().source = given[i].source;
    } else {
      measured.left_out.push_back(
          fmt::format("{}: {}.", given[i].source, samplers.front().why_not(*results[i])));
    }
  }
  return measured;
}

MeasuredGrasps measure_grasps_of_file(const std::filesystem::path& file,
                                      const PlanningProblem& problem, std::string_view object,
                                      const PregraspOptions& options, const std::stop_token& stop) {
  return measure_given_grasps(problem, object, read_given_grasps(file, problem, object), options,
                              stop);
}

GivenGrasp as_given(const PlanningProblem& problem, std::string_view object, const Pregrasp& grasp,
                    int palm, const std::string& source) {
  std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(problem.model().link_count()));
  problem.model().forward_kinematics(grasp.closed, X_BL);
  const geometric::Pose X_WP =
      problem.scene->robots.front().X_WB * X_BL[static_cast<std::size_t>(palm)];
  const geometric::Pose& X_WO = geometric::find_object(*problem.scene, object)->X_PO;
  return {source, X_WO.inverse() * X_WP, grasp.closed, grasp.q};
}

SceneState with_grasps(const SceneState& state, std::string_view object,
                       const std::filesystem::path& file) {
  const PlanningProblem problem = make_problem(state.scene, state.basis, {}, GoalNeed::kOptional);
  static_cast<void>(read_given_grasps(file, problem, object));
  return with_changed_object(state, object, [&](geometric::SceneObject& changed) {
    changed.grasps = std::filesystem::absolute(file).lexically_normal();
  });
}

}  // namespace handway::planning
