#include "scene_files.h"

#include <handway/geometric/formats/robot_loader.h>
#include <handway/geometric/formats/scene_file.h>
#include <handway/geometric/formats/urdf.h>
#include <handway/geometric/robot/robot_state.h>
#include <handway/geometric/scene/scene_difference.h>
#include <handway/geometric/setup/mounting.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::geometric {
namespace {

using test::input_error_of;
using test::ScratchFiles;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A folder with `arm.urdf` (base, j1, upper, j2, flange), `gripper.urdf` (base, two fingers by the
/// joints `left` and `right`, and `j1`, which turns the left tip) and `camera.urdf` (no joints).
class Robots : public ScratchFiles {
 public:
  Robots() {
    write("arm.urdf", "<robot name=\"arm\">" + link("base", "0.2 0.2 0.2") +
                          link("upper", "0.1 0.1 0.1") + link("flange", "0.05 0.05 0.05") +
                          joint("j1", "base", "upper", "0 0 0.5") +
                          joint("j2", "upper", "flange", "0 0 0.5") + "</robot>");
    write("gripper.urdf", "<robot name=\"gripper\">" + link("base", "0.06 0.06 0.02") +
                              link("finger_l", "0.01 0.01 0.05") +
                              link("finger_r", "0.01 0.01 0.05") + link("tip_l", "0.01 0.01 0.02") +
                              joint("left", "base", "finger_l", "0 0.05 0.05") +
                              joint("right", "base", "finger_r", "0 -0.05 0.05") +
                              joint("j1", "finger_l", "tip_l", "0 0 0.05") + "</robot>");
    write("gripper.srdf",
          "<robot name=\"gripper\"><group name=\"left_finger\"><joint name=\"left\"/></group>"
          "<group_state name=\"open\" group=\"left_finger\"><joint name=\"left\" value=\"0.2\"/>"
          "</group_state>"
          "<disable_collisions link1=\"base\" link2=\"finger_l\" reason=\"Adjacent\"/></robot>");
    write("camera.urdf", "<robot name=\"camera\">" + link("body", "0.03 0.03 0.03") + "</robot>");
  }

  [[nodiscard]] Scene scene(const std::string& text) const {
    return read_scene(write("scene.yaml", "handway: 1\n" + text));
  }

  [[nodiscard]] std::string refusal(const std::string& text) const {
    return input_error_of([&] { static_cast<void>(scene(text)); });
  }

 private:
  static std::string link(const std::string& name, const std::string& size) {
    return "<link name=\"" + name + "\"><collision><geometry><box size=\"" + size +
           "\"/></geometry></collision></link>\n";
  }
  static std::string joint(const std::string& name, const std::string& parent,
                           const std::string& child, const std::string& xyz) {
    return "<joint name=\"" + name + "\" type=\"revolute\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/><origin xyz=\"" + xyz +
           "\"/><axis xyz=\"1 0 0\"/><limit lower=\"-1\" upper=\"1\" effort=\"0\" "
           "velocity=\"1\"/></joint>\n";
  }
};

constexpr const char* kArmAndHand = R"(robots:
  - {name: arm, model: arm.urdf, configuration: {j1: 0.1, hand/j1: 0.5}}
  - name: hand
    model: gripper.urdf
    mount: {robot: arm, link: flange, pose: {xyz: [0, 0, 0.1], rpy_deg: [0, 0, 90]}}
    configuration: {j1: 0.3, left: 0.2}
)";

std::vector<std::string> variables(const RobotModel& model) {
  std::vector<std::string> names;
  for (int v = 0; v < model.variable_count(); ++v) {
    names.push_back(model.variable(v).name);
  }
  return names;
}

std::vector<std::string> joints_of_group(const RobotModel& model, const std::string& name) {
  std::vector<std::string> names;
  for (const int variable : model.find_group(name).value_or(std::vector<int>{})) {
    names.push_back(model.variable(variable).name);
  }
  return names;
}

TEST(SceneMounts, MakeOneRobotOfSeveral) {
  const Robots files;
  const Scene scene = files.scene(std::string(kArmAndHand) + "start: {j2: 0.4, right: -0.2}\n");
  ASSERT_EQ(scene.robots.size(), 1U);
  const RobotInstance& robot = scene.robots.front();
  EXPECT_EQ(robot.name, "arm");
  EXPECT_EQ(robot.parts.size(), 2U);
  EXPECT_THAT(variables(*robot.model), ElementsAre("j1", "j2", "left", "hand/j1", "right"));
  EXPECT_EQ(robot.configuration, (Configuration(5) << 0.1, 0, 0.2, 0.3, 0).finished());
  EXPECT_EQ(*scene.start, (Configuration(5) << 0.1, 0.4, 0.2, 0.3, -0.2).finished());
  const int mounted = robot.model->find_link("hand/base").value();
  EXPECT_EQ(robot.model->link(robot.model->parent(mounted)).name, "flange");
  EXPECT_EQ(robot.model->joint(mounted).X_PJ.translation(), Eigen::Vector3d(0, 0, 0.1));
}

TEST(SceneMounts, MakeGroupsAndKeepThoseOfTheParts) {
  const Robots files;
  const Scene scene = files.scene(kArmAndHand);
  const RobotModel& model = *scene.robots.front().model;
  EXPECT_THAT(joints_of_group(model, "arm"), ElementsAre("j1", "j2"));
  EXPECT_THAT(joints_of_group(model, "hand"), ElementsAre("left", "hand/j1", "right"));
  EXPECT_THAT(joints_of_group(model, "left_finger"), ElementsAre("left"));
  ASSERT_EQ(model.description().postures.size(), 1U);
  EXPECT_EQ(model.description().postures.front().values.at("left"), 0.2);
  EXPECT_THAT(model.description().end_effectors,
              ElementsAre(EndEffector{"hand", "hand", "flange", "arm"}));
  const AllowedCollisions& allowed = model.description().allowed_collisions;
  EXPECT_EQ(allowed.reason("hand/base", "finger_l"), AllowedReason::kAdjacent);
  EXPECT_EQ(allowed.reason("flange", "hand/base"), AllowedReason::kAdjacent);
  EXPECT_EQ(allowed.reason("upper", "hand/base"), std::nullopt);
}

TEST(SceneMounts, NameLinksByTheirPartsToo) {
  const Robots files;
  const Scene scene = files.scene(std::string(kArmAndHand) + R"(objects:
  - {name: pad, box: {size: [0.01, 0.01, 0.01]}, attach: {robot: hand, link: base, touching: [tip_l]}}
)");
  const Attachment& attachment = scene.objects.front().attachment.value();
  EXPECT_EQ(attachment.robot, "arm");
  EXPECT_EQ(attachment.link, "hand/base");
  EXPECT_THAT(attachment.touching, ElementsAre("tip_l"));
}

TEST(SceneMounts, CarryRobotsOnRobotsInAnyOrder) {
  const Robots files;
  const Scene scene = files.scene(R"(robots:
  - {name: eye, model: camera.urdf, mount: {robot: right, link: base}}
  - {name: right, model: gripper.urdf, mount: {robot: arm, link: flange}}
  - {name: post, model: camera.urdf}
  - {name: arm, model: arm.urdf}
  - {name: left, model: gripper.urdf, mount: {robot: arm, link: upper}}
)");
  ASSERT_EQ(scene.robots.size(), 2U);
  EXPECT_EQ(scene.robots[0].name, "arm");
  EXPECT_EQ(scene.robots[1].name, "post");
  const RobotModel& model = *scene.robots[0].model;
  EXPECT_THAT(joints_of_group(model, "left"), ElementsAre("left/left", "left/j1", "left/right"));
  EXPECT_THAT(joints_of_group(model, "right"),
              ElementsAre("right/left", "right/j1", "right/right"));
  EXPECT_EQ(model.find_group("hand")->size(), 6U);
  EXPECT_EQ(model.link(model.parent(model.find_link("body").value())).name, "right/base");
}

TEST(SceneMounts, AreWrittenAndReadBack) {
  const Robots files;
  const Scene scene = files.scene(std::string(kArmAndHand) + "goal: {hand/j1: 0.7}\n");
  write_scene(scene, files.folder() / "deeper.yaml");
  const Scene again = read_scene(files.folder() / "deeper.yaml");
  ASSERT_EQ(again.robots.size(), 1U);
  const RobotInstance& before = scene.robots.front();
  const RobotInstance& after = again.robots.front();
  EXPECT_EQ(after.configuration, before.configuration);
  EXPECT_EQ(*again.goal, *scene.goal);
  ASSERT_EQ(after.parts.size(), 2U);
  EXPECT_EQ(after.parts[1].name, "hand");
  EXPECT_EQ(after.parts[1].file, "gripper.urdf");
  EXPECT_EQ(after.parts[1].link, "flange");
  EXPECT_TRUE(after.parts[1].X_LB.isApprox(before.parts[1].X_LB, 1e-13));
}

TEST(SceneMounts, AreOneRobotFileOnRequest) {
  const Robots files;
  const Scene scene = files.scene(kArmAndHand);
  const RobotModel& composed = *scene.robots.front().model;
  write_urdf(composed, files.folder() / "both.urdf");
  const auto read = load_robot(files.folder() / "both.urdf");
  EXPECT_EQ(variables(*read), variables(composed));
  EXPECT_EQ(read->description().allowed_collisions.entries(),
            composed.description().allowed_collisions.entries());
  EXPECT_EQ(read->description().end_effectors, composed.description().end_effectors);
  EXPECT_EQ(joints_of_group(*read, "hand"), joints_of_group(composed, "hand"));
}

TEST(SceneMounts, SitAtTheEndOfAnArmWhereNoLinkIsNamed) {
  const Robots files;
  const Scene scene = files.scene(
      "robots:\n  - {name: arm, model: arm.urdf}\n"
      "  - {name: hand, model: gripper.urdf, mount: {robot: arm}}\n");
  const RobotPart& hand = scene.robots.front().parts[1];
  EXPECT_EQ(hand.link, "flange");
  EXPECT_TRUE(hand.X_LB.translation().isApprox(Eigen::Vector3d(0, 0, 0.01), 1e-12));
  write_scene(scene, scene.file);
  EXPECT_EQ(read_scene(scene.file).robots.front().parts[1].link, "flange");
  EXPECT_THAT(files.refusal("robots:\n  - {name: hand, model: gripper.urdf}\n"
                            "  - {name: eye, model: camera.urdf, mount: {robot: hand}}\n"),
              AllOf(HasSubstr("robots[1].mount: found no \"link\""),
                    HasSubstr("a link of hand, which is not an arm with one end"),
                    HasSubstr("Name the link that carries eye")));
}

TEST(SceneMounts, SayWhatIsWrongWithThem) {
  const Robots files;
  const auto refusal = [&](const std::string& mount, const std::string& more = "") {
    return files.refusal("robots:\n  - {name: arm, model: arm.urdf" + more +
                         "}\n  - {name: hand, model: gripper.urdf, mount: " + mount + "}\n");
  };
  EXPECT_THAT(refusal("{robot: amr, link: flange}"),
              AllOf(HasSubstr("scene.yaml:4: robots[1].mount.robot"), HasSubstr("\"amr\""),
                    HasSubstr("There are: arm, hand")));
  EXPECT_THAT(refusal("{robot: arm, link: flnge}"),
              AllOf(HasSubstr("robots[1].mount.link"), HasSubstr("Did you mean \"flange\"?")));
  EXPECT_THAT(refusal("{robot: hand, link: base}"), HasSubstr("a ring of mounts: hand on hand"));
  EXPECT_THAT(
      refusal("{robot: arm, link: flange}", ", mount: {robot: hand, link: base}"),
      HasSubstr("scene.yaml:3: robots[0].mount: found a ring of mounts: arm on hand on arm"));
  EXPECT_THAT(refusal("[{robot: arm, link: flange}, {robot: arm, link: base}]"),
              AllOf(HasSubstr("robots[1].mount"), HasSubstr("a list of 2")));
  EXPECT_THAT(refusal("{robot: arm, link: flange}, base: {xyz: [0, 0, 1]}"),
              AllOf(HasSubstr("robots[1].base"), HasSubstr("mounted")));
  EXPECT_THAT(refusal("{link: flange}"), HasSubstr("robots[1].mount: found no \"robot\""));
}

TEST(SceneMounts, AskAboutLinksThatOverlapInEveryPosture) {
  const Robots files;
  const Scene scene = files.scene(R"(robots:
  - {name: arm, model: arm.urdf}
  - {name: eye, model: camera.urdf, mount: {robot: arm, link: upper, pose: {xyz: [0, 0, 0.5]}}}
)");
  EXPECT_THAT(scene.warnings, testing::Contains(AllOf(HasSubstr("overlap in every posture"),
                                                      HasSubstr("flange"), HasSubstr("body"))));
}

TEST(SceneMounts, AskOnceForEachMountThatIsPosedBadly) {
  const Robots files;
  const Scene scene = files.scene(R"(robots:
  - {name: arm, model: arm.urdf}
  - {name: hand, model: gripper.urdf, mount: {robot: arm, link: upper, pose: {xyz: [0, 0.03, 0.47]}}}
)");
  EXPECT_THAT(scene.warnings, testing::Contains(HasSubstr("overlap in every posture")).Times(1));
  EXPECT_THAT(scene.warnings,
              testing::Contains(AllOf(HasSubstr("arm and hand overlap in every posture"),
                                      HasSubstr("flange with finger_r and 1 more"))));
}

TEST(SceneMounts, CountAsADifferenceOfScenes) {
  const Robots files;
  const Scene before = files.scene(kArmAndHand);
  Scene after = before;
  ASSERT_TRUE(scene_difference(before, after));
  EXPECT_TRUE(scene_difference(before, after)->empty());
  move_mount(after, "hand", Pose(Eigen::Translation3d(0, 0, 0.2)));
  EXPECT_FALSE(scene_difference(before, after));
}

TEST(MountRobot, KeepsWhatTheSceneSays) {
  const Robots files;
  Scene scene = files.scene(R"(robots:
  - {name: arm, model: arm.urdf, configuration: {j1: 0.1}}
  - {name: hand, model: gripper.urdf, configuration: {j1: 0.3}}
objects:
  - {name: pad, box: {size: [0.01, 0.01, 0.01]}, attach: {robot: hand, link: base}}
start: {j2: 0.4}
postures: {up: {j1: 0.2}}
)");
  mount_robot(scene, "hand", "arm", "flange", Pose(Eigen::Translation3d(0, 0, 0.1)));
  ASSERT_EQ(scene.robots.size(), 1U);
  const RobotInstance& robot = scene.robots.front();
  EXPECT_EQ(robot.configuration, (Configuration(5) << 0.1, 0, 0, 0.3, 0).finished());
  EXPECT_EQ(*scene.start, (Configuration(5) << 0.1, 0.4, 0, 0.3, 0).finished());
  EXPECT_EQ(scene.objects.front().attachment->robot, "arm");
  EXPECT_EQ(scene.objects.front().attachment->link, "hand/base");
  EXPECT_EQ(scene.postures.front().values.at("j1"), 0.2);
  move_mount(scene, "hand", Pose(Eigen::Translation3d(0, 0, 0.2)));
  const RobotModel& moved = *scene.robots.front().model;
  EXPECT_EQ(moved.joint(moved.find_link("hand/base").value()).X_PJ.translation().z(), 0.2);
  EXPECT_EQ(scene.robots.front().configuration[3], 0.3);
}

TEST(MountRobot, RefusesRobotsThatAreNotThereOrCarryTheCarrier) {
  const Robots files;
  Scene scene = files.scene(kArmAndHand);
  const auto refusal = [&](const std::string& robot, const std::string& carrier) {
    return input_error_of([&] { mount_robot(scene, robot, carrier, "base", Pose::Identity()); });
  };
  EXPECT_THAT(refusal("leg", "arm"), HasSubstr("no robot \"leg\""));
  EXPECT_THAT(refusal("arm", "hand"), HasSubstr("carries hand already"));
  EXPECT_THAT(input_error_of([&] { move_mount(scene, "arm", Pose::Identity()); }),
              HasSubstr("not mounted"));
}

constexpr const char* kHandWithEye = R"(robots:
  - {name: arm, model: arm.urdf, configuration: {j1: 0.1}}
  - {name: hand, model: gripper.urdf, mount: {robot: arm, link: flange}, configuration: {j1: 0.3}}
  - {name: eye, model: camera.urdf, mount: {robot: hand, link: finger_l}}
objects:
  - {name: pad, box: {size: [0.01, 0.01, 0.01]}, attach: {robot: hand, link: base, touching: [tip_l]}}
  - {name: box, box: {size: [0.01, 0.01, 0.01]}, attach: {link: flange, touching: [hand/base]}}
start: {j2: 0.4, hand/j1: 0.2}
postures: {up: {j1: 0.2, hand/j1: 0.1}, closed: {left: 0.1}}
goal_pose: [{link: finger_l, xyz: [0, 0, 1]}, {link: flange, xyz: [0, 0, 1]}]
)";

