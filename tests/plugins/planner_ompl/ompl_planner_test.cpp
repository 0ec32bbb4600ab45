#include "ompl_planner.h"

#include "handway_test/paths.h"
#include "handway_test/planar_problems.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <thread>
#include <vector>

namespace handway::planner_ompl {
namespace {

using planning::find_parameter;
using planning::PlannerRegistry;
using planning::PlanningProblem;
using planning::PlanRequest;
using planning::PlanResult;
using testing::HasSubstr;
using testing::IsEmpty;

const PlannerRegistry& registry() {
  static const PlannerRegistry kRegistry = [] {
    PlannerRegistry filled;
    register_planners(filled);
    return filled;
  }();
  return kRegistry;
}

std::vector<std::string> names_of_methods() {
  std::vector<std::string> names;
  for (const Method& method : methods()) {
    names.push_back(method.name);
  }
  return names;
}

PlanResult plan(planning::Planner& planner, std::uint64_t seed) {
  const PlanningProblem problem = test::post_problem();
  return planner.plan(problem, PlanRequest{.seed = seed});
}

class OmplMethod : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<planning::Planner> planner_ = registry().create(GetParam());
};

TEST_P(OmplMethod, IsRegisteredUnderItsName) { EXPECT_EQ(planner_->name(), GetParam()); }

TEST_P(OmplMethod, TakesTheLimitsOfItsSettings) {
  set_from_text(find_parameter(planner_->parameters(), "max_samples"), "300");
  for (const planning::Parameter& setting : planner_->parameters()) {
    if (setting.key == "max_samples") {
      continue;
    }
    const std::string initial = to_text(setting);
    for (const double limit : {setting.lower, setting.upper}) {
      if (int* const* value = std::get_if<int*>(&setting.value)) {
        **value = static_cast<int>(limit);
      } else {
        *std::get<double*>(setting.value) = limit;
      }
      EXPECT_NO_THROW(static_cast<void>(plan(*planner_, 1))) << setting.key << " " << limit;
    }
    set_from_text(setting, initial);
  }
}

TEST_P(OmplMethod, IsInTheManualWithItsSettings) {
  std::ifstream file(test::source_dir() / "docs" / "planners.md");
  const std::string manual{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(manual, HasSubstr("| `" + GetParam() + "` |"));
  for (const planning::Parameter& setting : planner_->parameters()) {
    const std::size_t row = manual.rfind("| `" + setting.key + "` | ");
    ASSERT_NE(row, std::string::npos) << setting.key;
    EXPECT_THAT(manual.substr(row, manual.find('\n', row) - row),
                HasSubstr(fmt::format("| {} | {:.10g} to {:.10g} | ", to_text(setting),
                                      setting.lower, setting.upper)));
  }
}

TEST_P(OmplMethod, DrawsTheSameWhateverElseDraws) {
  const PlanResult alone = plan(*planner_, 3);
  ASSERT_TRUE(alone.solved()) << alone.reason;
  PlanResult together;
  {
    const std::jthread other([] {
      for (const std::string& name : names_of_methods()) {
        static_cast<void>(plan(*registry().create(name), 4));
      }
    });
    together = plan(*planner_, 3);
  }
  EXPECT_EQ(together.path.waypoints, alone.path.waypoints);
  EXPECT_EQ(together.statistics.samples, alone.statistics.samples);
  EXPECT_EQ(together.statistics.node_checks, alone.statistics.node_checks);
}

TEST_P(OmplMethod, DrawsOtherSamplesForAnotherSeed) {
  EXPECT_NE(plan(*planner_, 1).path.waypoints, plan(*planner_, 2).path.waypoints);
}

TEST_P(OmplMethod, LeavesTheConsoleAlone) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  static_cast<void>(plan(*planner_, 1));
  EXPECT_THAT(testing::internal::GetCapturedStdout(), IsEmpty());
  EXPECT_THAT(testing::internal::GetCapturedStderr(), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Ompl, OmplMethod, testing::ValuesIn(names_of_methods()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

std::size_t edges_with(const std::string& planner, const std::string& key,
                       const std::string& value) {
  const auto made = registry().create(planner);
  set_from_text(find_parameter(made->parameters(), key), value);
  set_from_text(find_parameter(made->parameters(), "max_samples"), "300");
  return made->plan(test::walled_in_problem(), {}).statistics.edges;
}

TEST(OmplSettings, ReachOmpl) {
  EXPECT_LT(edges_with("ompl-prm", "max_nearest_neighbors", "2"),
            edges_with("ompl-prm", "max_nearest_neighbors", "20"));
  EXPECT_NE(edges_with("ompl-rrt", "range", "0.05"), edges_with("ompl-rrt", "range", "0.5"));
  EXPECT_GT(edges_with("ompl-rrt", "goal_bias", "0"), edges_with("ompl-rrt", "goal_bias", "0.9"));
}

TEST(OmplPrm, KeepsMilestonesThatNothingIsConnectedTo) {
  const auto planner = registry().create("ompl-prm");
  set_from_text(find_parameter(planner->parameters(), "max_samples"), "300");
  const PlanResult result = planner->plan(test::walled_in_problem(), {});
  EXPECT_FALSE(result.solved());
  EXPECT_GT(result.statistics.nodes, 2U);
}

}  // namespace
}  // namespace handway::planner_ompl
