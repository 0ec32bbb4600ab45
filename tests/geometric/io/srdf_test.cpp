#include "scratch_files.h"

#include <handway/geometric/formats/srdf.h>
#include <handway/geometric/robot/robot_model.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::geometric {
namespace {

using test::input_error_of;
using test::ScratchFiles;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::Pair;

/// base - j1 - l1 - j2 - l2 - f - tip
RobotDescription chain_of_three() {
  RobotDescription robot;
  robot.name = "r";
  for (const char* name : {"base", "l1", "l2", "tip"}) {
    robot.links.push_back({name, {}, {}});
  }
  const auto add = [&](const std::string& name, const std::string& parent,
                       const std::string& child) {
    Joint joint;
    joint.name = name;
    joint.parent = parent;
    joint.child = child;
    robot.joints.push_back(joint);
  };
  add("j1", "base", "l1");
  add("j2", "l1", "l2");
  add("f", "l2", "tip");
  return robot;
}

std::string srdf(const std::string& body) { return "<robot name=\"r\">\n" + body + "</robot>\n"; }

RobotDescription read(const ScratchFiles& files, const std::string& body) {
  RobotDescription robot = chain_of_three();
  read_srdf(files.write("r.srdf", srdf(body)), robot);
  return robot;
}

TEST(SrdfReader, ReportsPassiveJointsThatMove) {
  const ScratchFiles files;
  RobotDescription robot = chain_of_three();
  robot.joints[0].type = JointType::kRevolute;
  robot.joints[1].type = JointType::kRevolute;
  robot.joints[1].mimic = Mimic{"j1", 1.0, 0.0};
  read_srdf(files.write("r.srdf", srdf("<passive_joint name=\"j1\"/><passive_joint name=\"j2\"/>"
                                       "<passive_joint name=\"f\"/>")),
            robot);
  EXPECT_THAT(robot.warnings, ElementsAre(HasSubstr("move like other joints: j1; leave")));
}

TEST(SrdfReader, LetsTheRootMoveByAVirtualJointThatAGroupNames) {
  const ScratchFiles files;
  const RobotDescription robot = read(files, R"(
    <virtual_joint name="world_joint" type="planar" parent_frame="odom" child_link="base"/>
    <group name="arm"><joint name="j1"/></group>
    <group name="everything"><joint name="world_joint"/><group name="arm"/></group>)");
  EXPECT_THAT(robot.groups[0].joints, ElementsAre("j1")) << "the arm stays what it is";
  EXPECT_THAT(robot.groups[1].joints,
              ElementsAre("world_joint/x", "world_joint/y", "world_joint/theta", "j1"));
  const RobotModel model(robot);
  EXPECT_EQ(model.link(0).name, "odom");
  EXPECT_EQ(model.variable_count(), 3);
  EXPECT_THAT(robot.warnings, testing::IsEmpty());
}

TEST(SrdfReader, LeavesTheRootWhereItIsWhereNoGroupNamesTheVirtualJoint) {
  const ScratchFiles files;
  const RobotDescription robot = read(files, R"(
    <virtual_joint name="fixed_base" type="fixed" parent_frame="world" child_link="base"/>
    <virtual_joint name="world_joint" type="floating" parent_frame="world" child_link="base"/>
    <group name="arm"><joint name="j1"/></group>)");
  EXPECT_EQ(RobotModel(robot).link(0).name, "base");
  ASSERT_EQ(robot.virtual_joints.size(), 1U);
  EXPECT_EQ(robot.virtual_joints.front().name, "world_joint");
  EXPECT_THAT(robot.base_joints, testing::IsEmpty());
}

TEST(SrdfReader, ResolvesGroupsByJointsLinksChainsAndGroups) {
  const ScratchFiles files;
  const RobotDescription robot = read(files, R"(
    <group name="by_joint"><joint name="j2"/><joint name="j1"/></group>
    <group name="by_link"><link name="base"/><link name="l2"/></group>
    <group name="by_chain"><chain base_link="base" tip_link="tip"/></group>
    <group name="all"><group name="by_joint"/><joint name="f"/></group>)");
  ASSERT_EQ(robot.groups.size(), 4U);
  EXPECT_THAT(robot.groups[0].joints, ElementsAre("j2", "j1"));
  EXPECT_THAT(robot.groups[1].joints, ElementsAre("j2"));
  EXPECT_THAT(robot.groups[2].joints, ElementsAre("j1", "j2", "f"));
  EXPECT_THAT(robot.groups[3].joints, ElementsAre("j2", "j1", "f"));
}

TEST(SrdfReader, ReadsPostures) {
  const ScratchFiles files;
  const RobotDescription robot = read(files, R"(<group name="g"><joint name="j1"/></group>
    <group_state name="home" group="g"><joint name="j1" value="0.25"/></group_state>)");
  ASSERT_EQ(robot.postures.size(), 1U);
  EXPECT_EQ(robot.postures[0].name, "home");
  EXPECT_THAT(robot.postures[0].values, ElementsAre(Pair("j1", 0.25)));
}

TEST(SrdfReader, ReadsReasonsAndTakesUnknownOnesAsTheUsers) {
  const ScratchFiles files;
  const AllowedCollisions allowed =
      read(files, R"(<disable_collisions link1="l1" link2="base" reason="Adjacent"/>
        <disable_collisions link1="l1" link2="l2" reason="Always"/>
        <disable_collisions link1="l1" link2="tip" reason="Never"/>
        <disable_collisions link1="base" link2="tip" reason="By hand"/>
        <disable_collisions link1="l2" link2="tip"/>)")
          .allowed_collisions;
  EXPECT_EQ(allowed.reason("base", "l1"), AllowedReason::kAdjacent);
  EXPECT_EQ(allowed.reason("l1", "l2"), AllowedReason::kAlways);
  EXPECT_EQ(allowed.reason("tip", "l1"), AllowedReason::kNever);
  EXPECT_EQ(allowed.reason("base", "tip"), AllowedReason::kUser);
  EXPECT_EQ(allowed.reason("l2", "tip"), AllowedReason::kUser);
}

TEST(SrdfReader, AllowsAllPairsOfALinkButThoseThatAreEnabled) {
  const ScratchFiles files;
  const RobotDescription robot = read(files, R"(<disable_default_collisions link="l1"/>
    <enable_collisions link1="tip" link2="l1"/><disable_collisions link1="base" link2="tip"/>)");
  const AllowedCollisions& allowed = robot.allowed_collisions;
  EXPECT_EQ(allowed.reason("base", "l1"), AllowedReason::kUser);
  EXPECT_EQ(allowed.reason("l2", "l1"), AllowedReason::kUser);
  EXPECT_EQ(allowed.entries().size(), 3U);
  EXPECT_THAT(robot.warnings, testing::IsEmpty());
  const auto file = files.folder() / "r.srdf";
  update_srdf(robot, file);
  RobotDescription again = chain_of_three();
  read_srdf(file, again);
  EXPECT_EQ(again.allowed_collisions.entries(), allowed.entries());
}

TEST(SrdfReader, PassesOverWhatTheRobotHasNotAndTellsOnce) {
  const ScratchFiles files;
  const RobotDescription robot = read(files, R"(
<group name="g"><joint name="j3"/><joint name="j1"/><link name="nowhere"/></group>
<group name="arm"><chain base_link="basis" tip_link="tip"/><group name="none"/></group>
<group_state name="s" group="none"/>
<group_state name="home" group="g"><joint name="j1" value="1"/><joint name="j9" value="2"/></group_state>
<disable_collisions link1="basis" link2="tip"/>
<disable_collisions link1="l1" link2="tip"/>)");
  EXPECT_THAT(robot.groups[0].joints, ElementsAre("j1"));
  EXPECT_THAT(robot.groups[1].joints, testing::IsEmpty());
  ASSERT_EQ(robot.postures.size(), 1U);
  EXPECT_THAT(robot.postures[0].values, ElementsAre(Pair("j1", 1.0)));
  EXPECT_EQ(robot.allowed_collisions.entries().size(), 1U);
  EXPECT_THAT(robot.warnings,
              ElementsAre(AllOf(HasSubstr("7 lines"), HasSubstr("r.srdf:3"), HasSubstr("j3"),
                                HasSubstr("(\"j1\"?)"), HasSubstr("and 4 more"))));
}

TEST(SrdfReader, RefusesMisspeltElementsAndTellsOfOthers) {
  const ScratchFiles files;
  const auto refusal = [&](const std::string& body) {
    return input_error_of([&] { static_cast<void>(read(files, body)); });
  };
  EXPECT_THAT(refusal("<disable_collision link1=\"l1\" link2=\"tip\"/>"),
              AllOf(HasSubstr("r.srdf:2"), HasSubstr("Did you mean <disable_collisions>?")));
  EXPECT_THAT(refusal("<grup name=\"g\"/>"), HasSubstr("Did you mean <group>?"));
  EXPECT_THAT(refusal("<group name=\"g\"><chian/></group>"), HasSubstr("<chain>"));
  EXPECT_THAT(read(files, R"(<link_padding link="l1"/><motoman:tool/>)").warnings,
              ElementsAre(AllOf(HasSubstr("<link_padding>"), HasSubstr("<motoman:tool>"))));
}

TEST(SrdfReader, ReadsEndEffectorsAndPassesOverThoseOfUnknownGroups) {
  const ScratchFiles files;
  const RobotDescription robot = read(files, R"(<group name="g"><joint name="j2"/></group>
<end_effector name="e" parent_link="l1" group="g"/>
<end_effector name="f" parent_link="l1" group="h"/>
)");
  EXPECT_THAT(robot.end_effectors, ElementsAre(EndEffector{"e", "g", "l1", ""}));
  EXPECT_THAT(robot.warnings, ElementsAre(HasSubstr("group \"h\"")));
}

TEST(SrdfReader, NamesTheLineOfWhatMakesNoSense) {
  const ScratchFiles files;
  const auto refusal = [&](const std::string& body) {
    return input_error_of([&] { static_cast<void>(read(files, body)); });
  };
  EXPECT_THAT(refusal("<group name=\"g\"><chain base_link=\"tip\" tip_link=\"base\"/></group>"),
              HasSubstr("above"));
  EXPECT_THAT(refusal("<group name=\"g\"><group name=\"g\"/></group>"), HasSubstr("itself"));
  EXPECT_THAT(refusal("<group name=\"g\"/><group name=\"g\"/>"), HasSubstr("two groups"));
  EXPECT_THAT(refusal("<disable_collisions link1=\"base\"/>"), HasSubstr("link2"));
  for (const std::string value : {"nan", "1 2", "x", "1e999"}) {
    EXPECT_THAT(refusal("<group name=\"g\"/><group_state name=\"s\" group=\"g\"><joint "
                        "name=\"j1\" value=\"" +
                        value + "\"/></group_state>"),
                HasSubstr("finite number"));
  }
}

TEST(SrdfReader, LeavesTheRobotUnchangedWhenItFails) {
  const ScratchFiles files;
  RobotDescription robot = chain_of_three();
  robot.groups = {{"old", {"j1"}}};
  const auto file =
      files.write("r.srdf", srdf("<group name=\"new\"/><disable_collisions link1=\"base\"/>"));
  EXPECT_THROW(read_srdf(file, robot), InputError);
  ASSERT_EQ(robot.groups.size(), 1U);
  EXPECT_EQ(robot.groups[0].name, "old");
}

TEST(SrdfWriter, ReplacesTheMatrixAndKeepsTheRest) {
  const ScratchFiles files;
  const auto file = files.write("r.srdf", srdf(R"(<!-- by hand -->
<group name="g"><joint name="j1"/></group>
<disable_collisions link1="base" link2="l1" reason="Never"/>
)"));
  AllowedCollisions allowed;
  allowed.allow("l2", "tip", AllowedReason::kAdjacent);
  allowed.allow("base", "tip", AllowedReason::kUser);
  RobotDescription changed = chain_of_three();
  changed.allowed_collisions = allowed;
  changed.groups = {{"g", {"j1"}}, {"hand", {"j2"}}};
  update_srdf(changed, file);
  EXPECT_THAT(ScratchFiles::read(file), HasSubstr("by hand"));
  RobotDescription robot = chain_of_three();
  read_srdf(file, robot);
  EXPECT_EQ(robot.allowed_collisions.entries(), allowed.entries());
  EXPECT_EQ(robot.groups.size(), 2U);
}

TEST(SrdfWriter, ReplacesDecidedGroupsInTheirPlace) {
  const ScratchFiles files;
  const auto file = files.write("r.srdf", srdf(R"(<!-- by hand -->
<group name="arm"><joint name="j1"/></group>
<group name="hand"><joint name="j2"/></group>
<group name="all"><group name="arm"/></group>
<group_state name="closed" group="hand"><joint name="j2" value="0.1"/></group_state>
<group_state name="up" group="arm"><joint name="j1" value="0.1"/></group_state>
<end_effector name="gripper" parent_link="l1" group="hand"/>
)"));
  RobotDescription changed = chain_of_three();
  read_srdf(file, changed);
  std::erase_if(changed.groups, [](const JointGroup& group) { return group.name == "hand"; });
  changed.groups.front().joints = {"j1", "j2"};
  changed.end_effectors.clear();
  update_srdf(changed, file, {"arm", "hand"});
  EXPECT_THAT(ScratchFiles::read(file), HasSubstr("by hand"));
  RobotDescription robot = chain_of_three();
  read_srdf(file, robot);
  ASSERT_EQ(robot.groups.size(), 2U);
  EXPECT_THAT(robot.groups[0].joints, ElementsAre("j1", "j2"));
  EXPECT_THAT(robot.groups[1].joints, ElementsAre("j1", "j2")) << "which names the arm";
  ASSERT_EQ(robot.postures.size(), 1U);
  EXPECT_EQ(robot.postures[0].name, "up");
  EXPECT_TRUE(robot.end_effectors.empty());
}

TEST(SrdfWriter, MakesAFileWhereThereIsNone) {
  const ScratchFiles files;
  AllowedCollisions allowed;
  allowed.allow("l2", "tip", AllowedReason::kAlways);
  RobotDescription robot = chain_of_three();
  robot.allowed_collisions = allowed;
  robot.groups = {{"hand", {"j2"}}};
  robot.end_effectors = {{"gripper", "hand", "l1", ""}};
  update_srdf(robot, files.folder() / "new.srdf");
  robot = chain_of_three();
  read_srdf(files.folder() / "new.srdf", robot);
  EXPECT_EQ(robot.allowed_collisions.entries(), allowed.entries());
  EXPECT_THAT(robot.end_effectors, ElementsAre(EndEffector{"gripper", "hand", "l1", ""}));
  EXPECT_THAT(robot.warnings, Not(testing::Contains(HasSubstr("robot called"))));
}

TEST(SrdfWriter, LeavesAFileThatIsNoSrdfAlone) {
  const ScratchFiles files;
  const auto file = files.write("r.srdf", "notes");
  EXPECT_THROW(update_srdf(chain_of_three(), file), InputError);
  EXPECT_EQ(ScratchFiles::read(file), "notes");
}

}  // namespace
}  // namespace handway::geometric
