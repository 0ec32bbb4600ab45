#include "handway/planning/planners/planner.h"

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
  planner->set_parameter("max_samples", "400");
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

// Four slides between combs of plates: each is free of the comb in one twentieth of its range,
// all together in six draws of a million. Without a time limit the search has to end all the same.
TEST(ArmSamples, ThatAllCollideWithTheRobotItselfEndTheSearch) {
  constexpr double kPitch = 0.004;  // m, from plate to plate
  constexpr double kPlate = 0.0005;
  constexpr double kPlay = 0.0002;
  constexpr int kPlates = 26;
  geometric::RobotDescription robot;
  robot.name = "combs";
  robot.links.emplace_back().name = "base";
  for (int lane = 0; lane < 4; ++lane) {
    const auto at = [&](double x) { return geometric::Pose(Eigen::Translation3d(x, lane, 0)); };
    for (int plate = 0; plate < kPlates; ++plate) {
      robot.links[0].collision.push_back(
          {geometric::Box{{kPlate, 0.01, 0.01}}, at((plate - 0.5) * kPitch), {}});
    }
    const std::string name = "slide_" + std::to_string(lane);
    robot.links.push_back({name,
                           {},
                           {{geometric::Box{{kPitch - kPlate - kPlay, 0.005, 0.005}},
                             geometric::Pose::Identity(),
                             {}}}});
    geometric::Joint joint;
    joint.name = name;
    joint.type = geometric::JointType::kPrismatic;
    joint.parent = "base";
    joint.child = name;
    joint.X_PJ = at(0);
    joint.axis = Eigen::Vector3d::UnitX();
    joint.limits.upper = (kPlates - 2) * kPitch;
    robot.joints.push_back(joint);
  }
  geometric::Scene scene = test::scene_of(std::move(robot));
  scene.start = Eigen::VectorXd::Constant(4, 5 * kPitch);
  scene.goal = Eigen::VectorXd::Constant(4, 20 * kPitch);
  const PlanningProblem problem =
      make_problem(std::make_shared<const geometric::Scene>(std::move(scene)), nullptr);
  const auto planner = PlannerRegistry().create("full-prm");
  planner->set_parameter("rho_a", "0.05");
  const PlanResult result = planner->plan(problem, {});
  EXPECT_EQ(result.status, PlanStatus::kStalled) << result.reason;
  EXPECT_THAT(result.reason, testing::HasSubstr("stalled"));
  EXPECT_STREQ(to_string(result.status), "stalled");
}

INSTANTIATE_TEST_SUITE_P(OfPlanners, RefusedSamples,
                         testing::Values("auto", "pmd-rrt-connect", "pmd-lazy", "rrt-connect",
                                         "pmd-prm"));

}  // namespace
}  // namespace handway::planning
