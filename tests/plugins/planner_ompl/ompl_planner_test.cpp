#include "ompl_planner.h"

#include "handway/planning/paths/path_check.h"
#include "handway_test/paths.h"
#include "handway_test/planar_problems.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>
#include <thread>
#include <vector>

namespace handway::planner_ompl {
namespace {

using geometric::find_parameter;
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
    names.push_back("ompl-" + method.key);
    names.push_back("ompl-pmd-" + method.key);
  }
  return names;
}

PlanResult plan(planning::Planner& planner, std::uint64_t seed) {
  const PlanningProblem problem = test::post_problem();
  return planner.plan(problem, PlanRequest{.seed = seed});
}

void set(planning::Planner& planner, const std::string& key, const std::string& value) {
  planner.set_parameter(key, value);
}

// Returns the parameters without those that all planners share, which come last.
std::vector<geometric::Parameter> own_parameters(planning::Planner& planner) {
  std::vector<geometric::Parameter> list = planner.parameters();
  list.erase(std::ranges::find(list, "objective", &geometric::Parameter::key), list.end());
  return list;
}

class OmplMethod : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<planning::Planner> planner_ = registry().create(GetParam());
};

TEST_P(OmplMethod, IsRegisteredUnderItsName) {
  EXPECT_EQ(planner_->name(), GetParam());
  EXPECT_EQ(planner_->capabilities().uses_pmds, GetParam().starts_with("ompl-pmd-"));
  EXPECT_EQ(planner_->capabilities().needs_basis, GetParam().starts_with("ompl-pmd-"));
}

TEST_P(OmplMethod, FindsAPathThatHolds) {
  const PlanningProblem problem = test::open_problem();
  for (const std::uint64_t seed : {1U, 2U}) {
    const PlanResult result = planner_->plan(problem, PlanRequest{.seed = seed});
    ASSERT_TRUE(result.solved()) << result.reason;
    EXPECT_EQ(result.path.waypoints.front(), problem.start);
    EXPECT_EQ(result.path.waypoints.back(), problem.goal);
    EXPECT_THAT(planning::check_path(problem, result.path, 0.002).faults, IsEmpty());
    EXPECT_GT(result.certificate.min_clearance, 0.0);
    EXPECT_GE(result.statistics.nodes, 2U);
    EXPECT_GE(result.statistics.edges, 1U);
  }
}

TEST_P(OmplMethod, EndsWithItsSamplesAndWithTheTime) {
  const PlanningProblem problem = test::walled_in_problem();
  set(*planner_, "max_samples", "100");
  const PlanResult spent = planner_->plan(problem, {});
  EXPECT_EQ(spent.status, planning::PlanStatus::kSamplesSpent) << spent.reason;
  EXPECT_TRUE(spent.path.empty());
  EXPECT_GE(spent.statistics.samples, 100U);
  EXPECT_LE(spent.statistics.samples, 310U) << "some draw batches of 100 valid ones";
  set(*planner_, "max_samples", "100000000");
  const PlanResult late = planner_->plan(problem, PlanRequest{.time_limit_s = 0.02});
  EXPECT_EQ(late.status, planning::PlanStatus::kTimeLimit);
  EXPECT_TRUE(late.path.empty());
}

TEST_P(OmplMethod, TakesTheLimitsOfItsSettings) {
  const bool regions_too = GetParam() == "ompl-pmd-rrt-connect";
  set(*planner_, "max_samples", "50");
  const PlanningProblem problem = test::post_problem();
  for (const geometric::Parameter& setting : own_parameters(*planner_)) {
    if (setting.key == "max_samples" || (planner_->capabilities().uses_pmds && !regions_too)) {
      continue;
    }
    const std::string initial = to_text(setting);
    for (const double limit : {setting.lower, setting.upper}) {
      set(*planner_, setting.key, fmt::format("{:.17g}", limit));
      EXPECT_NO_THROW(static_cast<void>(planner_->plan(problem, PlanRequest{.time_limit_s = 0.5})))
          << setting.key << " " << limit;
    }
    set(*planner_, setting.key, initial);
  }
}

TEST_P(OmplMethod, IsInTheManualWithItsSettings) {
  std::ifstream file(test::source_dir() / "docs" / "planners.md");
  const std::string manual{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(manual, HasSubstr("| `" + GetParam() + "` |"));
  for (const geometric::Parameter& setting : own_parameters(*planner_)) {
    const std::size_t row = manual.rfind("| `" + setting.key + "` | ");
    ASSERT_NE(row, std::string::npos) << setting.key;
    EXPECT_THAT(manual.substr(row, manual.find('\n', row) - row),
                HasSubstr(fmt::format("| {} | {:.10g} to {:.10g} | ", to_text(setting),
                                      setting.lower, setting.upper)));
  }
}

TEST_P(OmplMethod, DrawsTheSameWhateverElseDraws) {
  set(*planner_, "max_samples", "300");
  const PlanResult alone = plan(*planner_, 3);
  PlanResult together;
  {
    const std::jthread other([] {
      for (const char* name : {"ompl-rrt", "ompl-prm", "ompl-pmd-kpiece", "ompl-pmd-bit-star"}) {
        const auto planner = registry().create(name);
        set(*planner, "max_samples", "100");
        static_cast<void>(plan(*planner, 4));
      }
    });
    together = plan(*planner_, 3);
  }
  EXPECT_EQ(together.path.waypoints, alone.path.waypoints);
  EXPECT_EQ(together.statistics.samples, alone.statistics.samples);
  EXPECT_EQ(together.statistics.node_checks, alone.statistics.node_checks);
  EXPECT_EQ(together.statistics.edge_checks, alone.statistics.edge_checks);
}

TEST_P(OmplMethod, DrawsOtherSamplesForAnotherSeed) {
  set(*planner_, "max_samples", "600");
  for (const geometric::Parameter& setting : planner_->parameters()) {
    if (setting.key == "num_samples") {
      set(*planner_, setting.key, "50");  // else the samples are spent before it begins
    }
  }
  const PlanResult first = plan(*planner_, 1);
  const PlanResult second = plan(*planner_, 2);
  EXPECT_TRUE(first.path.waypoints != second.path.waypoints ||
              first.statistics.edge_checks != second.statistics.edge_checks ||
              first.statistics.node_checks != second.statistics.node_checks);
}

TEST_P(OmplMethod, LeavesTheConsoleAlone) {
  set(*planner_, "max_samples", "100");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  static_cast<void>(plan(*planner_, 1));
  EXPECT_THAT(testing::internal::GetCapturedStdout(), IsEmpty());
  // OMPL passes "%)" to a function of the library C, which AddressSanitizer remarks.
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::AnyOf(IsEmpty(), testing::HasSubstr("AddressSanitizer: WARNING: unexpected "
                                                           "format specifier")));
}

