#include "handway/planning/grasps/given_grasps.h"

#include "grasps/grasping_hand.h"
#include "grasps/sampler_pool.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
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
    SampleResult result = sampler.given(given[i].X_OP, given[i].q);
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
  std::ranges::stable_sort(measured.grasps.found, std::greater(), &Pregrasp::score);
  return measured;
}

}  // namespace handway::planning
