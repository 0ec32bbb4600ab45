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
  const planning::SceneState loaded = KauthamImporter().read(files.problem());
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
  const planning::SceneState loaded = KauthamImporter().read(files.problem());
  const Pose& X_WB = loaded.scene->robots.front().X_WB;
  EXPECT_LT((X_WB.translation() - Eigen::Vector3d(0.1, 0.0, 0.01)).norm(), 1e-12);
  EXPECT_LT((X_WB.linear().diagonal() - Eigen::Vector3d(-1.0, -1.0, 1.0)).norm(), 1e-12);
}

TEST(KauthamImporter, ReadsSlidingAndHeldJoints) {
  const SmallProblem files;
  const planning::SceneState loaded = KauthamImporter().read(files.robot());
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
    const planning::SceneState loaded = KauthamImporter().read(files.robot());
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
  const planning::SceneState loaded = KauthamImporter().read(files.robot());
  const RobotModel& model = *loaded.scene->robots.front().model;
  EXPECT_EQ(model.joint(model.find_link("Med").value()).parent, "Spread");
}

TEST(KauthamImporter, StartsFromControlsWithinTheLimits) {
  const SmallProblem files;
  SmallProblem::edit(files.problem(), "1 0.25 0 1 0.5", "1 0.25 0 1 0");
  const planning::SceneState loaded = KauthamImporter().read(files.problem());
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
  const planning::SceneState loaded = KauthamImporter().read(files.robot());
  EXPECT_EQ(loaded.scene->name, "small");
  EXPECT_FALSE(loaded.scene->start || loaded.scene->goal);
  EXPECT_EQ(loaded.scene->robots.front().configuration.size(), 5);
  EXPECT_THAT(loaded.scene->warnings, testing::IsEmpty());
}

constexpr const char* kFreeBody = R"(<Robot name="ele" robType="Freeflying">
  <WeightSE3 rho_t="1.0" rho_r="1.0"/>
  <Joint name="Body" ivFile="cube.iv">
    <PreTrans X="0" Y="0" Z="5" WX="0" WY="0" WZ="1" TH="0"/><Description movable="true"/>
  </Joint>
  <ControlSet>
    <Offset><DOF name="X" value="0.5"/><DOF name="Y" value="0.5"/><DOF name="Z" value="0.5"/>
      <DOF name="X1" value="0.5"/><DOF name="X2" value="0.5"/><DOF name="X3" value="0.5"/></Offset>
    <Control name="x" eigValue="1"><DOF name="X" value="1"/></Control>
    <Control name="y" eigValue="1"><DOF name="Y" value="1"/></Control>
    <Control name="z" eigValue="1"><DOF name="Z" value="1"/></Control>
    <Control name="x1" eigValue="1"><DOF name="X1" value="1"/></Control>
    <Control name="x2" eigValue="1"><DOF name="X2" value="1"/></Control>
    <Control name="x3" eigValue="1"><DOF name="X3" value="1"/></Control>
  </ControlSet>
</Robot>
)";

constexpr const char* kFreeProblem = R"(<Problem name="Free">
  <Robot robot="robots/ele.rob" scale="1.0">
    <Limits name="X" min="-500" max="500"/><Limits name="Y" min="-200" max="300"/>
    <Limits name="Z" min="0" max="400"/>
    <Home TH="0" WX="0" WY="0" WZ="1" X="100" Y="0" Z="0"/>
  </Robot>
  <Planner><Queries><Query>
    <Init dim="6">0.1 0.5 0.25 0.2 0.3 0.6</Init><Goal dim="6">1 0.5 0.5 0 0 0.5</Goal>
  </Query></Queries></Planner>
</Problem>
)";

// Returns the pose of the body in the world.
Pose body_pose(const geometric::Scene& scene, const geometric::Configuration& q) {
  const RobotModel& model = *scene.robots.front().model;
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(q, X_BL);
  return scene.robots.front().X_WB * X_BL[static_cast<std::size_t>(*model.find_link("Body"))];
}

TEST(KauthamImporter, LetsABodyFlyByTheControlsOfItsBase) {
  const SmallProblem files;
  test::write_text(files.folder() / "robots" / "ele.rob", kFreeBody);
  test::write_text(files.problem(), kFreeProblem);
  const planning::SceneState loaded = KauthamImporter().read(files.problem());
  const geometric::Scene& scene = *loaded.scene;
  const RobotModel& model = *scene.robots.front().model;
  ASSERT_EQ(model.variable_count(), 6);
  EXPECT_NEAR(model.lower()[0], -0.6, 1e-12) << "in the frame of the Home";
  EXPECT_NEAR(model.upper()[0], 0.4, 1e-12);
  EXPECT_TRUE(model.find_group("arm"));
  // Shoemake's rotation of X1 = 0.2, X2 = 0.3, X3 = 0.6, and 5 mm along its z.
  const double a = 2.0 * M_PI * 0.3;
  const double b = M_PI * 0.6;
  const Eigen::Quaterniond q(std::cos(b) * std::sqrt(0.8), std::sin(a) * std::sqrt(0.2),
                             std::cos(a) * std::sqrt(0.2), std::sin(b) * std::sqrt(0.8));
  const Pose start = body_pose(scene, *scene.start);
  EXPECT_TRUE(start.linear().isApprox(q.toRotationMatrix(), 1e-9));
  EXPECT_TRUE(start.translation().isApprox(
      Eigen::Vector3d(-0.4, 0.05, 0.1) + q * Eigen::Vector3d(0.0, 0.0, 0.005), 1e-9));
  const Pose goal = body_pose(scene, *scene.goal);
  EXPECT_TRUE(goal.translation().isApprox(Eigen::Vector3d(0.5, 0.05, 0.205), 1e-9));
  EXPECT_TRUE(goal.linear().isApprox(
      Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()).toRotationMatrix(), 1e-9));
}

