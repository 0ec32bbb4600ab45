#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "model/document/document.h"
#include "small_cell.h"

#include <gmock/gmock.h>
#include <handway_test/paths.h>

#include <fstream>

namespace handway::test {
namespace {

TEST(SaveScene, WritesWhatOpensAsTheSame) {
  const SmallCell cell;
  const planning::PluginManager plugins;
  const planning::SceneState before = planning::load_scene(cell.post(), plugins);
  geometric::Configuration shown = before.scene->robots.front().configuration;
  shown[0] = 0.25;
  const std::filesystem::path file = cell.folder() / "saved.yaml";
  gui::save_scene(before, shown, {"rrt-connect", {{"step", "0.1"}}}, file);

  const planning::SceneState after = planning::load_scene(file, plugins);
  EXPECT_EQ(after.scene->robots.front().configuration, shown);
  EXPECT_EQ(after.scene->goal, before.scene->goal);
  EXPECT_EQ(after.scene->planner.name, "rrt-connect");
  EXPECT_THAT(after.scene->planner.settings,
              ::testing::ElementsAre(::testing::Pair("step", "0.1")));
  ASSERT_TRUE(after.basis);
  EXPECT_EQ(after.basis->joints, before.basis->joints);
}

TEST(SaveScene, KeepsWhereATaskWithoutAStartBegins) {
  const SmallCell cell;
  const planning::PluginManager plugins;
  const planning::SceneState loaded = planning::load_scene(cell.post(), plugins);
  geometric::Scene scene = *loaded.scene;
  scene.start.reset();
  const geometric::Configuration stood = scene.robots.front().configuration;
  const std::filesystem::path file = cell.folder() / "saved.yaml";
  gui::save_scene({std::make_shared<const geometric::Scene>(scene), loaded.basis}, *scene.goal, {},
                  file);
  const planning::SceneState after = planning::load_scene(file, plugins);
  EXPECT_EQ(after.scene->start, stood);
  EXPECT_EQ(after.scene->robots.front().configuration, *scene.goal);

  scene.goal.reset();
  gui::save_scene({std::make_shared<const geometric::Scene>(scene), loaded.basis}, stood, {}, file);
  EXPECT_FALSE(planning::load_scene(file, plugins).scene->start) << "no task";
}

TEST(SaveScene, PutsTheBasisOfAnImportedProblemBesideIt) {
  const SmallCell cell;
  const planning::PluginManager plugins;
  planning::SceneState loaded = planning::load_scene(cell.post(), plugins);
  geometric::Scene imported = *loaded.scene;
  imported.hand_basis.clear();
  auto longer = std::make_shared<sampling::PmdBasis>(*loaded.basis);
  longer->directions.front().vector *= 1.5;
  loaded = {std::make_shared<const geometric::Scene>(imported), longer};

  const std::filesystem::path file = cell.folder() / "saved.yaml";
  gui::save_scene(loaded, imported.robots.front().configuration, {}, file);
  const planning::SceneState after = planning::load_scene(file, plugins);
  ASSERT_TRUE(after.basis);
  const Eigen::VectorXd corner = Eigen::VectorXd::Ones(1);
  EXPECT_TRUE(sampling::map_to_posture(*after.basis, corner)
                  .isApprox(sampling::map_to_posture(*longer, corner)));
}

TEST(SaveScene, FindsTheFilesOfOpenedRobotsFromAnyFolder) {
  const ScratchFolder folder;
  const std::filesystem::path robot = folder.path() / "robots" / "arm" / "arm.urdf";
  std::filesystem::create_directories(robot.parent_path());
  std::ofstream(robot) << R"(<robot name="arm"><link name="base"/><link name="tip"/>
    <joint name="turn" type="revolute"><parent link="base"/><child link="tip"/>
      <limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>)";
  const planning::PluginManager plugins;
  const planning::SceneState opened = planning::load_scene(robot, plugins);
  for (const char* place : {"robots/arm", "robots", "elsewhere/deep/down"}) {
    const std::filesystem::path file = folder.path() / place / "saved.yaml";
    std::filesystem::create_directories(file.parent_path());
    gui::save_scene(opened, opened.scene->robots.front().configuration, {}, file);
    const planning::SceneState saved = planning::load_scene(file, plugins);
    EXPECT_EQ(saved.scene->robots.front().model->description().file, robot) << place;
  }
}

}  // namespace
}  // namespace handway::test
