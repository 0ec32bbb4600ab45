#include "handway/planning/queries/palm_ik.h"

#include "handway_test/input_errors.h"
#include "handway_test/motions.h"
#include "handway_test/planar_problems.h"

#include <gtest/gtest.h>

namespace handway::planning {
namespace {

using geometric::Pose;

PalmIk palm_ik(const PlanningProblem& problem) {
  const geometric::RobotModel& model = problem.model();
  return {problem.scene->robots.front().model, palm_link(model, problem.arm, problem.hand),
          problem.arm};
}

TEST(PalmIk, TakesTheLinkThatCarriesAllFingers) {
  const PlanningProblem problem = test::tx90_sah_problem();
  const geometric::RobotModel& model = problem.model();
  EXPECT_EQ(model.link(palm_link(model, problem.arm, problem.hand)).name, "Palm");
  EXPECT_EQ(palm_link(model, problem.arm, {}), model.variable_link(problem.arm.back()));
}

TEST(PalmIk, BringsThePalmThereAndLeavesTheFingersAlone) {
  const PlanningProblem problem = test::tx90_sah_problem();
  const PalmIk ik = palm_ik(problem);
  const Configuration q = test::tx90_sah_path().waypoints[1];
  Pose X_BP = ik.pose(q);
  X_BP.pretranslate(Eigen::Vector3d(0.02, -0.03, 0.01));
  const PalmMove move = ik.moved(q, X_BP);
  ASSERT_TRUE(move.reached);
  EXPECT_TRUE(ik.pose(move.q).isApprox(X_BP, 1e-9));
  EXPECT_EQ(move.q(problem.hand), q(problem.hand));
  EXPECT_LT((move.q - q).cwiseAbs().maxCoeff(), 0.3) << "near to where it was";
}

TEST(PalmIk, ListsEveryBranch) {
  const PlanningProblem problem = test::tx90_sah_problem();
  const PalmIk ik = palm_ik(problem);
  const Configuration q = test::tx90_sah_path().waypoints[1];
  const std::vector<Configuration> postures = ik.all(q, ik.pose(q));
  ASSERT_GE(postures.size(), 2U);
  EXPECT_TRUE(postures.front().isApprox(q, 1e-9));
  for (const Configuration& posture : postures) {
    EXPECT_TRUE(ik.pose(posture).isApprox(ik.pose(q), 1e-9));
  }
}

TEST(PalmIk, GetsAsNearAsTheArmReaches) {
  const PlanningProblem problem = test::tx90_sah_problem();
  const PalmIk ik = palm_ik(problem);
  const Configuration q = test::tx90_sah_path().waypoints[1];
  Pose X_BP = ik.pose(q);
  X_BP.translation() *= 5.0;
  const PalmMove move = ik.moved(q, X_BP);
  EXPECT_FALSE(move.reached);
  EXPECT_LT((ik.pose(move.q).translation() - X_BP.translation()).norm(),
            (ik.pose(q).translation() - X_BP.translation()).norm());
}

TEST(PalmIk, MovesAnArmOfTwoJointsToAPlace) {
  const PlanningProblem problem = test::open_problem();
  const PalmIk ik = palm_ik(problem);
  Pose X_BP = ik.pose(problem.goal);
  X_BP.pretranslate(Eigen::Vector3d(-0.02, 0.01, 0.0));
  const PalmMove move = ik.moved(problem.goal, X_BP);
  ASSERT_TRUE(move.reached);
  EXPECT_NEAR((ik.pose(move.q).translation() - X_BP.translation()).norm(), 0.0, 1e-4);
}

TEST(PalmIk, RefusesALinkThatTheArmDoesNotMove) {
  const PlanningProblem problem = test::open_problem();
  EXPECT_NE(test::refusal_of([&] {
              static_cast<void>(PalmIk(problem.scene->robots.front().model, 0, problem.arm));
            }),
            "");
}

}  // namespace
}  // namespace handway::planning
