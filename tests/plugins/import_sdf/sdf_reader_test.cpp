/// Tests reading of robots as SDF.
#include "sdf_reader.h"

#include "handway/geometric/robot/robot_model.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <numbers>

namespace handway::import_sdf {
namespace {

using geometric::Pose;
using geometric::RobotModel;
using testing::Contains;
using testing::HasSubstr;

constexpr const char* kArm = R"(<?xml version="1.0"?>
<sdf version="1.9">
  <model name="crane">
    <link name="base">
      <collision name="foot"><geometry><box><size>0.2 0.2 0.1</size></box></geometry></collision>
    </link>
    <link name="boom">
      <pose>0 0 0.4 0 0 0</pose>
      <collision name="rod">
        <pose>0.2 0 0 0 1.5707963267948966 0</pose>
        <geometry><capsule><radius>0.03</radius><length>0.4</length></capsule></geometry>
      </collision>
      <visual name="paint">
        <geometry><mesh><uri>model://paints/rod.obj</uri></mesh></geometry>
        <material><diffuse>0.2 0.4 0.6 1</diffuse></material>
      </visual>
    </link>
    <link name="trolley"><pose relative_to="boom">0.3 0 0 0 0 0</pose>
      <collision name="body">
        <geometry><ellipsoid><radii>0.05 0.04 0.03</radii></ellipsoid></geometry>
      </collision>
      <collision name="ground"><geometry><plane><normal>0 0 1</normal></plane></geometry></collision>
    </link>
    <link name="wheel"><pose relative_to="trolley">0 0.1 0 0 0 0</pose></link>
    <joint name="to_world" type="fixed"><parent>world</parent><child>base</child></joint>
    <joint name="lift" type="revolute">
      <pose>-0.1 0 0 0 0 0</pose>
      <parent>base</parent><child>boom</child>
      <axis><xyz>0 1 0</xyz><limit><lower>-1.5</lower><upper>0.4</upper>
        <velocity>2</velocity></limit></axis>
    </joint>
    <joint name="reach" type="prismatic">
      <parent>boom</parent><child>trolley</child>
      <axis><xyz expressed_in="__model__">1 0 0</xyz><limit><lower>0</lower><upper>0.2</upper></limit></axis>
    </joint>
    <joint name="roll" type="continuous">
      <parent>trolley</parent><child>wheel</child><axis><xyz>0 1 0</xyz></axis>
    </joint>
  </model>
</sdf>
)";

class SdfRobot {
 public:
  explicit SdfRobot(const std::string& from = "", const std::string& to = "") {
    std::string text = kArm;
    if (!from.empty()) {
      text.replace(text.find(from), from.size(), to);
    }
    std::ofstream(file()) << text;
    std::filesystem::create_directories(folder_.path() / "paints");
    std::ofstream(folder_.path() / "paints" / "rod.obj")
        << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  }

  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "crane.sdf"; }
  [[nodiscard]] std::filesystem::path folder() const { return folder_.path(); }
  [[nodiscard]] RobotModel model() const { return RobotModel(read_sdf(file())); }

 private:
  test::ScratchFolder folder_;
};

Pose link_pose(const RobotModel& model, const geometric::Configuration& q, const char* link) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(q, X_BL);
  return X_BL[static_cast<std::size_t>(model.find_link(link).value())];
}

TEST(SdfReader, HasJointsWithTheirFrames) {
  const RobotModel model = SdfRobot().model();
  EXPECT_EQ(model.name(), "crane");
  ASSERT_EQ(model.variable_count(), 3);
  EXPECT_EQ(model.link(0).name, "base");
  geometric::Configuration q = Eigen::Vector3d::Zero();
  EXPECT_TRUE(
      link_pose(model, q, "trolley").translation().isApprox(Eigen::Vector3d(0.3, 0.0, 0.4), 1e-12));
  q[model.find_variable("lift").value()] = -std::numbers::pi / 2.0;
  q[model.find_variable("reach").value()] = 0.1;
  // The joint turns about a point 10 cm behind the boom: up.
  EXPECT_TRUE(
      link_pose(model, q, "boom").translation().isApprox(Eigen::Vector3d(-0.1, 0.0, 0.5), 1e-12));
  EXPECT_TRUE(link_pose(model, q, "trolley")
                  .translation()
                  .isApprox(Eigen::Vector3d(-0.1, 0.0, 0.9), 1e-12));
  const geometric::Joint& lift = model.variable(model.find_variable("lift").value());
  EXPECT_EQ(lift.limits.upper, 0.4);
  EXPECT_EQ(lift.limits.velocity, 2.0);
  EXPECT_TRUE(model.is_continuous(model.find_variable("roll").value()));
}

TEST(SdfReader, HasShapesMeshesAndColours) {
  const RobotModel model = SdfRobot().model();
  const geometric::Link& boom = model.link(model.find_link("boom").value());
  ASSERT_EQ(boom.collision.size(), 3U) << "a capsule: a cylinder and two balls";
  EXPECT_TRUE(boom.collision[2].X_LG.translation().isApprox(Eigen::Vector3d(0.4, 0, 0), 1e-9));
  ASSERT_EQ(boom.visual.size(), 1U);
  EXPECT_EQ(std::get<geometric::Mesh>(boom.visual.front().shape).file.filename(), "rod.obj");
  EXPECT_FLOAT_EQ(boom.visual.front().color.blue, 0.6F);
  const geometric::Link& trolley = model.link(model.find_link("trolley").value());
  ASSERT_EQ(trolley.collision.size(), 1U);
  EXPECT_THAT(model.description().warnings, Contains(HasSubstr("trolley/ground")));
}

