#include "handway/geometric/robot/robot_state.h"

#include "handway/geometric/io/input_error.h"
#include "handway_test/robots.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

namespace handway::geometric {
namespace {

class RobotStateTest : public ::testing::Test {
 protected:
  std::shared_ptr<const RobotModel> model_ = std::make_shared<const RobotModel>(test::tx90_sah());
  RobotState state_{model_};
};

TEST_F(RobotStateTest, StartsInTheNeutralConfiguration) {
  EXPECT_EQ(state_.configuration(), model_->neutral());
  EXPECT_TRUE(state_.within_limits());
  EXPECT_TRUE(state_.link_pose("base_link").isApprox(Pose::Identity()));
}

TEST_F(RobotStateTest, PlacesLinksInTheWorld) {
  const Pose X_WB = pose_from_rpy({1.0, 2.0, 3.0}, 0.1, 0.2, 0.3);
  const Pose X_BP = state_.link_pose("Palm");
  const RobotState placed(model_, X_WB);
  EXPECT_TRUE(placed.link_pose("Palm").isApprox(X_WB * X_BP, 1e-12));
  EXPECT_TRUE(placed.link_pose(0).isApprox(X_WB, 1e-12));
  EXPECT_EQ(static_cast<int>(placed.link_poses().size()), model_->link_count());
}

TEST_F(RobotStateTest, MovesCoupledJointsWithTheirLeader) {
  state_.set_joint("Mid-Med", -0.5);
  EXPECT_DOUBLE_EQ(state_.joint_value("Mid-Med"), -0.5);
  EXPECT_DOUBLE_EQ(state_.joint_value("Mid-Dist"), -0.5);
}

TEST_F(RobotStateTest, SetsAPostureOrNothing) {
  state_.set_posture({"ready", "arm", {{"joint_1", 0.4}, {"joint_3", 1.0}}});
  EXPECT_DOUBLE_EQ(state_.joint_value("joint_1"), 0.4);
  EXPECT_DOUBLE_EQ(state_.joint_value("joint_3"), 1.0);
  const Configuration before = state_.configuration();
  EXPECT_THROW(state_.set_posture({"bad", "arm", {{"joint_1", 0.9}, {"no_joint", 1.0}}}),
               InputError);
  EXPECT_EQ(state_.configuration(), before);
}

TEST_F(RobotStateTest, TellsWhenItIsOutOfLimits) {
  state_.set_joint("joint_5", 3.0);
  EXPECT_FALSE(state_.within_limits());
}

TEST_F(RobotStateTest, RefusesWhatItCannotSet) {
  EXPECT_THROW(state_.set_configuration(Configuration::Zero(3)), InputError);
  Configuration q = model_->neutral();
  q[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(state_.set_configuration(q), InputError);
  EXPECT_THROW(state_.set_joint("Mid-Dist", 0.0), InputError);
  EXPECT_THROW(state_.set_joint("joint_1", std::numeric_limits<double>::infinity()), InputError);
  EXPECT_THROW((void)state_.joint_value("Palm"), InputError);
  EXPECT_THROW((void)state_.link_pose("no_link"), InputError);
}

TEST_F(RobotStateTest, NamesTheJointItCouldNotSet) {
  try {
    state_.set_joint("elbow", 1.0);
    FAIL() << "expected a refusal";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problem().element, "joint elbow");
  }
}

}  // namespace
}  // namespace handway::geometric