TEST(UnmountRobot, StandsWhereItWasWithAllThatItCarries) {
  const Robots files;
  Scene scene = files.scene(kHandWithEye);
  RobotState whole(scene.robots.front().model);
  whole.set_configuration(scene.robots.front().configuration);
  const Pose X_WB = whole.link_pose("hand/base");
  const Pose X_WE = whole.link_pose("body");
  unmount_robot(scene, "hand");
  ASSERT_EQ(scene.robots.size(), 2U);
  const RobotInstance& arm = scene.robots[0];
  const RobotInstance& hand = scene.robots[1];
  EXPECT_TRUE(arm.parts.empty());
  EXPECT_EQ(arm.configuration, (Configuration(2) << 0.1, 0).finished());
  EXPECT_EQ(*scene.start, (Configuration(2) << 0.1, 0.4).finished());
  EXPECT_THAT(variables(*hand.model), ElementsAre("left", "j1", "right"));
  EXPECT_EQ(hand.parts.size(), 2U);
  EXPECT_EQ(hand.configuration[1], 0.3);
  EXPECT_TRUE(hand.X_WB.isApprox(X_WB));
  RobotState state(hand.model, hand.X_WB);
  state.set_configuration(hand.configuration);
  EXPECT_TRUE(state.link_pose("body").isApprox(X_WE));
  EXPECT_EQ(scene.objects[0].attachment->robot, "hand");
  EXPECT_EQ(scene.objects[0].attachment->link, "base");
  EXPECT_THAT(scene.objects[0].attachment->touching, ElementsAre("tip_l"));
  EXPECT_EQ(scene.objects[1].attachment->robot, "arm");
  EXPECT_TRUE(scene.objects[1].attachment->touching.empty()) << "the hand is another robot now";
  ASSERT_EQ(scene.postures.size(), 1U);
  EXPECT_EQ(scene.postures.front().values, (std::map<std::string, double>{{"j1", 0.2}}));
  ASSERT_EQ(scene.goal_poses.size(), 1U);
  EXPECT_EQ(scene.goal_poses.front().link, "flange");
  write_scene(scene, files.folder() / "apart.yaml");
  EXPECT_EQ(read_scene(files.folder() / "apart.yaml").robots.size(), 2U);
}

