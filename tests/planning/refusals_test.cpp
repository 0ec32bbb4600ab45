#include "handway/planning/core/planner_registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <handway_test/planar_problems.h>

#include <algorithm>
#include <numeric>
#include <string>

namespace handway::planning {
namespace {

class RefusedSamples : public testing::TestWithParam<const char*> {};

TEST_P(RefusedSamples, AreCountedByWhatTouchesAndWhere) {
  const PlanningProblem problem = test::walled_in_problem();
  const auto planner = PlannerRegistry().create(GetParam());
  set_from_text(find_parameter(planner->parameters(), "max_samples"), "400");
  const PlanResult result = planner->plan(problem, {});
  ASSERT_EQ(result.status, PlanStatus::kSamplesSpent);
  const PlanStatistics& statistics = result.statistics;
  std::uint64_t all = 0;
  std::uint64_t with_wall = 0;
  for (const auto& [bodies, count] : statistics.rejections) {
    all += count;
    const bool is_wall = (bodies.first + bodies.second).find("wall") != std::string::npos;
    with_wall += is_wall ? count : 0;
  }
  EXPECT_GT(with_wall, 0U);
  ASSERT_EQ(statistics.rejections_per_tenth.size(), 10U);
  EXPECT_EQ(std::accumulate(statistics.rejections_per_tenth.begin(),
                            statistics.rejections_per_tenth.end(), std::uint64_t{0}),
            all);
}

INSTANTIATE_TEST_SUITE_P(OfPlanners, RefusedSamples,
                         testing::Values("pmd-auto", "pmd-rrt-connect", "pmd-lazy", "rrt-connect",
                                         "pmd-prm"));

}  // namespace
}  // namespace handway::planning