INSTANTIATE_TEST_SUITE_P(Ompl, OmplMethod, testing::ValuesIn(names_of_methods()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

class ConstrainedMethod : public OmplMethod {};

TEST_P(ConstrainedMethod, KeepsTheHeadingOfThePalm) {
  const PlanningProblem plain = test::post_problem();
  geometric::Scene scene = *plain.scene;
  constexpr double kAngle = 0.6;
  scene.constraints.push_back({"heading", "palm",
                               geometric::OrientationConstraint{Eigen::Vector3d::UnitX(),
                                                                Eigen::Vector3d::UnitX(), kAngle}});
  const PlanningProblem problem = test::planar_problem(std::move(scene), plain.start, plain.goal);
  const PlanResult result = planner_->plan(problem, {});
  ASSERT_TRUE(result.solved()) << result.reason;
  for (std::size_t edge = 0; edge + 1 < result.path.waypoints.size(); ++edge) {
    for (int i = 0; i <= 2000; ++i) {
      const planning::Configuration q =
          result.path.waypoints[edge] +
          i / 2000.0 * (result.path.waypoints[edge + 1] - result.path.waypoints[edge]);
      ASSERT_LE(std::abs(q[0] + q[1]), kAngle) << "the palm turns with shoulder and elbow";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Ompl, ConstrainedMethod,
                         testing::Values("ompl-rrt-connect", "ompl-pmd-rrt-connect", "ompl-kpiece",
                                         "ompl-prm", "ompl-fmt", "ompl-bit-star"),
                         [](const auto& method) {
                           std::string name = method.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

std::size_t edges_with(const std::string& planner, const std::string& key,
                       const std::string& value) {
  const auto made = registry().create(planner);
  made->set_parameter(key, value);
  made->set_parameter("max_samples", "300");
  return made->plan(test::walled_in_problem(), {}).statistics.edges;
}

TEST(OmplSettings, SamplesAfterTheFirstPathMakeItShorter) {
  const PlanningProblem problem = test::post_problem();
  const auto length = [&](const PlanResult& result) {
    double sum = 0.0;
    for (std::size_t i = 1; i < result.path.waypoints.size(); ++i) {
      sum += planning::normalised_distance(problem.model(), result.path.waypoints[i - 1],
                                           result.path.waypoints[i]);
    }
    return sum;
  };
  const auto planner = registry().create("ompl-pmd-bit-star");
  const PlanResult first = planner->plan(problem, {});
  set(*planner, "improvement_samples", "400");
  const PlanResult improved = planner->plan(problem, {});
  ASSERT_TRUE(first.solved() && improved.solved());
  EXPECT_GE(improved.statistics.samples, first.statistics.samples + 400);
  EXPECT_LE(length(improved), length(first));
}

TEST(OmplSettings, ReachOmpl) {
  EXPECT_LT(edges_with("ompl-prm", "max_nearest_neighbors", "2"),
            edges_with("ompl-prm", "max_nearest_neighbors", "20"));
  EXPECT_NE(edges_with("ompl-rrt", "range", "0.05"), edges_with("ompl-rrt", "range", "0.5"));
  EXPECT_GT(edges_with("ompl-rrt", "goal_bias", "0"), edges_with("ompl-rrt", "goal_bias", "0.9"));
}

TEST(OmplPlanners, ReachAGoalThatMovesAJointOfNoGroup) {
  geometric::RobotDescription robot = test::planar_hand_arm();
  robot.groups.front().joints = {"shoulder"};
  auto scene = std::make_shared<geometric::Scene>(test::scene_of(robot));
  scene->start = test::planar_configuration(-0.4, 0);
  scene->goal = test::planar_configuration(-0.4, 0.3);
  const PlanningProblem problem = planning::make_problem(
      scene, std::make_shared<const sampling::PmdBasis>(test::planar_hand_basis()));
  for (const char* name : {"ompl-rrt-connect", "ompl-pmd-rrt-connect"}) {
    const PlanResult result = registry().create(name)->plan(problem, {});
    ASSERT_TRUE(result.solved()) << result.reason;
    EXPECT_EQ(result.path.waypoints.back(), problem.goal) << name;
  }
}

TEST(OmplPrm, KeepsMilestonesThatNothingIsConnectedTo) {
  const auto planner = registry().create("ompl-prm");
  planner->set_parameter("max_samples", "300");
  const PlanResult result = planner->plan(test::walled_in_problem(), {});
  EXPECT_FALSE(result.solved());
  EXPECT_GT(result.statistics.nodes, 2U);
}

}  // namespace
}  // namespace handway::planner_ompl
