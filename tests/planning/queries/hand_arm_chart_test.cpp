#include "handway/planning/queries/hand_arm_chart.h"

#include "handway/geometric/robot/normalised_joints.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <handway_test/planar_problems.h>

namespace handway::planning {
namespace {

using testing::SizeIs;
using Kind = HandArmChart::Axis::Kind;

class HandArmChartOfTheFlatArm : public testing::Test {
 protected:
  PlanningProblem problem_ = test::open_problem();
  HandArmChart chart_{problem_};
};

TEST_F(HandArmChartOfTheFlatArm, HasAnAxisForEveryDirection) {
  const auto& basis = *problem_.basis;
  ASSERT_THAT(chart_.axes(), SizeIs(basis.dimension() + 3));
  EXPECT_EQ(chart_.axes()[0].kind, Kind::kArmWay);
  EXPECT_EQ(chart_.axes()[1].kind, Kind::kArmDistance);
  EXPECT_EQ(chart_.axes()[2].kind, Kind::kFreeJoint);
  EXPECT_EQ(chart_.axes()[3].kind, Kind::kDirection);
  EXPECT_EQ(chart_.axes()[3].name, basis.directions[0].name);
  EXPECT_EQ(chart_.axes().back().kind, Kind::kHandDistance);
}

TEST_F(HandArmChartOfTheFlatArm, GoesFromStartToGoalAlongTheArmsMotion) {
  EXPECT_NEAR(chart_.at(problem_.start)[0], 0.0, 1e-12);
  EXPECT_NEAR(chart_.at(problem_.goal)[0], 1.0, 1e-12);
  const Configuration between = 0.75 * problem_.start + 0.25 * problem_.goal;
  EXPECT_NEAR(chart_.at(between)[0], 0.25, 1e-12);
  EXPECT_NEAR(chart_.at(between)[1], 0.0, 1e-12);
}

TEST_F(HandArmChartOfTheFlatArm, MeasuresWhatIsBesideTheMotion) {
  Configuration beside = problem_.start;
  Eigen::VectorXd motion =
      (geometric::normalised(problem_.model(), problem_.goal) -
       geometric::normalised(problem_.model(), problem_.start))(problem_.joints.arm);
  ASSERT_EQ(motion.size(), 2);
  Eigen::VectorXd joints = geometric::normalised(problem_.model(), problem_.start);
  const Eigen::Vector2d across = Eigen::Vector2d(-motion[1], motion[0]).normalized() * 0.02;
  joints(problem_.joints.arm) += across;
  beside = geometric::denormalised(problem_.model(), joints);
  EXPECT_NEAR(chart_.at(beside)[0], 0.0, 1e-9);
  EXPECT_NEAR(chart_.at(beside)[1], 0.02, 1e-9);
}

TEST_F(HandArmChartOfTheFlatArm, GivesTheCoordinatesOfTheBasis) {
  Eigen::VectorXd joints = geometric::normalised(problem_.model(), problem_.goal);
  joints(problem_.joints.hand) =
      sampling::map_to_posture(*problem_.basis, Eigen::Vector3d(0.5, 0.75, 0.5));
  const Eigen::VectorXd at = chart_.at(geometric::denormalised(problem_.model(), joints));
  EXPECT_NEAR(at[2], 0.0, 1e-9);
  EXPECT_NEAR(at[3], 0.5 * problem_.basis->directions[0].half_side, 1e-9);
  EXPECT_NEAR(at[4], 0.0, 1e-9);
  EXPECT_NEAR(at[5], 0.0, 1e-9) << "a posture of the subspace";
}

TEST_F(HandArmChartOfTheFlatArm, AgreesWithTheProjection) {
  const Eigen::VectorXd hand =
      geometric::normalised(problem_.model(), problem_.goal)(problem_.joints.hand);
  const Eigen::VectorXd at = chart_.at(problem_.goal);
  EXPECT_TRUE(at.segment(2, problem_.basis->dimension())
                  .isApprox(sampling::project(*problem_.basis, hand), 1e-9) ||
              sampling::project(*problem_.basis, hand).norm() < 1e-9);
  EXPECT_NEAR(at.tail(1)[0], sampling::distance_to_subspace(*problem_.basis, hand), 1e-9);
}

TEST(HandArmChart, DoesWithoutABasis) {
  PlanningProblem problem = test::open_problem();
  problem.basis = nullptr;
  const HandArmChart chart(problem);
  EXPECT_THAT(chart.axes(), SizeIs(2));
  EXPECT_THAT(chart.at(problem.goal), SizeIs(2));
}

}  // namespace
}  // namespace handway::planning
