// Tests how far fingertips of robots' hands reach where those of a human hand do.

#include "handway/device/retargeting/workspace_overlap.h"

#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/resources.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace handway::device {
namespace {

using geometric::RobotDescription;
using geometric::RobotModel;

std::shared_ptr<const RobotModel> hand_called(const std::string& hand) {
  return geometric::load_robot(geometric::find_resource(geometric::ResourceKind::kRobot, hand,
                                                        std::filesystem::current_path(), "test"));
}

WorkspaceOverlap overlap_of(std::shared_ptr<const RobotModel> hand,
                            const WorkspaceOverlapSettings& settings = {}) {
  RetargetingSettings only_kinematics;
  only_kinematics.self_collision = false;
  return workspace_overlap(FingertipRetargeter(std::move(hand), only_kinematics), settings);
}

// The hand with every joint locked near its middle.
std::shared_ptr<const RobotModel> stiff(const RobotModel& hand) {
  RobotDescription description = hand.description();
  for (geometric::Joint& joint : description.joints) {
    const double middle = 0.5 * (joint.limits.lower + joint.limits.upper);
    joint.limits.lower = middle - 0.01;
    joint.limits.upper = middle + 0.01;
  }
  return std::make_shared<const RobotModel>(std::move(description));
}

TEST(WorkspaceOverlap, HasAPartForEachFingerOfTheRobot) {
  const WorkspaceOverlap overlap = overlap_of(hand_called("sah_right"));
  ASSERT_EQ(overlap.fingers.size(), 4U);
  EXPECT_EQ(overlap.fingers.front().finger, Finger::kThumb);
  double sum = 0.0;
  for (const FingertipOverlap& finger : overlap.fingers) {
    EXPECT_GT(finger.shared, 0.0) << name_of(finger.finger);
    EXPECT_LE(finger.shared, finger.human) << name_of(finger.finger);
    EXPECT_LE(finger.shared, finger.robot) << name_of(finger.finger);
    sum += finger.coverage();
  }
  EXPECT_DOUBLE_EQ(overlap.coverage(), sum / 5.0) << "the little finger is missing";
}

TEST(WorkspaceOverlap, IsLargeForAHandThatIsBuiltLikeAHumanOne) {
  const double shadow = overlap_of(hand_called("shadow_class_right")).coverage();
  EXPECT_GT(shadow, overlap_of(hand_called("sah_right")).coverage());
  EXPECT_GT(shadow, overlap_of(hand_called("leap_class_right")).coverage());
}

TEST(WorkspaceOverlap, IsSmallForFingersThatHardlyMove) {
  const auto hand = hand_called("shadow_class_right");
  const double moving = overlap_of(hand).coverage();
  EXPECT_LT(overlap_of(stiff(*hand)).coverage(), 0.2 * moving);
}

TEST(WorkspaceOverlap, DependsLittleOnTheSeed) {
  const auto hand = hand_called("sah_right");
  EXPECT_NEAR(overlap_of(hand, {.seed = 2}).coverage(), overlap_of(hand).coverage(), 0.02);
}

TEST(WorkspaceOverlap, RefusesSettingsOutOfRange) {
  EXPECT_THROW(static_cast<void>(overlap_of(hand_called("sah_right"), {.postures = 0})),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(overlap_of(hand_called("sah_right"), {.voxel = 0.0})),
               std::invalid_argument);
}

}  // namespace
}  // namespace handway::device
