#include "handway/planning/extensions/load_scene.h"

#include "handway/geometric/io/input_error.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/extensions/plugin.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace handway::planning {
namespace {

using testing::HasSubstr;

constexpr const char* kRobot = R"(<robot name="lever">
  <link name="base"/><link name="arm"/>
  <joint name="swing" type="revolute">
    <parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="3" effort="1" velocity="1"/>
  </joint>
</robot>
)";

constexpr const char* kBasis = R"(hand: lever
source: made up
units: normalised
joints: [swing]
mean: [0.5]
free_joints:
  - {joint: swing, half_side: 0.5, centre: 0.5}
)";

class LoadScene : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    auto file = scratch_.path() / name;
    std::ofstream(file) << text;
    return file;
  }
  std::string complaint(const std::filesystem::path& file) const {
    try {
      static_cast<void>(load_scene(file, plugins_));
    } catch (const geometric::InputError& error) {
      return error.what();
    }
    return "no complaint";
  }

  test::ScratchFolder scratch_;
  PluginManager plugins_;
};

TEST_F(LoadScene, ReadsHandwayScenesWithTheirBasis) {
  write("lever.urdf", kRobot);
  write("lever_basis.yaml", kBasis);
  const auto file = write("scene.yml",
                          "handway: 1\nrobots:\n  - model: lever.urdf\n"
                          "hand_basis: lever_basis.yaml\n");
  const SceneState loaded = load_scene(file, plugins_);
  EXPECT_EQ(loaded.scene->robots.front().model->name(), "lever");
  ASSERT_TRUE(loaded.basis);
  EXPECT_EQ(loaded.basis->joints.front(), "swing");
}

TEST_F(LoadScene, NamesABasisThatIsMissing) {
  write("lever.urdf", kRobot);
  const auto file =
      write("scene.yaml", "handway: 1\nrobots:\n  - model: lever.urdf\nhand_basis: nowhere.yaml\n");
  EXPECT_THAT(complaint(file), HasSubstr("nowhere.yaml"));
}

TEST_F(LoadScene, PutsARobotIntoASceneOfItsOwn) {
  const SceneState loaded = load_scene(write("lever.urdf", kRobot), plugins_);
  ASSERT_EQ(loaded.scene->robots.size(), 1U);
  EXPECT_EQ(loaded.scene->robots.front().name, "lever");
  EXPECT_EQ(loaded.scene->robots.front().configuration.size(), 1);
  EXPECT_TRUE(loaded.scene->objects.empty());
  EXPECT_FALSE(loaded.basis);
}

TEST_F(LoadScene, FindsARobotOfTheLibraryByItsName) {
  EXPECT_EQ(load_scene("tx90_sah", plugins_).scene->robots.front().file, "tx90_sah");
  EXPECT_THAT(complaint("tx90_hsa"), HasSubstr("Did you mean \"tx90_sah\"?"));
}

TEST_F(LoadScene, AsksTheImporters) {
  plugins_.load_plugins(std::filesystem::path(TEST_PLUGINS) / "greeting");
  EXPECT_EQ(load_scene(write("world.hello", ""), plugins_).scene->name, "hello world");
}

TEST_F(LoadScene, NamesTheFormatsThereAreAndThePluginsThatFailed) {
  plugins_.load_plugins(std::filesystem::path(TEST_PLUGINS) / "greeting");
  plugins_.load_plugins(std::filesystem::path(TEST_PLUGINS) / "old_interface");
  const std::string said = complaint(write("scene.doc", "?"));
  EXPECT_THAT(said, HasSubstr("Handway scene (.yaml), a robot (.urdf), greetings (.hello)"));
  EXPECT_THAT(said, HasSubstr("test_plugin_old_interface.so was not loaded: made for version " +
                              std::to_string(kPluginApiVersion - 1)));
}

TEST_F(LoadScene, SaysWhereSrdfFilesAreReadFrom) {
  EXPECT_THAT(complaint(write("robot.srdf", "<robot name=\"r\"/>")),
              HasSubstr("with the URDF of the same name beside it"));
}

TEST_F(LoadScene, NamesAFileThatIsMissing) {
  EXPECT_THAT(complaint(scratch_.path() / "absent.yaml"), HasSubstr("no such file"));
  EXPECT_THAT(complaint(scratch_.path()), HasSubstr("found a folder"));
}

TEST_F(LoadScene, MakesAProblemOfAReferenceFile) {
  HANDWAY_NEED_REFERENCE(reference);
  plugins_.load_plugins(HANDWAY_PLUGINS);
  const SceneState loaded =
      load_scene(reference / "auro/TX90_RHand_ICRA10_5PMD_TwoCanb_new.xml", plugins_);
  const PlanningProblem problem = make_problem(loaded.scene, loaded.basis);
  EXPECT_EQ(problem.joints.arm.size(), 6U);
  EXPECT_EQ(problem.joints.hand.size(), 13U);
}

}  // namespace
}  // namespace handway::planning
