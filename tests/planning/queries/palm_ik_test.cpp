#include "handway/planning/queries/palm_ik.h"

#include "handway/geometric/robot/limit_violation.h"
#include "handway_test/input_errors.h"
#include "handway_test/motions.h"
#include "handway_test/planar_problems.h"
#include "handway_test/robots.h"

#include <gtest/gtest.h>

namespace handway::planning {
namespace {

using geometric::Pose;

PalmIk palm_ik(const PlanningProblem& problem) {
  return {problem.scene->robots.front().model, problem.hand.palm, problem.joints.arm};
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
  EXPECT_EQ(move.q(problem.joints.hand), q(problem.joints.hand));
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

TEST(PalmIk, SwingsTheElbowOfARedundantArmWithThePalmFixed) {
  const auto model = std::make_shared<const geometric::RobotModel>(test::iiwa14());
  const std::vector<int> arm = {0, 1, 2, 3, 4, 5, 6};
  const int flange = model->variable_link(6);
  const PalmIk ik(model, flange, arm);
  ASSERT_TRUE(ik.is_redundant());
  Configuration q(7);
  q << 0.3, 0.6, 0.1, -1.2, 0.2, 0.9, 0.0;
  const Pose X_BP = ik.pose(q);
  Eigen::VectorXd direction;
  const Configuration there = ik.swung(q, X_BP, 0.5, direction);
  EXPECT_NEAR((there - q).norm(), 0.5, 0.05);
  EXPECT_LT((ik.pose(there).translation() - X_BP.translation()).norm(), 1e-4);
  EXPECT_LT((ik.pose(there).matrix() - X_BP.matrix()).norm(), 1e-3);
  const Configuration back = ik.swung(there, X_BP, -0.5, direction);
  EXPECT_LT((back - q).norm(), 0.02) << "the other way round";
  const Configuration far = ik.swung(q, X_BP, 100.0, direction);
  EXPECT_TRUE(geometric::limit_violations(*model, far).empty()) << "it ends at a limit";
}

TEST(PalmIk, SwingsNothingOfAnArmThatIsNotRedundant) {
  const PlanningProblem problem = test::tx90_sah_problem();
  const PalmIk ik = palm_ik(problem);
  EXPECT_FALSE(ik.is_redundant());
  Eigen::VectorXd direction;
  EXPECT_EQ(ik.swung(problem.start, ik.pose(problem.start), 0.3, direction), problem.start);
}

TEST(ReachFigures, FallToNothingInASingularPostureAndRiseToTheReach) {
  const geometric::RobotModel model(test::iiwa14());
  const std::vector<int> arm = {0, 1, 2, 3, 4, 5, 6};
  const int flange = model.variable_link(6);
  Configuration q = Configuration::Zero(7);
  const auto stretched = reach_figures(model, flange, arm, q);
  q << 0.3, 0.6, 0.1, -1.2, 0.2, 0.9, 0.0;
  const auto bent = reach_figures(model, flange, arm, q);
  ASSERT_TRUE(stretched && bent);
  EXPECT_NEAR(stretched->manipulability, 0.0, 1e-9);
  EXPECT_GT(bent->manipulability, 0.01);
  EXPECT_GT(stretched->reach, 0.95);
  EXPECT_LE(stretched->reach, 1.0 + 1e-9);
  EXPECT_LT(bent->reach, stretched->reach);
  EXPECT_FALSE(reach_figures(model, 0, arm, q)) << "no joint moves the base";
}

TEST(PalmIk, RefusesALinkThatTheArmDoesNotMove) {
  const PlanningProblem problem = test::open_problem();
  EXPECT_NE(test::refusal_of([&] {
              static_cast<void>(PalmIk(problem.scene->robots.front().model, 0, problem.joints.arm));
            }),
            "");
}

}  // namespace
}  // namespace handway::planning