TEST(SdfReader, DoesWithoutMissingMeshesThatAreOnlySeen) {
  const SdfRobot robot("model://paints/rod.obj", "model://pints/rod.obj");
  const RobotModel model = robot.model();
  EXPECT_THAT(model.description().warnings, Contains(HasSubstr("pints")));
  const SdfRobot solid("<capsule><radius>0.03</radius><length>0.4</length></capsule>",
                       "<mesh><uri>model://pints/rod.obj</uri></mesh>");
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read_sdf(solid.file())); }),
              testing::AllOf(HasSubstr("boom/rod"), HasSubstr("--package-path")));
}

TEST(SdfReader, FindsModelsOfThePackagePath) {
  const SdfRobot robot;
  const test::ScratchFolder elsewhere;
  std::filesystem::rename(robot.folder() / "paints", elsewhere.path() / "paints");
  ::setenv("HANDWAY_PACKAGE_PATH", elsewhere.path().c_str(), 1);
  const RobotModel model = robot.model();
  ::unsetenv("HANDWAY_PACKAGE_PATH");
  EXPECT_TRUE(std::holds_alternative<geometric::Mesh>(
      model.link(model.find_link("boom").value()).visual.front().shape));
}

TEST(SdfReader, SplitsJointsWithSeveralAxes) {
  const RobotModel model =
      SdfRobot(
          "type=\"continuous\">\n      <parent>trolley</parent><child>wheel</child><axis>"
          "<xyz>0 1 0</xyz></axis>",
          "type=\"universal\"><parent>trolley</parent><child>wheel</child>"
          "<axis><xyz>1 0 0</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis>"
          "<axis2><xyz>0 1 0</xyz><limit><lower>-2</lower><upper>2</upper></limit></axis2>")
          .model();
  ASSERT_EQ(model.variable_count(), 4);
  EXPECT_EQ(model.upper()[model.find_variable("roll/1").value()], 1.0);
  EXPECT_EQ(model.upper()[model.find_variable("roll").value()], 2.0);
}

// Grippers of SDF 1.11 are like this.
TEST(SdfReader, CouplesJointsThatMimicOthers) {
  const auto following = [](const std::string& how) {
    return SdfRobot("<axis><xyz>0 1 0</xyz></axis>",
                    "<axis><xyz>0 1 0</xyz><mimic joint=\"lift\">" + how + "</mimic></axis>");
  };
  const RobotModel model =
      following("<multiplier>-2</multiplier><offset>0.1</offset><reference>0.3</reference>")
          .model();
  EXPECT_EQ(model.variable_count(), 2);
  const RobotModel::MimicMapping& wheel = model.mimic_mapping(model.find_link("wheel").value());
  EXPECT_EQ(wheel.variable, model.find_variable("lift"));
  EXPECT_EQ(wheel.multiplier, -2.0);
  EXPECT_DOUBLE_EQ(wheel.offset, 0.7);
  const SdfRobot wrong = following("<multiplier>two</multiplier>");
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read_sdf(wrong.file())); }),
              HasSubstr("multiplier \"two\""));
}

// Most worlds are like this: sun and ground come with Gazebo, the robot has a folder of its own.
TEST(SdfReader, DoesWithoutIncludesThatAreNotThere) {
  const SdfRobot robot;
  std::filesystem::create_directories(robot.folder() / "crane");
  std::filesystem::copy(robot.file(), robot.folder() / "crane" / "model.sdf");
  std::ofstream(robot.folder() / "crane" / "model.config")
      << "<model><name>crane</name><sdf version='1.9'>model.sdf</sdf></model>";
  const auto world = [&](const std::string& crane) {
    const std::filesystem::path file = robot.folder() / "yard.world";
    std::ofstream(file) << "<sdf version='1.6'><world name='yard'><include><uri>model://sun</uri>"
                           "</include><include><uri>model://ground_plane</uri></include>" +
                               crane + "</world></sdf>";
    return file;
  };
  const RobotModel model(read_sdf(world("<include><uri>model://crane</uri></include>")));
  EXPECT_EQ(model.name(), "crane");
  EXPECT_EQ(model.variable_count(), 3);
  EXPECT_THAT(model.description().warnings,
              Contains(testing::AllOf(HasSubstr("left out"), HasSubstr("model://sun"))));
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read_sdf(world(""))); }),
              testing::AllOf(HasSubstr("yard.world"), HasSubstr("no model besides includes"),
                             HasSubstr("--package-path")));
}

TEST(SdfReader, RefusesInWords) {
  const auto refused = [](const char* from, const char* to) {
    const SdfRobot robot(from, to);
    return test::refusal_of([&] { static_cast<void>(read_sdf(robot.file())); });
  };
  EXPECT_THAT(refused("<child>trolley</child>", "<child>troley</child>"), HasSubstr("troley"));
  EXPECT_THAT(refused("<sdf version=\"1.9\">", "<sdf>"), HasSubstr("crane.sdf"));
  EXPECT_THAT(refused("type=\"continuous\"", "type=\"screw\""), HasSubstr("joint roll"));
}

}  // namespace
}  // namespace handway::import_sdf