TEST(UnmountRobot, IsTheOppositeOfMounting) {
  const Robots files;
  Scene scene = files.scene(kArmAndHand);
  const Pose X_LB = scene.robots.front().parts[1].X_LB;
  const Configuration q = scene.robots.front().configuration;
  unmount_robot(scene, "hand");
  mount_robot(scene, "hand", "arm", "flange", X_LB);
  ASSERT_EQ(scene.robots.size(), 1U);
  EXPECT_EQ(scene.robots.front().configuration, q);
  EXPECT_THAT(input_error_of([&] { unmount_robot(scene, "arm"); }), HasSubstr("not mounted"));
}

TEST(RemoveRobot, LeavesWhatItCarriedInPlace) {
  const Robots files;
  Scene scene = files.scene(kHandWithEye);
  RobotState whole(scene.robots.front().model);
  whole.set_configuration(scene.robots.front().configuration);
  const Pose X_WB = whole.link_pose("hand/base");
  remove_robot(scene, "hand");
  ASSERT_EQ(scene.robots.size(), 1U);
  EXPECT_EQ(scene.robots.front().model->variable_count(), 2);
  EXPECT_FALSE(scene.objects[0].attachment);
  EXPECT_TRUE(scene.objects[0].X_PO.isApprox(X_WB));
  EXPECT_TRUE(scene.objects[1].attachment);
  remove_robot(scene, "arm");
  EXPECT_TRUE(scene.robots.empty());
  EXPECT_FALSE(scene.start);
  EXPECT_TRUE(scene.postures.empty());
  EXPECT_THAT(input_error_of([&] { remove_robot(scene, "arm"); }), HasSubstr("no robot \"arm\""));
}

