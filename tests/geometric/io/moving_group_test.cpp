/// Tests which joints of a scene's robots move: `group` in scene files.
#include "scratch_files.h"

#include <handway/geometric/formats/scene_file.h>
#include <handway/geometric/setup/moving_group.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::geometric {
namespace {

using test::input_error_of;
using test::ScratchFiles;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A folder with `arm.urdf`: base, joint a, upper, joint b, flange, and with `claw.urdf`: base,
/// joint c, finger.
class TwoArms : public testing::Test {
 protected:
  TwoArms() {
    files_.write("arm.urdf", "<robot name=\"arm\">" + link("base") + link("upper") +
                                 link("flange") + joint("a", "base", "upper") +
                                 joint("b", "upper", "flange") + "</robot>");
    files_.write("claw.urdf", "<robot name=\"claw\">" + link("base") + link("finger") +
                                  joint("c", "base", "finger") + "</robot>");
    files_.write("claw.srdf",
                 "<robot name=\"claw\"><group name=\"hand\"><joint name=\"c\"/></group></robot>");
  }

  /// Two arms side by side, the left one with a claw.
  [[nodiscard]] Scene scene(const std::string& more) const {
    return read_scene(files_.write("scene.yaml", R"(handway: 1
robots:
  - {name: left, model: arm.urdf, base: {xyz: [0, 1, 0]}, configuration: {a: 0.1}}
  - {name: claw, model: claw.urdf, mount: {robot: left, link: flange}}
  - {name: right, model: arm.urdf, base: {xyz: [0, -1, 0.5]}, configuration: {b: 0.2}}
)" + more));
  }
  [[nodiscard]] std::string refusal(const std::string& more) const {
    return input_error_of([&] { static_cast<void>(scene(more)); });
  }
  [[nodiscard]] static std::vector<std::string> moving(const Scene& scene) {
    std::vector<std::string> names;
    for (const int v : moving_variables(scene)) {
      names.push_back(scene.robots.front().model->variable(v).name);
    }
    return names;
  }

  ScratchFiles files_;

 private:
  static std::string link(const std::string& name) {
    return "<link name=\"" + name +
           "\"><collision><geometry><box size=\"0.1 0.1 0.1\"/></geometry></collision></link>";
  }
  static std::string joint(const std::string& name, const std::string& parent,
                           const std::string& child) {
    return "<joint name=\"" + name + "\" type=\"revolute\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + R"("/><origin xyz="0 0 0.4"/><axis xyz="1 0 0"/>)" +
           R"(<limit lower="-1" upper="1" effort="0" velocity="1"/></joint>)";
  }
};

TEST_F(TwoArms, MoveAsTheFirstRobotWithoutAGroup) {
  const Scene scene = this->scene("");
  EXPECT_EQ(scene.robots.size(), 2U);
  EXPECT_THAT(moving(scene), ElementsAre("a", "b", "c"));
}

TEST_F(TwoArms, MoveByGroupsRobotsAndJoints) {
  EXPECT_THAT(moving(scene("group: hand\n")), ElementsAre("c"));
  EXPECT_THAT(moving(scene("group: [claw, a]\n")), ElementsAre("a", "c"));
  EXPECT_THAT(moving(scene("group: left\n")), ElementsAre("a", "b"));
  EXPECT_THAT(moving(scene("group: [left/b, left]\n")), ElementsAre("a", "b")) << "each once";
}

TEST_F(TwoArms, BecomeOneRobotWhereTheyStandIfTheGroupNamesTheOther) {
  const Scene alone = scene("group: right\nstart: {right/a: 0.3}\ngoal: {right/a: 0.5}\n");
  ASSERT_EQ(alone.robots.size(), 1U);
  const RobotInstance& robot = alone.robots.front();
  EXPECT_THAT(moving(alone), ElementsAre("right/a", "right/b"));
  EXPECT_EQ(robot.configuration[*robot.model->find_variable("right/b")], 0.2);
  std::vector<Pose> X_BL(static_cast<std::size_t>(robot.model->link_count()));
  robot.model->forward_kinematics(robot.configuration, X_BL);
  const auto base = static_cast<std::size_t>(*robot.model->find_link("right/base"));
  EXPECT_TRUE((robot.X_WB * X_BL[base]).translation().isApprox(Eigen::Vector3d(0, -1, 0.5)));
  EXPECT_THAT(moving(scene("group: [left, right/b]\n")), ElementsAre("a", "b", "right/b"));
}

TEST_F(TwoArms, AreWrittenAndReadBack) {
  const Scene scene = this->scene("group: [right, hand]\ngoal: {right/a: 0.5, c: 0.1}\n");
  write_scene(scene, files_.folder() / "again.yaml");
  const Scene again = read_scene(files_.folder() / "again.yaml");
  EXPECT_EQ(again.group, scene.group);
  EXPECT_EQ(moving(again), moving(scene));
  EXPECT_EQ(*again.goal, *scene.goal);
}

TEST_F(TwoArms, KeepTheStartInTheGoalForWhatDoesNotMove) {
  const Scene scene = this->scene("group: hand\nstart: {a: 0.4}\ngoal: {c: 0.7}\n");
  const RobotModel& model = *scene.robots.front().model;
  EXPECT_EQ((*scene.goal)[*model.find_variable("a")], 0.4);
  EXPECT_EQ((*scene.goal)[*model.find_variable("c")], 0.7);
  Scene other = this->scene("start: {a: 0.4}\ngoal: {a: 0.9, c: 0.7}\n");
  set_moving_group(other, {"hand"});
  EXPECT_EQ(*other.goal, *scene.goal);
}

TEST_F(TwoArms, AreRefusedByNamesThatTheyHaveNot) {
  EXPECT_THAT(
      refusal("group: [left, righ]\n"),
      AllOf(HasSubstr("group[1]: found \"righ\", expected a group, robot or joint that "
                      "moves: arm, hand, left, claw, right, a, b, c. Did you mean \"right\"?")));
  EXPECT_THAT(refusal("group: []\n"), HasSubstr("an empty list"));
  EXPECT_THAT(refusal("group: upper\n"), HasSubstr("that moves")) << "a link";
  Scene scene = this->scene("");
  EXPECT_THAT(input_error_of([&] {
                set_moving_group(scene, {"right", "wrong"});
              }),
              HasSubstr("\"wrong\""));
  EXPECT_EQ(scene.robots.size(), 2U) << "as it was";
  EXPECT_THAT(scene.group, IsEmpty());
}

}  // namespace
}  // namespace handway::geometric
