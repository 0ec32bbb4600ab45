#include "handway/planning/core/carried_objects.h"

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/paths/path_check.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace handway::planning {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// A scene of an arm with a gripper of two jaws that carries a bar.
/// @param more lines of the scene. @param bar where the bar is attached.
class CarriedObjects : public ::testing::Test {
 protected:
  [[nodiscard]] PlanningProblem problem(const std::string& more,
                                        const std::string& bar = "link: hand") const {
    std::ofstream(folder_.path() / "gripper.urdf") << R"(<robot name="gripper">
      <link name="hand"><collision><origin xyz="0 0 0.03"/>
        <geometry><box size="0.06 0.2 0.06"/></geometry></collision></link>
      <link name="left"><collision><origin xyz="0 0.01 0.03"/>
        <geometry><box size="0.02 0.015 0.05"/></geometry></collision></link>
      <link name="right"><collision><origin xyz="0 -0.01 0.03"/>
        <geometry><box size="0.02 0.015 0.05"/></geometry></collision></link>
      <joint name="open" type="prismatic"><origin xyz="0 0 0.067"/><axis xyz="0 1 0"/>
        <parent link="hand"/><child link="left"/>
        <limit lower="0.001" upper="0.04" effort="1" velocity="0.2"/></joint>
      <joint name="follow" type="prismatic"><origin xyz="0 0 0.067"/><axis xyz="0 -1 0"/>
        <parent link="hand"/><child link="right"/>
        <limit lower="0.001" upper="0.04" effort="1" velocity="0.2"/></joint></robot>)";
    const std::filesystem::path file = folder_.path() / "scene.yaml";
    std::ofstream(file) << R"(handway: 1
robots:
  - {name: arm, model: iiwa14_class}
  - {name: hand, model: gripper.urdf, mount: {robot: arm}}
objects:
  - {name: bar, box: {size: [0.02, 0.01, 0.1]}, pose: {xyz: [0, 0, 0.14]}, attach: {)"
                        << bar << "}}\n"
                        << more;
    return make_problem(load_scene(file, PluginManager()).scene, nullptr);
  }

  [[nodiscard]] static std::vector<int> variables(const PlanningProblem& problem,
                                                  const std::vector<std::string>& names) {
    std::vector<int> found;
    for (int v = 0; v < problem.model().variable_count(); ++v) {
      const std::string& name = problem.model().variable(v).name;
      if (std::ranges::any_of(names, [&](const auto& end) { return name.ends_with(end); })) {
        found.push_back(v);
      }
    }
    return found;
  }

  test::ScratchFolder folder_;
};

TEST_F(CarriedObjects, FreezeTheHandThatHoldsThem) {
  const PlanningProblem carrying = problem(
      "start: {open: 0.03, follow: 0.03}\ngoal: {joint_1: 0.5, open: 0.03, follow: 0.03}\n");
  const std::vector<int> jaws = variables(carrying, {"open", "follow"});
  ASSERT_EQ(jaws.size(), 2U);
  EXPECT_EQ(carrying.joints.holding, jaws);
  EXPECT_THAT(carrying.joints.hand, IsEmpty());
  for (const int v : carrying.planned_joints()) {
    EXPECT_EQ(std::ranges::count(jaws, v), 0) << carrying.model().variable(v).name;
  }
  EXPECT_EQ(carrying.planned_joints().size(), 7U) << "the arm moves";
}

TEST_F(CarriedObjects, LeaveTheHandFreeWhereTheSceneAsksForIt) {
  const std::string ends =
      "start: {open: 0.03, follow: 0.03}\ngoal: {joint_1: 0.5, open: 0.03, follow: 0.03}\n";
  const PlanningProblem asked = problem(ends + "group: [joint_1, joint_2, open, follow]\n");
  EXPECT_THAT(asked.joints.holding, IsEmpty());
  EXPECT_EQ(asked.joints.hand.size() + asked.joints.arm.size(), 4U);
  const PlanningProblem at_forearm = problem(ends, "link: link_3");
  EXPECT_THAT(carried_objects(*at_forearm.scene), IsEmpty()) << "a tool on the forearm";
  EXPECT_EQ(at_forearm.planned_joints().size(), 9U);
}

TEST_F(CarriedObjects, AreNamedWhereFingersMoveWhileTheyCarry) {
  const PlanningProblem releasing = problem(
      "start: {open: 0.02, follow: 0.03}\ngoal: {joint_1: 0.5, open: 0.03, follow: 0.03}\n");
  const std::vector<int> open = variables(releasing, {"open"});
  const std::vector<int> planned = releasing.planned_joints();
  EXPECT_EQ(std::ranges::count(planned, open.front()), 1) << "the goal asks for it";
  EXPECT_EQ(planned.size(), 8U);
  const Path path{{releasing.start, releasing.goal}};
  EXPECT_THAT(check_path(releasing, path, 0.01).warnings,
              Contains(HasSubstr("moves while the hand holds bar")));
  Configuration still = releasing.start;
  still[0] += 0.1;
  EXPECT_THAT(holding_warnings(*releasing.scene, std::vector{releasing.start, still}), IsEmpty());
  EXPECT_THAT(holding_warnings(*releasing.scene, {}), IsEmpty());
}

}  // namespace
}  // namespace handway::planning
