#include "handway/geometric/robot/joint_selection.h"

#include "handway_test/solid_robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::geometric {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Joints of test::planar_hand_arm(): shoulder 0, elbow 1, thumb 2, left 3, right 4.
class PlanarJoints : public testing::Test {
 protected:
  RobotModel model_{test::planar_hand_arm()};
  JointSelection joints_ = JointSelection::of_groups(model_);
};

TEST_F(PlanarJoints, AreThoseOfTheGroups) {
  EXPECT_THAT(joints_.arm, ElementsAre(0, 1));
  EXPECT_THAT(joints_.hand, ElementsAre(2, 3, 4));
  EXPECT_THAT(joints_.moving, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(joints_.fixed, IsEmpty());
}

TEST_F(PlanarJoints, KeepTheOrderOfTheGivenHandAndTakeTheRestForAMissingArm) {
  const auto other = JointSelection::with_hand(model_, {1, 0});
  EXPECT_THAT(other.hand, ElementsAre(1, 0));
  EXPECT_THAT(other.arm, ElementsAre(2, 3, 4)) << "the group \"arm\" is the hand";
}

TEST_F(PlanarJoints, AreFixedIfTheyMayNotMove) {
  joints_.set_moving({1, 3});
  EXPECT_THAT(joints_.moving, ElementsAre(1, 3));
  EXPECT_THAT(joints_.fixed, ElementsAre(0, 2, 4));
}

TEST_F(PlanarJoints, ArePlannedIfTheyBelongToArmOrHandOrIfTheGoalMovesThem) {
  joints_.arm = {0};
  joints_.hand = {3};
  const Configuration start = Configuration::Zero(5);
  Configuration goal = start;
  EXPECT_THAT(joints_.planned(start, goal), ElementsAre(0, 3));
  goal[4] = 0.1;
  EXPECT_THAT(joints_.planned(start, goal), ElementsAre(0, 3, 4));
  joints_.set_moving({0, 1, 2, 3});
  EXPECT_THAT(joints_.planned(start, goal), ElementsAre(0, 3)) << "4 is fixed";
}

TEST_F(PlanarJoints, AreSelectedByPart) {
  joints_.hand = {4, 2};
  EXPECT_THAT(joints_.of_part("arm"), ElementsAre(0, 1));
  EXPECT_THAT(joints_.of_part("hand"), ElementsAre(2, 4));
  EXPECT_THAT(joints_.of_part("robot"), ElementsAre(0, 1, 2, 4));
  EXPECT_THAT(joints_.outside_arm_and_hand(), ElementsAre(3));
}

TEST_F(PlanarJoints, FormOneLimbOfAnArmThatDoesNotBranch) {
  const std::vector<Limb> found = limbs(model_, joints_);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().arm, joints_.arm);
  EXPECT_EQ(found.front().hand, joints_.hand);
}

}  // namespace
}  // namespace handway::geometric