TEST(KauthamImporter, SlidesABaseThatControlsMoveInAPlane) {
  const SmallProblem files;
  SmallProblem::edit(files.robot(), "<Offset>",
                     "<Offset><DOF name=\"X\" value=\"0.5\"/><DOF name=\"Y\" value=\"0.25\"/>");
  SmallProblem::edit(files.robot(), "<Control name=\"Turn\"",
                     "<Control name=\"x\" eigValue=\"1\"><DOF name=\"X\" value=\"1\"/></Control>\n"
                     "<Control name=\"Turn\"");
  SmallProblem::edit(files.robot(), "nTrunk=\"2\"", "nTrunk=\"3\"");
  SmallProblem::edit(files.problem(), "<Home",
                     "<Limits name=\"X\" min=\"0\" max=\"1000\"/>"
                     "<Limits name=\"Y\" min=\"0\" max=\"400\"/><Home");
  SmallProblem::edit(files.problem(), "<Init dim=\"5\">", "<Init dim=\"6\">0.25 ");
  SmallProblem::edit(files.problem(), "<Goal dim=\"5\">", "<Goal dim=\"6\">0.75 ");
  const planning::SceneState loaded = KauthamImporter().read(files.problem());
  const RobotModel& model = *loaded.scene->robots.front().model;
  ASSERT_EQ(model.variable_count(), 6);
  EXPECT_EQ(model.variable(0).name, "X");
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(*loaded.scene->start, X_BL);
  const Pose base =
      loaded.scene->robots.front().X_WB * X_BL[static_cast<std::size_t>(*model.find_link("Base"))];
  // The Home turns by 180°: of the corners, the first is at its end.
  EXPECT_TRUE(base.translation().isApprox(Eigen::Vector3d(0.25, 0.1, 0.01), 1e-9))
      << base.translation().transpose();
}

TEST(KauthamImporter, TakesTheControlsOfLaterVersions) {
  const SmallProblem files;
  SmallProblem::edit(files.robot(), "<ControlSet size=\"5\" nTrunk=\"2\">", "<Other>");
  SmallProblem::edit(files.robot(), "</ControlSet>", "</Other>");
  test::write_text(files.folder() / "robots" / "small.cntr", R"(<ControlSet>
  <Offset><DOF name="Small/Thumb" value="0.4"/></Offset>
  <Control name="Turn" eigValue="1"><DOF name="Small/Turn" value="1"/></Control>
  <Control name="Close"><DOF name="Small/Spread" value="0.6"/><DOF name="Small/Med" value="0.8"/>
    <DOF name="Small/Dist" value="0.8"/></Control>
</ControlSet>)");
  SmallProblem::edit(files.problem(), "<Planner>", R"(<Obstacle obstacle="robots/cube.iv" scale="5">
    <Home TH="90" WX="0" WY="0" WZ="1" X="0" Y="0" Z="-500"/></Obstacle>
  <Controls robot="robots/small.cntr"/><Planner>)");
  SmallProblem::edit(files.problem(), "<Init dim=\"5\">0.5 0.5 0.5 0.5 0.5", "<Init>0.5 0.5");
  SmallProblem::edit(files.problem(), "<Goal dim=\"5\">1 0.25 0 1 0.5", "<Goal>1 1");
  const planning::SceneState loaded = KauthamImporter().read(files.problem());
  const RobotModel& model = *loaded.scene->robots.front().model;
  EXPECT_EQ(loaded.scene->objects.size(), 3U);
  EXPECT_EQ(loaded.scene->objects.back().X_PO.translation().z(), -0.5);
  const geometric::Configuration& goal = loaded.scene->goal.value();
  EXPECT_DOUBLE_EQ(goal[model.find_variable("Turn").value()], M_PI / 2);
  EXPECT_NEAR(goal[model.find_variable("Thumb").value()], -M_PI / 2 * 0.6, 1e-12);
  EXPECT_NEAR(goal[model.find_variable("Med").value()], 0.9 * 75.0 * M_PI / 180.0, 1e-12);
  EXPECT_NEAR(goal[model.find_variable("Lift").value()], 0.2, 1e-12) << "0.5 where none is given";
  EXPECT_TRUE(loaded.basis);
}

TEST(KauthamImporter, ReadsProblemsWithoutAQuery) {
  const SmallProblem files;
  SmallProblem::edit(files.problem(), "<Init dim=\"5\">0.5 0.5 0.5 0.5 0.5</Init>", "");
  const planning::SceneState half = KauthamImporter().read(files.problem());
  EXPECT_TRUE(half.scene->goal && !half.scene->start);
  EXPECT_THAT(half.scene->warnings, testing::Contains(testing::HasSubstr("has no start")));
  SmallProblem::edit(files.problem(), "<Goal dim=\"5\">1 0.25 0 1 0.5</Goal>", "");
  const planning::SceneState none = KauthamImporter().read(files.problem());
  EXPECT_FALSE(none.scene->goal || none.scene->start);
}

}  // namespace
}  // namespace handway::import_kautham