TEST(MountRobot, RenamesTheLinksOfGoalsAsPoses) {
  const Robots files;
  Scene scene = files.scene(R"(robots:
  - {name: hand, model: gripper.urdf}
  - {name: arm, model: arm.urdf}
goal_pose: {link: tip_l, xyz: [0, 0, 1]}
)");
  scene.goal_poses.push_back(scene.goal_poses.front());
  scene.goal_poses.back().link = "base";
  mount_robot(scene, "hand", "arm", "flange", Pose::Identity());
  EXPECT_EQ(scene.goal_poses[0].link, "tip_l");
  EXPECT_EQ(scene.goal_poses[1].link, "hand/base");
}

constexpr const char* kCollisions = R"(robots:
  - {name: arm, model: arm.urdf, padding: {upper: 0.01}}
  - {name: hand, model: gripper.urdf, base: {xyz: [2, 0, 0]}, padding: {base: 0.02, tip_l: 0.03}}
  - {name: other, model: camera.urdf, base: {xyz: [4, 0, 0]}}
objects:
  - {name: box, box: {size: [0.01, 0.01, 0.01]}}
collisions:
  allowed: [[box, flange], [hand/base, other/body], [box, hand/tip_l]]
  checked: [[hand/base, hand/tip_l], [base, upper]]
)";

