#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway/geometric/collision/collision_checker.h"
#include "kautham_importer.h"
#include "modified_dh.h"
#include "small_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace handway::import_kautham {
namespace {

using geometric::Pose;
using geometric::RobotModel;
using test::SmallProblem;

TEST(KauthamImporter, KnowsItsFilesByNameAndContent) {
  const SmallProblem files;
  const KauthamImporter importer;
  EXPECT_TRUE(importer.can_read(files.problem()));
  EXPECT_TRUE(importer.can_read(files.robot()));
  EXPECT_FALSE(importer.can_read(files.cube()));
  EXPECT_FALSE(importer.can_read(files.folder() / "missing.xml"));
  test::write_text(files.folder() / "other.xml", "<robot name=\"a_urdf\"/>");
  EXPECT_FALSE(importer.can_read(files.folder() / "other.xml"));
}

TEST(KauthamImporter, ReadsAProblemWhole) {
  const SmallProblem files;
  const planning::LoadedScene loaded = KauthamImporter().read(files.problem());
  const geometric::Scene& scene = *loaded.scene;
  EXPECT_EQ(scene.name, "Small");
  EXPECT_EQ(scene.file, files.problem());
  ASSERT_EQ(scene.robots.size(), 1U);
  EXPECT_EQ(scene.robots.front().name, "Small");
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[0].name, "cube");
  EXPECT_EQ(scene.objects[1].name, "cube_2");
  EXPECT_EQ(scene.objects[1].X_PO.translation(), Eigen::Vector3d(0.0, 2.0, 0.5));
  EXPECT_FLOAT_EQ(scene.objects[0].color.green, 0.5F);
  EXPECT_EQ(scene.planner.name, "") << "the default";
  EXPECT_THAT(scene.warnings, testing::ElementsAre(testing::HasSubstr("Cloud Size = 10")));
  EXPECT_TRUE(loaded.basis);
}

TEST(KauthamImporter, PlacesTheRobotByItsHomeAndFirstJoint) {
  const SmallProblem files;
  const planning::LoadedScene loaded = KauthamImporter().read(files.problem());
  const Pose& X_WB = loaded.scene->robots.front().X_WB;
  EXPECT_LT((X_WB.translation() - Eigen::Vector3d(0.1, 0.0, 0.01)).norm(), 1e-12);
  EXPECT_LT((X_WB.linear().diagonal() - Eigen::Vector3d(-1.0, -1.0, 1.0)).norm(), 1e-12);
}

