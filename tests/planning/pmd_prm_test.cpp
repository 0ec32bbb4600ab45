#include "handway/planning/planners/planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <handway_test/planar_problems.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::unique_ptr<Planner> planner_as_shipped() { return PlannerRegistry().create("pmd-prm"); }

std::unique_ptr<Planner> planner_as_printed() {
  std::unique_ptr<Planner> planner = planner_as_shipped();
  for (const geometric::Parameter& parameter : planner->parameters()) {
    if (!parameter.as_printed.empty()) {
      planner->set_parameter(parameter.key, parameter.as_printed);
    }
  }
  return planner;
}

// The upper arm is held between two pins of the robot's own base, 20 µm away on either side: hardly
// a sample of the arm is free. Only the hand has to move.
PlanningProblem held_between_pins() {
  constexpr double kAngle = -1.0;
  constexpr double kAside = 0.02 + 0.005 + 20e-6;
  const Eigen::AngleAxisd turn(kAngle, Eigen::Vector3d::UnitZ());
  geometric::RobotDescription robot = test::planar_hand_arm();
  for (const double side : {-kAside, kAside}) {
    const geometric::Pose X_LG(turn * Eigen::Translation3d(0.2, side, 0.0));
    robot.links.front().collision.push_back({geometric::Box{{0.01, 0.01, 0.1}}, X_LG, {}});
  }
  robot.allowed_collisions = {};
  robot.allowed_collisions.allow("upper", "lower", geometric::AllowedReason::kAdjacent);
  for (const auto& [a, b] : {std::pair("lower", "palm"),
                             {"palm", "thumb"},
                             {"palm", "left"},
                             {"palm", "right"},
                             {"left", "left_tip"},
                             {"right", "right_tip"}}) {
    robot.allowed_collisions.allow(a, b, geometric::AllowedReason::kAdjacent);
  }
  return test::planar_problem(test::scene_of(robot), test::planar_configuration(kAngle, 0.0, 0.3),
                              test::planar_configuration(kAngle, 0.0, -0.3));
}

TEST(PmdPrm, NamesWhatDepartsFromThePrint) {
  std::vector<std::string> keys;
  for (const geometric::Parameter& parameter : departures(planner_as_shipped()->parameters())) {
    keys.push_back(parameter.key);
  }
  EXPECT_THAT(keys, ElementsAre("rho_max", "fill_gaps", "n_checked", "smoothing"));
  EXPECT_THAT(departures(planner_as_printed()->parameters()), IsEmpty());
}

TEST(PmdPrm, GrowsTheCorridorWithoutLimitAsPrinted) {
  const auto printed = planner_as_printed();
  printed->set_parameter("rho_a", "0.02");
  printed->set_parameter("max_samples", "20000");
  EXPECT_GT(printed->plan(test::walled_in_problem(), {}).statistics.final_rho_a, 1.0);
  const auto shipped = planner_as_shipped();
  shipped->set_parameter("rho_a", "0.02");
  shipped->set_parameter("max_samples", "20000");
  EXPECT_DOUBLE_EQ(shipped->plan(test::walled_in_problem(), {}).statistics.final_rho_a, 0.05);
}

TEST(PmdPrm, GrowsTheCorridorByEqualStepsAsTheAuthorsProgram) {
  const auto linear = planner_as_printed();
  linear->set_parameter("growth", "linear");
  linear->set_parameter("max_samples", "20000");
  const PlanStatistics statistics = linear->plan(test::walled_in_problem(), {}).statistics;
  EXPECT_GT(statistics.passes, 2U);
  EXPECT_DOUBLE_EQ(statistics.final_rho_a, static_cast<double>(statistics.passes) * 0.001);
  EXPECT_THAT(departures(linear->parameters()),
              ElementsAre(testing::Field(&geometric::Parameter::key, "growth")));
}

TEST(PmdPrm, ChecksNAtTheEndOfEachPassAsPrinted) {
  const auto printed = planner_as_printed();
  printed->set_parameter("max_samples", "100");
  const PlanResult result = printed->plan(test::walled_in_problem(), {});
  EXPECT_EQ(result.status, PlanStatus::kSamplesSpent);
  EXPECT_EQ(result.statistics.passes, 1U);
  EXPECT_GT(result.statistics.samples, 100U);
  const auto shipped = planner_as_shipped();
  shipped->set_parameter("max_samples", "100");
  EXPECT_EQ(shipped->plan(test::walled_in_problem(), {}).statistics.samples, 100U);
}

TEST(PmdPrm, StallsWithoutAnyLimitWhereThereIsNothingToSample) {
  const auto shipped = planner_as_shipped();
  const auto printed = planner_as_printed();
  for (Planner* planner : {shipped.get(), printed.get()}) {
    planner->set_parameter("arm_trials", "1");
    planner->set_parameter("n_a", "2");
    const PlanResult result = planner->plan(held_between_pins(), {});
    EXPECT_EQ(result.status, PlanStatus::kStalled);
    EXPECT_THAT(result.reason, HasSubstr("stalled after"));
    EXPECT_TRUE(result.path.empty());
  }
}

}  // namespace
}  // namespace handway::planning
