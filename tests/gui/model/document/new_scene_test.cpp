#include "model/document/new_scene.h"

#include "app/start/new_scene_dialog.h"
#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/geometric/setup/placing.h"
#include "handway/planning/core/planning_problem.h"

#include <gtest/gtest.h>

namespace handway::gui {
namespace {

/// Returns the fault that prevents using the robot of a new scene; empty if there is none.
std::string fault_of(const planning::SceneState& loaded) {
  auto scene = std::make_shared<geometric::Scene>(*loaded.scene);
  const geometric::RobotInstance& robot = scene->robots.front();
  scene->start = scene->goal = robot.configuration;
  const auto problem = planning::make_problem(scene, nullptr);
  const auto checker = problem.checker->clone();
  std::string faults;
  for (const geometric::NamedPair& pair :
       geometric::find_collisions(*checker, robot.configuration)) {
    faults += geometric::to_string(pair) + "; ";
  }
  for (const auto& violation : geometric::limit_violations(*robot.model, robot.configuration)) {
    faults += violation.joint + " is beyond its limits; ";
  }
  return faults;
}

TEST(NewScene, StartsFreeWithEveryArmAndEveryHandThatShips) {
  const planning::PluginManager plugins;
  int count = 0;
  for (const LibraryRobot& arm : library_robots()) {
    const std::string without = fault_of(new_scene(arm.name, {}, plugins));
    EXPECT_EQ(without, "") << arm.name;
    for (const LibraryRobot& hand : library_robots()) {
      if (arm.has_arm && !arm.has_hand && !hand.has_arm) {
        EXPECT_EQ(fault_of(new_scene(arm.name, hand.name, plugins)), "")
            << hand.name << " on " << arm.name;
        ++count;
      }
    }
  }
  EXPECT_GE(count, 12);
}

TEST(NewScene, ShowsArmsInTheirReadyPostureOnATable) {
  const planning::PluginManager plugins;
  const planning::SceneState loaded = new_scene("ur5e_class", {}, plugins);
  const geometric::RobotInstance& robot = loaded.scene->robots.front();
  EXPECT_NEAR(robot.configuration[1], -1.25, 1e-9);
  ASSERT_EQ(loaded.scene->objects.size(), 1U);
  const geometric::SceneObject& table = loaded.scene->objects.front();
  EXPECT_EQ(table.name, "table");
  const geometric::Aabb box = geometric::bounds(*loaded.scene, robot.configuration, {table.name});
  EXPECT_NEAR(box.lower.z(), 0.0, 1e-9);
  EXPECT_NEAR(robot.X_WB.translation().z(), box.upper.z(), 0.01);
  const auto X_WT = geometric::link_pose(*loaded.scene, robot.configuration, robot.name,
                                         robot.model->link(robot.model->link_count() - 1).name);
  ASSERT_TRUE(X_WT);
  EXPECT_GT(X_WT->translation().z(), box.upper.z() + 0.1) << "it does not lie flat";
  EXPECT_TRUE(box.lower.head<2>().minCoeff() < 0.0 &&
              (X_WT->translation().head<2>().array() < box.upper.head<2>().array()).all() &&
              (X_WT->translation().head<2>().array() > box.lower.head<2>().array()).all())
      << "the hand works above the table";
}

TEST(NewScene, HasNoTableForAHandAlone) {
  const planning::PluginManager plugins;
  EXPECT_TRUE(new_scene("leap_class_right", {}, plugins).scene->objects.empty());
}

}  // namespace
}  // namespace handway::gui