TEST(KauthamImporter, ReadsSlidingAndHeldJoints) {
  const SmallProblem files;
  const planning::LoadedScene loaded = KauthamImporter().read(files.robot());
  const RobotModel& model = *loaded.scene->robots.front().model;
  const geometric::Joint& lift = model.joint(model.find_link("Lift").value());
  EXPECT_EQ(lift.type, geometric::JointType::kPrismatic);
  EXPECT_DOUBLE_EQ(lift.limits.lower, 0.1);
  EXPECT_DOUBLE_EQ(lift.limits.upper, 0.3);
  const geometric::Joint& palm = model.joint(model.find_link("Palm").value());
  EXPECT_EQ(palm.type, geometric::JointType::kFixed);
  // Rx(90°) Tx(100 mm), then held at 20° about z.
  EXPECT_LT((palm.X_PJ.translation() - Eigen::Vector3d(0.1, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(palm.X_PJ.linear()(0, 0), std::cos(20.0 * M_PI / 180.0), 1e-12);
}

TEST(KauthamImporter, SplitsArmAndHandByTheTrunkControls) {
  const SmallProblem files;
  const auto names = [](const RobotModel& model, const char* group) {
    std::vector<std::string> result;
    const std::vector<int> variables = model.find_group(group).value();
    result.reserve(variables.size());
    for (const int v : variables) {
      result.push_back(model.variable(v).name);
    }
    return result;
  };
  for (const bool says_trunk : {true, false}) {
    const planning::LoadedScene loaded = KauthamImporter().read(files.robot());
    const RobotModel& model = *loaded.scene->robots.front().model;
    EXPECT_THAT(names(model, "arm"), testing::ElementsAre("Turn", "Lift")) << says_trunk;
    EXPECT_THAT(names(model, "hand"), testing::ElementsAre("Thumb", "Spread", "Med")) << says_trunk;
    if (says_trunk) {
      SmallProblem::edit(files.robot(), "nTrunk=\"2\"", "");
    }
  }
}

TEST(KauthamImporter, ReadsChainsWithoutParents) {
  const SmallProblem files;
  SmallProblem::edit(files.robot(), "robType=\"Tree\"", "robType=\"Chain\"");
  SmallProblem::edit(files.robot(), "<Parent name=\"Spread\"/>", "");
  const planning::LoadedScene loaded = KauthamImporter().read(files.robot());
  const RobotModel& model = *loaded.scene->robots.front().model;
  EXPECT_EQ(model.joint(model.find_link("Med").value()).parent, "Spread");
}

TEST(KauthamImporter, StartsFromControlsWithinTheLimits) {
  const SmallProblem files;
  SmallProblem::edit(files.problem(), "1 0.25 0 1 0.5", "1 0.25 0 1 0");
  const planning::LoadedScene loaded = KauthamImporter().read(files.problem());
  const RobotModel& model = *loaded.scene->robots.front().model;
  const geometric::Configuration& goal = loaded.scene->goal.value();
  EXPECT_DOUBLE_EQ(goal[model.find_variable("Turn").value()], M_PI / 2);
  EXPECT_DOUBLE_EQ(goal[model.find_variable("Lift").value()], 0.15);
  EXPECT_NEAR(goal[model.find_variable("Thumb").value()], -M_PI / 2, 1e-12);  // 0.4 - 0.4
  // 0.3 - 0.1 * 0.6 - 0.45 * 0.8 < 0: clamped.
  EXPECT_DOUBLE_EQ(goal[model.find_variable("Med").value()], 0.0);
}

TEST(KauthamImporter, LetsFurtherRobotsStandAtTheirControls) {
  const SmallProblem files;
  SmallProblem::edit(files.problem(), "<Scene", R"(<Robot robot="robots/small.rob">
    <Home TH="0" WX="0" WY="0" WZ="1" X="0" Y="-3000" Z="0"/>
  </Robot>
  <Scene)");
  SmallProblem::edit(files.problem(), "<Init dim=\"5\">0.5 0.5 0.5 0.5 0.5",
                     "<Init dim=\"10\">0.5 0.5 0.5 0.5 0.5 1 0.5 0.5 0.5 0.5");
  SmallProblem::edit(files.problem(), "<Goal dim=\"5\">1 0.25 0 1 0.5",
                     "<Goal dim=\"10\">1 0.25 0 1 0.5 0 0.5 0.5 0.5 0.5");
  const geometric::Scene scene = *KauthamImporter().read(files.problem()).scene;
  ASSERT_EQ(scene.robots.size(), 2U);
  EXPECT_EQ(scene.robots[1].name, "Small_2");
  EXPECT_DOUBLE_EQ(scene.robots[1].configuration[0], M_PI / 2);
  EXPECT_THAT(scene.warnings, testing::Contains(testing::HasSubstr("Small_2 stays at its")));
}

TEST(KauthamImporter, GivesARobotFileASceneOfItsOwn) {
  const SmallProblem files;
  const planning::LoadedScene loaded = KauthamImporter().read(files.robot());
  EXPECT_EQ(loaded.scene->name, "small");
  EXPECT_FALSE(loaded.scene->start || loaded.scene->goal);
  EXPECT_EQ(loaded.scene->robots.front().configuration.size(), 5);
  EXPECT_THAT(loaded.scene->warnings, testing::IsEmpty());
}

}  // namespace
}  // namespace handway::import_kautham
