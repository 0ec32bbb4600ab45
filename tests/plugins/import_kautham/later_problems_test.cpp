/// Problems of later versions, as their demonstrations lay them out: problems in
/// demos/KIND/NAME/, models in models/, two folders above.
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"
#include "kautham_importer.h"
#include "small_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace handway::import_kautham {
namespace {

namespace fs = std::filesystem;
using geometric::RobotModel;
using testing::Contains;
using testing::HasSubstr;

constexpr const char* kBlock = R"(#Inventor V2.1 ascii
Separator { Cube { width 0.2 height 0.2 depth 0.4 } }
)";

constexpr const char* kVrmlBlock = R"(#VRML V2.0 utf8
Shape { geometry Box { size 0.2 0.2 0.4 } }
)";

constexpr const char* kArm = R"(<robot name="arm">
  <link name="foot"><collision><origin xyz="0 0 0.2"/><origin xyz="9 9 9"/>
    <geometry><mesh filename="arm/block.iv"/></geometry></collision></link>
  <link name="rod"><collision><origin xyz="0 0 0.2"/>
    <geometry><mesh filename="arm/block.wrl" scale="0.5 0.5 1"/></geometry></collision></link>
  <link name="slider"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="lift" type="revolute"><parent link="foot"/><child link="rod"/>
    <origin xyz="0 0 0.5"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="reach" type="prismatic"><parent link="rod"/><child link="slider"/>
    <origin xyz="0 0 0.6"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="0.4" effort="1" velocity="1"/></joint>
</robot>
)";

constexpr const char* kWall = R"(<robot name="wall"><link name="base"><collision>
  <geometry><box size="1 1 0.1"/></geometry></collision></link></robot>
)";

constexpr const char* kProblem = R"(<?xml version="1.0"?>
<Problem name="Demo">
  <Robot robot="robots/arm.urdf" scale="1.0">
    <Home TH="1" WX="0" WY="0" WZ="0" X="0.5" Y="0" Z="0"/>
  </Robot>
  <Obstacle obstacle="obstacles/wall.urdf" scale="2.0">
    <Home TH="0" WX="0" WY="0" WZ="1" X="3" Y="0" Z="0"/>
  </Obstacle>
  <Controls robot="controls/arm.cntr"/>
  <Planner><Parameters><Name>omplRRT</Name></Parameters>
    <Queries><Query><Init dim="2">0.5 0.0</Init><Goal dim="2">1.0 0.5</Goal></Query></Queries>
  </Planner>
</Problem>
)";

constexpr const char* kControls = R"(<ControlSet>
  <Control name="lift" eigValue="1"><DOF name="arm/rod" value="1"/></Control>
  <Control name="reach" eigValue="1"><DOF name="arm/slider" value="1"/></Control>
  <Offset><DOF name="arm/rod" value="0.5"/><DOF name="arm/slider" value="0.5"/></Offset>
</ControlSet>
)";

class LaterProblem : public testing::Test {
 protected:
  LaterProblem() {
    for (const fs::path& folder :
         {demo() / "controls", models() / "robots" / "arm", models() / "obstacles"}) {
      fs::create_directories(folder);
    }
    test::write_text(problem(), kProblem);
    test::write_text(demo() / "controls" / "arm.cntr", kControls);
    test::write_text(models() / "robots" / "arm.urdf", kArm);
    test::write_text(models() / "robots" / "arm" / "block.iv", kBlock);
    test::write_text(models() / "robots" / "arm" / "block.wrl", kVrmlBlock);
    test::write_text(models() / "obstacles" / "wall.urdf", kWall);
  }

  [[nodiscard]] fs::path demo() const { return folder_.path() / "demos" / "plane"; }
  [[nodiscard]] fs::path problem() const { return demo() / "demo.xml"; }
  [[nodiscard]] fs::path models() const { return folder_.path() / "models"; }
  [[nodiscard]] std::shared_ptr<const geometric::Scene> read() const {
    return KauthamImporter().read(problem()).scene;
  }

  test::ScratchFolder folder_;
};

TEST_F(LaterProblem, FindsItsModelsTwoFoldersAbove) {
  const auto scene = read();
  const RobotModel& model = *scene->robots.front().model;
  EXPECT_EQ(model.variable_count(), 2);
  ASSERT_TRUE(scene->start && scene->goal);
  EXPECT_NEAR((*scene->goal)[0], 1.0, 1e-12);
  EXPECT_NEAR((*scene->goal)[1], 0.2, 1e-12);
  ASSERT_EQ(scene->objects.size(), 1U);
  EXPECT_TRUE(
      std::get<geometric::Box>(scene->objects[0].shape).size.isApprox(Eigen::Vector3d(2, 2, 0.2)));
}

TEST_F(LaterProblem, HasMeshesOfInventorAndVrmlInItsUrdf) {
  const auto scene = read();
  const RobotModel& model = *scene->robots.front().model;
  for (int link = 0; link < 2; ++link) {
    const geometric::TriangleMesh mesh = geometric::collision_mesh(model.link(link));
    ASSERT_FALSE(mesh.empty());
    double top = 0.0;
    for (const Eigen::Vector3d& vertex : mesh.vertices) {
      top = std::max(top, vertex.cwiseAbs().maxCoeff());
    }
    EXPECT_NEAR(top, 0.4, 1e-6) << "0.2 m above the middle, which is at 0.2 m, for link " << link;
  }
}

TEST_F(LaterProblem, TakesAnAngleWithoutAxisForNoTurn) {
  const auto scene = read();
  const geometric::Pose& X_WB = scene->robots.front().X_WB;
  EXPECT_TRUE(X_WB.linear().isIdentity(1e-12));
  EXPECT_DOUBLE_EQ(X_WB.translation().x(), 0.5);
  EXPECT_THAT(scene->warnings, Contains(HasSubstr("demo.xml:4: <Home>")));
}

TEST_F(LaterProblem, WarnsOfASecondOrigin) {
  EXPECT_THAT(read()->warnings,
              Contains(testing::AllOf(HasSubstr("second <origin>"), HasSubstr("link foot"))));
}

TEST_F(LaterProblem, ScalesItsUrdfRobot) {
  test::SmallProblem::edit(problem(), "scale=\"1.0\"", "scale=\"3.0\"");
  const auto scene = read();
  const RobotModel& model = *scene->robots.front().model;
  EXPECT_NEAR(model.joint(1).X_PJ.translation().z(), 1.5, 1e-12);
  EXPECT_NEAR(model.upper()[1], 1.2, 1e-12) << "a slide";
  EXPECT_NEAR(model.upper()[0], 1.0, 1e-12) << "a turn";
  EXPECT_NEAR((*scene->goal)[1], 0.6, 1e-12);
  EXPECT_NEAR(std::get<geometric::Sphere>(model.link(2).collision[0].shape).radius, 0.3, 1e-12);
}

TEST_F(LaterProblem, NamesAModelThatIsNowhere) {
  fs::remove(models() / "robots" / "arm.urdf");
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read()); }), HasSubstr("arm.urdf"));
}

}  // namespace
}  // namespace handway::import_kautham