using Touching = std::map<AllowedCollisions::Pair, bool>;
using Paddings = std::map<std::string, Padding>;

TEST(MountRobot, KeepsPaddingAndWhichPairsAreChecked) {
  const Robots files;
  Scene scene = files.scene(kCollisions);
  const Scene before = scene;
  mount_robot(scene, "hand", "arm", "flange", Pose(Eigen::Translation3d(0, 0, 0.1)));
  EXPECT_EQ(scene.allowed_collisions, (Touching{{{"box", "flange"}, true},
                                                {{"hand/base", "other/body"}, true},
                                                {{"box", "tip_l"}, true},
                                                {{"hand/base", "tip_l"}, false},
                                                {{"base", "upper"}, false}}));
  EXPECT_EQ(scene.robots[0].padding,
            (Paddings{{"upper", {1.0, 0.01}}, {"hand/base", {1.0, 0.02}}, {"tip_l", {1.0, 0.03}}}));
  unmount_robot(scene, "hand");
  EXPECT_EQ(scene.allowed_collisions, before.allowed_collisions);
  EXPECT_EQ(scene.robots[0].padding, before.robots[0].padding);
  EXPECT_EQ(scene.robots[1].padding, before.robots[1].padding);
}

TEST(RemoveRobot, ForgetsItsPairsAndNamesTheLinksOfTheNextFirstAlone) {
  const Robots files;
  Scene scene = files.scene(kCollisions);
  remove_robot(scene, "arm");
  EXPECT_EQ(scene.allowed_collisions, (Touching{{{"base", "other/body"}, true},
                                                {{"box", "tip_l"}, true},
                                                {{"base", "tip_l"}, false}}));
}

