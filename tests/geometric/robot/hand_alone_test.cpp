#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/robot/group_proposal.h"
#include "handway_test/paths.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace handway::geometric {
namespace {

std::shared_ptr<const RobotModel> shipped(const std::string& name) {
  return load_robot(find_resource(ResourceKind::kRobot, name, test::source_dir()));
}

TEST(HandAlone, HasTheJointsOfTheHandAndTheirMotion) {
  const auto robot = shipped("tx90_sah");
  const auto hand = hand_alone(robot);
  const auto known = shipped("sah_right");
  ASSERT_EQ(hand->variable_count(), known->variable_count());
  Configuration q = robot->neutral();
  const Configuration bent = hand->lower() + 0.3 * (hand->upper() - hand->lower());
  for (int v = 0; v < hand->variable_count(); ++v) {
    EXPECT_TRUE(known->find_variable(hand->variable(v).name)) << hand->variable(v).name;
    q[robot->find_variable(hand->variable(v).name).value()] = bent[v];
  }
  std::vector<Pose> X_HL(static_cast<std::size_t>(hand->link_count()));
  std::vector<Pose> X_BL(static_cast<std::size_t>(robot->link_count()));
  hand->forward_kinematics(bent, X_HL);
  robot->forward_kinematics(q, X_BL);
  const auto in_robot = [&](int link) {
    return X_BL[static_cast<std::size_t>(robot->find_link(hand->link(link).name).value())];
  };
  for (int link = 1; link < hand->link_count(); ++link) {
    EXPECT_TRUE(
        X_HL[static_cast<std::size_t>(link)].isApprox(in_robot(0).inverse() * in_robot(link), 1e-9))
        << hand->link(link).name;
  }
}

TEST(HandAlone, KeepsTheWristThatComesWithTheHand) {
  const auto scene = read_scene(test::source_dir() / "scenes/ur5e_and_shadow.yaml");
  const auto hand = hand_alone(scene.robots.front().model);
  EXPECT_EQ(hand->variable_count(), 20);
  EXPECT_TRUE(hand->find_variable("wrist_flexion"));
  EXPECT_FALSE(hand->find_variable("shoulder_pan_joint"));
}

TEST(HandAlone, KeepsWhichLinksMayTouch) {
  const auto robot = shipped("tx90_sah");
  const auto hand = hand_alone(robot);
  EXPECT_FALSE(hand->description().allowed_collisions.entries().empty());
  for (const auto& [pair, reason] : hand->description().allowed_collisions.entries()) {
    EXPECT_EQ(robot->description().allowed_collisions.reason(pair.first, pair.second), reason);
  }
}

TEST(HandAlone, IsAHandWithoutAnArmItself) {
  const auto hand = shipped("shadow_class_right");
  EXPECT_EQ(hand_alone(hand), hand);
}

}  // namespace
}  // namespace handway::geometric
