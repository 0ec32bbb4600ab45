#include "handway/planning/grasps/given_grasps.h"

#include "core/thread_pool.h"
#include "grasps/grasp_sampler.h"
#include "grasps/grasping_hand.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace handway::planning {

MeasuredGrasps measure_given_grasps(const PlanningProblem& problem, std::string_view object,
                                    const std::vector<GivenGrasp>& given,
                                    const PregraspOptions& options, const std::stop_token& stop) {
  const geometric::SceneObject& needed = graspable_object(problem, object);
  const PlanningProblem of_hand = with_nearest_hand(problem, needed);
  ThreadPool threads(std::max(options.threads, 1));
  std::vector<std::unique_ptr<GraspSampler>> samplers;
  samplers.reserve(static_cast<std::size_t>(threads.size()));
  for (int thread = 0; thread < threads.size(); ++thread) {
    samplers.push_back(std::make_unique<GraspSampler>(of_hand, needed, options, stop));
  }
  std::vector<std::optional<SampleResult>> results(given.size());
  std::atomic<std::size_t> next = 0;
  threads.run(0, threads.size(), [&](int thread) {
    for (std::size_t i = next++; i < given.size() && !stop.stop_requested(); i = next++) {
      SampleResult result =
          samplers[static_cast<std::size_t>(thread)]->given(given[i].X_OP, given[i].q);
      if (!stop.stop_requested()) {
        results[i] = std::move(result);
      }
    }
  });
  MeasuredGrasps measured{{{}, "", samplers.front()->palm()}, {}};
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (!results[i]) {
      continue;
    }
    if (results[i]->candidate) {
      measured.grasps.found.push_back(std::move(results[i]->candidate->grasp));
      measured.grasps.found.back().source = given[i].source;
    } else {
      measured.left_out.push_back(
          fmt::format("{}: {}.", given[i].source, samplers.front()->why_not(*results[i])));
    }
  }
  std::ranges::stable_sort(measured.grasps.found, std::greater(), &Pregrasp::score);
  return measured;
}

}  // namespace handway::planning