TEST(PutFirst, NamesLinksAsTheNewOrderHasThem) {
  const Robots files;
  Scene scene = files.scene(kCollisions);
  put_first(scene, "hand");
  EXPECT_EQ(scene.robots.front().name, "hand");
  EXPECT_EQ(scene.allowed_collisions, (Touching{{{"arm/flange", "box"}, true},
                                                {{"base", "other/body"}, true},
                                                {{"box", "tip_l"}, true},
                                                {{"base", "tip_l"}, false},
                                                {{"arm/base", "arm/upper"}, false}}));
  EXPECT_EQ(scene.robots.front().padding.size(), 2U);
}

TEST(ComposedRobot, FindsJointsOfPartsByTheirOwnNames) {
  const Robots files;
  const Scene scene = files.scene(R"(robots:
  - {name: arm, model: camera.urdf}
  - {name: one, model: gripper.urdf, mount: {robot: arm, link: body}}
  - {name: two, model: arm.urdf, mount: {robot: arm, link: body}}
)");
  const RobotModel& model = *scene.robots.front().model;
  EXPECT_EQ(find_variable_of_part(model, "left"), model.find_variable("left"));
  EXPECT_EQ(find_variable_of_part(model, "one/j1"), model.find_variable("one/j1"));
  EXPECT_EQ(find_variable_of_part(model, "j1"), std::nullopt) << "of two parts";
  EXPECT_EQ(find_variable_of_part(model, "j3"), std::nullopt);
}

}  // namespace
}  // namespace handway::geometric
