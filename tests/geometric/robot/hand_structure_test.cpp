#include <handway/geometric/robot/hand_structure.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <handway_test/robots.h>

#include <optional>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

using test::turning;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

Joint fixed(const std::string& parent, const std::string& child, double length = 0.01) {
  Joint joint = turning(child + "_mount", parent, child);
  joint.type = JointType::kFixed;
  joint.X_PJ.translation().z() = length;
  return joint;
}

RobotModel robot(const std::vector<std::string>& links, const std::vector<Joint>& joints) {
  RobotDescription robot;
  robot.name = "robot";
  for (const std::string& link : links) {
    robot.links.emplace_back().name = link;
  }
  robot.joints = joints;
  return RobotModel(robot);
}

/// A thumb of one joint and a finger of two on a palm, with frames fixed to both.
RobotModel hand_with_frames() {
  return robot(
      {"palm", "thumb", "thumb_tip", "finger", "finger_sensor", "end", "end_sensor", "end_tip"},
      {turning("oppose", "palm", "thumb"), fixed("thumb", "thumb_tip"),
       turning("bend", "palm", "finger"), fixed("finger", "finger_sensor"),
       turning("curl", "finger", "end"), fixed("end", "end_sensor", 0.005),
       fixed("end", "end_tip", 0.02)});
}

std::vector<std::string> names(const RobotModel& model, const LinkIndices& links) {
  std::vector<std::string> names;
  for (const int link : links) {
    names.push_back(model.link(link).name);
  }
  return names;
}

std::string palm(const RobotModel& model, const JointIndices& arm, const JointIndices& hand) {
  return model.link(HandStructure::of(model, arm, hand).palm).name;
}

TEST(HandStructure, ListsTheJointsAndLinksOfEachFinger) {
  const RobotModel model = hand_with_frames();
  const HandStructure hand = HandStructure::of(model, {}, {0, 1, 2});
  EXPECT_EQ(model.link(hand.palm).name, "palm");
  ASSERT_THAT(hand.fingers, SizeIs(2));
  EXPECT_THAT(hand.fingers[0].joints, ElementsAre(0));
  EXPECT_THAT(names(model, hand.fingers[0].links), ElementsAre("thumb", "thumb_tip"));
  EXPECT_THAT(hand.fingers[1].joints, ElementsAre(1, 2));
}

TEST(HandStructure, TakesFramesOfSensorsForPartsOfTheirFinger) {
  const RobotModel model = hand_with_frames();
  const HandStructure hand = HandStructure::of(model, {}, {0, 1, 2});
  ASSERT_THAT(hand.fingers, SizeIs(2));
  EXPECT_THAT(
      names(model, hand.fingers[1].links),
      testing::UnorderedElementsAre("finger", "finger_sensor", "end", "end_sensor", "end_tip"));
  EXPECT_EQ(model.link(hand.fingers[1].tip).name, "end_tip") << "the farthest";
  EXPECT_THAT(names(model, fingertips(model, {0, 1, 2})), ElementsAre("thumb_tip", "end_tip"));
}

TEST(HandStructure, BeginsFingersBeyondAPartOfThePalmThatMoves) {
  const RobotModel model =
      robot({"palm", "thumb", "arch", "ring", "little"},
            {turning("oppose", "palm", "thumb"), turning("fold", "palm", "arch"),
             turning("ring_bend", "arch", "ring"), turning("little_bend", "arch", "little")});
  const HandStructure hand = HandStructure::of(model, {}, {0, 1, 2, 3});
  ASSERT_THAT(hand.fingers, SizeIs(3));
  EXPECT_EQ(model.link(hand.palm).name, "palm");
  EXPECT_THAT(names(model, hand.fingers[1].links), ElementsAre("ring"));
  EXPECT_THAT(names(model, hand.fingers[2].links), ElementsAre("little"));
}

TEST(HandStructure, TakesThePalmBeyondAWristThatCountsToTheHand) {
  const RobotModel model =
      robot({"forearm", "wrist", "palm", "thumb", "finger", "tip"},
            {turning("flexion", "forearm", "wrist"), turning("deviation", "wrist", "palm"),
             turning("oppose", "palm", "thumb"), turning("bend", "palm", "finger"),
             turning("curl", "finger", "tip")});
  EXPECT_EQ(palm(model, {}, {0, 1, 2, 3, 4}), "palm");
  EXPECT_EQ(palm(model, {0, 1}, {2, 3, 4}), "palm");
  const JointIndices one_finger{*model.find_variable("bend"), *model.find_variable("curl")};
  EXPECT_EQ(palm(model, {}, one_finger), "palm");
}

TEST(HandStructure, IsOfTheFirstOfTwoHandsOnArmsThatOneTorsoMoves) {
  const RobotModel model =
      robot({"base", "torso", "left", "jaw", "jaw2", "right", "jaw3", "jaw4"},
            {turning("bow", "base", "torso"), turning("arm", "torso", "left"),
             turning("finger", "left", "jaw"), turning("thumb", "left", "jaw2"),
             turning("arm2", "torso", "right"), turning("finger2", "right", "jaw3"),
             turning("thumb2", "right", "jaw4")});
  EXPECT_EQ(palm(model, {0, 1, 4}, {2, 3, 5, 6}), "left");
  EXPECT_EQ(palm(model, {0, 1, 4}, {5, 6, 2, 3}), "right");
  EXPECT_THAT(HandStructure::of(model, {0, 1, 4}, {2, 3, 5, 6}).fingers, SizeIs(2));
  EXPECT_THAT(fingertips(model, {2, 3, 5, 6}), SizeIs(4)) << "of both hands";
}

TEST(HandStructure, HasNoFingersWithoutAHand) {
  const RobotModel model = robot({"base", "upper", "fore", "flange"},
                                 {turning("shoulder", "base", "upper"),
                                  turning("elbow", "upper", "fore"), fixed("fore", "flange")});
  const HandStructure hand = HandStructure::of(model, {0, 1}, {});
  EXPECT_EQ(model.link(hand.palm).name, "fore") << "the last that the arm moves";
  EXPECT_THAT(hand.fingers, IsEmpty());
  EXPECT_EQ(model.link(last_fixed_link(model, hand.palm)).name, "flange");
}

}  // namespace
}  // namespace handway::geometric
