#include <handway/geometric/setup/robot_setup.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>

namespace handway::geometric {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

/// A base and a lever that turns about z, 0.5 m above it.
RobotDescription two_boxes() {
  RobotDescription robot;
  for (const char* name : {"base", "lever"}) {
    Link link{name, {}, {}};
    link.collision.emplace_back().shape = Box{{0.1, 0.1, 0.1}};
    robot.links.push_back(link);
  }
  Joint joint;
  joint.name = "turn";
  joint.type = JointType::kRevolute;
  joint.parent = "base";
  joint.child = "lever";
  joint.X_PJ.translation().z() = 0.5;
  joint.limits = {-1.0, 1.0, 1.0};
  robot.joints.push_back(joint);
  return robot;
}

std::vector<RobotFinding> findings_of(const RobotDescription& robot,
                                      const std::vector<SampledPair>& pairs = {},
                                      int colliding = 0) {
  return examine_robot(RobotModel(robot), {100, colliding, pairs}, {});
}

auto says(const std::string& found) {
  return Contains(Field(&RobotFinding::found, HasSubstr(found)));
}

TEST(RobotFindings, AreNoneForAnInconspicuousRobot) {
  EXPECT_THAT(findings_of(two_boxes(), {{"base", "lever", 10}}, 10), IsEmpty());
}

TEST(RobotFindings, LeaveOutPairsThatTheUserAllows) {
  SampledPair pair{"base", "lever", 90, true, true};
  pair.by_user = true;
  EXPECT_THAT(findings_of(two_boxes(), {pair}), IsEmpty());
  pair.by_user = false;
  EXPECT_THAT(findings_of(two_boxes(), {pair}), says("base and lever touch"));
}

TEST(RobotFindings, SeeWrongUnits) {
  RobotDescription robot = two_boxes();
  robot.links[1].collision[0].shape = Box{{100, 100, 100}};
  EXPECT_THAT(findings_of(robot), says("link lever is 100 m long"));
  robot.links[1].collision[0].shape = Box{{1e-4, 1e-4, 1e-4}};
  EXPECT_THAT(findings_of(robot), says("link lever is 0.1 mm long"));
  robot.links[1].collision[0].shape = Box{{0.01, 0.01, 0.01}};
  robot.links[1].visual.emplace_back().shape = Box{{1, 1, 1}};
  EXPECT_THAT(findings_of(robot), says("looks 1 m long and collides as one of 0.01 m"));
}

TEST(RobotFindings, SeeFacesThatPointInwards) {
  RobotDescription robot = two_boxes();
  auto mesh = std::make_shared<TriangleMesh>(*tessellate(Box{}));
  for (auto& triangle : mesh->triangles) {
    std::swap(triangle[0], triangle[1]);
  }
  robot.links[0].collision[0].shape = Mesh{"", Eigen::Vector3d::Ones(), mesh};
  EXPECT_THAT(findings_of(robot), says("point inwards: base"));
}

TEST(RobotFindings, SeeJointsWithoutVelocityLimit) {
  RobotDescription robot = two_boxes();
  robot.joints[0].limits = {-1.0, 1.0};
  EXPECT_THAT(findings_of(robot), says("no velocity limit: turn"));
  robot.joints[0].limits = {0.0, 0.0};
  EXPECT_THAT(findings_of(robot), testing::Not(says("no velocity limit"))) << "it never moves";
}

TEST(RobotFindings, SeePairsThatTouchWhereTheyShouldNot) {
  EXPECT_THAT(findings_of(two_boxes(), {{"base", "lever", 100, true, true}}),
              says("touch in every posture"));
  EXPECT_THAT(findings_of(two_boxes(), {{"base", "lever", 93, true, true}}),
              says("touch at the zero posture and in 93 % of random ones"));
  EXPECT_THAT(findings_of(two_boxes(), {{"base", "lever", 3, false, true}}),
              says("touch at the middle posture, and in 3 %"));
  EXPECT_THAT(findings_of(two_boxes(), {{"base", "lever", 92, false, false}}, 92),
              says("92 % of random postures collide, most by base with lever (92 %)"));
}

TEST(RobotFindings, PassOnWhatIsOpenAboutTheGroups) {
  GroupProposal groups;
  groups.questions = {{"WRJ1 leads to the palm", "Decide"}};
  EXPECT_THAT(examine_robot(RobotModel(two_boxes()), {100, 0, {}}, groups),
              Contains(AllOf(Field(&RobotFinding::found, "WRJ1 leads to the palm"),
                             Field(&RobotFinding::mend, "Decide"))));
}

}  // namespace
}  // namespace handway::geometric
