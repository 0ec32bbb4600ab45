/// Tests reading of robots as MJCF.
#include "mjcf_reader.h"

#include "handway/geometric/robot/robot_model.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace handway::import_mjcf {
namespace {

using geometric::Pose;
using geometric::RobotDescription;
using geometric::RobotModel;
using testing::Contains;
using testing::HasSubstr;

constexpr const char* kFinger = R"(<mujoco model="finger">
  <compiler angle="degree"/>
  <default><geom rgba="1 0 0 1"/></default>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 0.1"/>
    <body name="base" pos="0 0 0.5">
      <geom type="box" size="0.05 0.05 0.02"/>
      <body name="proximal" pos="0 0 0.02">
        <joint name="spread" type="hinge" axis="0 1 0" range="-20 20"/>
        <joint name="bend" type="hinge" axis="1 0 0" pos="0 0 0.01" range="0 90"/>
        <geom type="capsule" fromto="0 0 0.01 0 0 0.06" size="0.008"/>
        <body name="distal" pos="0 0 0.07">
          <joint name="tip" type="hinge" axis="1 0 0" range="0 90"/>
          <geom type="ellipsoid" size="0.008 0.01 0.02" pos="0 0 0.02"/>
          <geom type="sphere" size="0.02" contype="0" conaffinity="0"/>
        </body>
      </body>
      <body name="pin" pos="0.1 0 0">
        <joint name="push" type="slide" axis="0 0 2" range="0 0.1"/>
        <geom type="cylinder" size="0.01 0.03"/>
      </body>
      <body name="wheel" pos="-0.1 0 0">
        <joint name="spin" type="hinge" axis="0 0 1"/>
        <geom type="sphere" size="0.02"/>
      </body>
    </body>
  </worldbody>
  <contact><exclude body1="proximal" body2="pin"/></contact>
  <tendon>
    <fixed name="sum"><joint joint="spread" coef="0.5"/><joint joint="bend" coef="1"/>
      <joint joint="tip" coef="-1"/></fixed>
  </tendon>
  <equality>EQUALITY</equality>
  <keyframe><key name="bent" qpos="0.1 0.2 0.3 0.05 1"/></keyframe>
</mujoco>
)";

class MjcfRobot {
 public:
  explicit MjcfRobot(const std::string& equality = "") {
    std::string text = kFinger;
    text.replace(text.find("EQUALITY"), 8, equality);
    std::ofstream(file()) << text;
  }

  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "finger.xml"; }
  [[nodiscard]] RobotModel model() const { return RobotModel(read_mjcf(file())); }

 private:
  test::ScratchFolder folder_;
};

Pose link_pose(const RobotModel& model, const geometric::Configuration& q, const char* link) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(q, X_BL);
  return X_BL[static_cast<std::size_t>(model.find_link(link).value())];
}

TEST(MjcfReader, KnowsItsFiles) {
  const MjcfRobot robot;
  EXPECT_TRUE(is_mjcf_file(robot.file()));
  EXPECT_FALSE(is_mjcf_file(test::source_dir() / "scenes" / "can_on_table.yaml"));
}

TEST(MjcfReader, HasJointsAndTheirLimits) {
  const RobotModel model = MjcfRobot().model();
  EXPECT_EQ(model.name(), "finger");
  ASSERT_EQ(model.variable_count(), 5);
  const int bend = model.find_variable("bend").value();
  EXPECT_NEAR(model.upper()[bend], std::numbers::pi / 2.0, 1e-12);
  EXPECT_TRUE(model.is_continuous(model.find_variable("spin").value()));
  EXPECT_EQ(model.variable(model.find_variable("push").value()).type,
            geometric::JointType::kPrismatic);
}

TEST(MjcfReader, MovesAsMujocoDoes) {
  const RobotModel model = MjcfRobot().model();
  geometric::Configuration q = geometric::Configuration::Zero(5);
  EXPECT_TRUE(
      link_pose(model, q, "distal").translation().isApprox(Eigen::Vector3d(0.0, 0.0, 0.59), 1e-12));
  q[model.find_variable("bend").value()] = std::numbers::pi / 2.0;
  // The joint turns about a point 1 cm up the link: 6 cm from there, to the side.
  EXPECT_TRUE(link_pose(model, q, "distal")
                  .translation()
                  .isApprox(Eigen::Vector3d(0.0, -0.06, 0.53), 1e-12));
  q[model.find_variable("spread").value()] = 0.1;
  const Pose spread(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()));
  const Eigen::Vector3d p = spread * Eigen::Vector3d(0.0, -0.06, 0.01);
  EXPECT_TRUE(link_pose(model, q, "distal")
                  .translation()
                  .isApprox(p + Eigen::Vector3d(0.0, 0.0, 0.52), 1e-12))
      << "the joint that comes first moves the second";
}

TEST(MjcfReader, HasShapesThatCollideAndOthers) {
  const RobotModel model = MjcfRobot().model();
  const geometric::Link& proximal = model.link(model.find_link("proximal").value());
  ASSERT_EQ(proximal.collision.size(), 3U) << "a capsule: a cylinder and two balls";
  const auto* cylinder = std::get_if<geometric::Cylinder>(&proximal.collision.front().shape);
  ASSERT_TRUE(cylinder);
  EXPECT_NEAR(cylinder->length, 0.05, 1e-12);
  EXPECT_NEAR(proximal.collision.front().X_LG.translation().z(), 0.035, 1e-12);
  EXPECT_EQ(proximal.collision.front().color, (geometric::Color{1, 0, 0, 1}));
  const geometric::Link& distal = model.link(model.find_link("distal").value());
  EXPECT_EQ(distal.visual.size(), 2U);
  ASSERT_EQ(distal.collision.size(), 1U);
  const geometric::Aabb box =
      geometric::bounding_box(*geometric::tessellate(distal.collision.front().shape));
  EXPECT_NEAR(box.size().y(), 0.02, 2e-4);
  EXPECT_THAT(model.description().warnings, Contains(HasSubstr("a plane")));
}

TEST(MjcfReader, LetsPairsTouchAsMujocoDoes) {
  const RobotDescription robot = read_mjcf(MjcfRobot().file());
  const auto& allowed = robot.allowed_collisions;
  EXPECT_TRUE(allowed.reason("base", "proximal")) << "a parent";
  EXPECT_TRUE(allowed.reason("proximal", "pin")) << "excluded";
  EXPECT_FALSE(allowed.reason("distal", "pin"));
}

TEST(MjcfReader, CouplesJointsByEqualities) {
  const RobotModel one =
      MjcfRobot(R"(<joint joint1="tip" joint2="bend" polycoef="0.1 0.8 0 0 0"/>)").model();
  EXPECT_EQ(one.variable_count(), 4);
  const auto value = [](const RobotModel& model, const geometric::Configuration& q) {
    for (int link = 1; link < model.link_count(); ++link) {
      if (model.joint(link).name == "tip") {
        return joint_value(model, link, q);
      }
    }
    return std::nan("");
  };
  geometric::Configuration q = geometric::Configuration::Zero(4);
  q[one.find_variable("bend").value()] = 0.5;
  EXPECT_NEAR(value(one, q), 0.5, 1e-12);

  const RobotModel several = MjcfRobot(R"(<tendon tendon1="sum"/>)").model();
  ASSERT_EQ(several.variable_count(), 4);
  q[several.find_variable("bend").value()] = 0.5;
  q[several.find_variable("spread").value()] = 0.2;
  EXPECT_NEAR(value(several, q), 0.6, 1e-12) << "half of the one and all of the other";

  const RobotModel held = MjcfRobot(R"(<joint joint1="spread" polycoef="0.2 0 0 0 0"/>)").model();
  EXPECT_FALSE(held.find_variable("spread"));
  const RobotModel curved =
      MjcfRobot(R"(<joint joint1="tip" joint2="bend" polycoef="0 1 2 0 0"/>)").model();
  EXPECT_EQ(curved.variable_count(), 5);
  EXPECT_THAT(curved.description().warnings, Contains(HasSubstr("the equality")));
}

TEST(MjcfReader, HasKeyFramesAsPostures) {
  const RobotDescription robot = read_mjcf(MjcfRobot().file());
  ASSERT_EQ(robot.postures.size(), 1U);
  EXPECT_EQ(robot.postures.front().name, "bent");
  EXPECT_EQ(robot.postures.front().values.at("push"), 0.05);
}

/// A file of its own, among others.
class MjcfFile {
 public:
  explicit MjcfFile(const std::string& body) { write("arm.xml", "<mujoco>" + body + "</mujoco>"); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_.path() / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
    return path;
  }
  [[nodiscard]] RobotDescription read() const { return read_mjcf(folder_.path() / "arm.xml"); }
  [[nodiscard]] std::string refusal() const {
    return test::refusal_of([&] { static_cast<void>(read()); });
  }

 private:
  test::ScratchFolder folder_;
};

constexpr const char* kBody = R"(<worldbody><light mode="newer"/><body name="a">
  <joint name="j" type="hinge" range="-1 1"/><geom type="box" size="0.1 0.1 0.1"/></body></worldbody>)";

// Files for later versions of MuJoCo name what 2.2 does not know.
TEST(MjcfReader, DoesWithoutWhatPlanningDoesNotNeed) {
  const MjcfFile file(std::string(R"(<compiler angle="radian"/><option integrator="implicitfast"/>
<asset><texture name="wood" type="2d" file="wood.png"/><material name="m" texture="wood"/></asset>
<default><position dampratio="1"/><intvelocity kp="1"/></default>)") +
                      kBody + R"(<sensor><clock/></sensor>
<actuator><position joint="j" inheritrange="1"/></actuator>
<keyframe><key name="home" qpos="0.5" ctrl="0.5"/></keyframe>)");
  const RobotDescription robot = file.read();
  EXPECT_EQ(robot.joints.back().limits.upper, 1.0);
  EXPECT_EQ(robot.postures.front().values.at("j"), 0.5);
  EXPECT_THAT(robot.warnings, testing::IsEmpty());
}

TEST(MjcfReader, TellsOfAttributesThatMujocoDoesNotKnow) {
  std::string body = kBody;
  body.replace(body.find("range="), 0, "actuatorfrcrange=\"-1 1\" ");
  EXPECT_THAT(MjcfFile(body).read().warnings,
              testing::ElementsAre(HasSubstr("actuatorfrcrange of <joint>")));
  body = kBody;
  body.replace(body.find("range="), 5, "rnage");
  EXPECT_THAT(MjcfFile(body).refusal(),
              testing::AllOf(HasSubstr("arm.xml:2"), HasSubstr("<joint>"), HasSubstr("rnage")));
}

TEST(MjcfReader, NamesTheLineInAnIncludedFile) {
  const MjcfFile file("<include file=\"parts/a.xml\"/>");
  file.write("parts/a.xml",
             "<mujoco>\n<worldbody><body><geom type=\"bx\"/></body>\n</worldbody></mujoco>");
  EXPECT_THAT(file.refusal(), testing::AllOf(HasSubstr("parts/a.xml:2"), HasSubstr("bx")));
  EXPECT_THAT(
      MjcfFile("\n<include file=\"b.xml\"/>").refusal(),
      testing::AllOf(HasSubstr("arm.xml:2"), HasSubstr("b.xml"), HasSubstr("no such file")));
  EXPECT_THAT(MjcfFile("<include file=\"arm.xml\"/>").refusal(), HasSubstr("includes this one"));
}

std::string two_meshes(const std::string& seen, const std::string& solid) {
  return "<asset><mesh name=\"seen\" file=\"" + seen + "\" scale=\"2 2 2\"/><mesh file=\"" + solid +
         "\"/></asset><worldbody><body name=\"a\"><geom type=\"mesh\" mesh=\"seen\" contype=\"0\" "
         "conaffinity=\"0\"/><geom type=\"mesh\" mesh=\"solid\"/></body></worldbody>";
}

constexpr const char* kTetrahedron =
    "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

TEST(MjcfReader, DoesWithoutMissingMeshesThatAreOnlySeen) {
  const MjcfFile file(two_meshes("seen.stl", "solid.obj"));
  EXPECT_THAT(file.refusal(), testing::AllOf(HasSubstr("arm.xml:1"), HasSubstr("solid.obj"),
                                             HasSubstr("no such file")));
  file.write("solid.obj", kTetrahedron);
  const RobotDescription robot = file.read();
  EXPECT_EQ(robot.links.back().collision.size(), 1U);
  EXPECT_EQ(robot.links.back().visual.size(), 1U);
  EXPECT_THAT(robot.warnings, Contains(HasSubstr("not drawn: seen.stl")));
}

// MuJoCo refuses a surface without volume, and files of other kinds than STL, OBJ and its own.
TEST(MjcfReader, ReadsMeshesThatMujocoDoesNotTake) {
  const MjcfFile file(two_meshes("sheet.obj", "solid.obj"));
  file.write("solid.obj", kTetrahedron);
  file.write("sheet.obj", "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 2 3\nf 1 3 4\n");
  const RobotDescription robot = file.read();
  ASSERT_EQ(robot.links.back().visual.size(), 2U);
  const auto box = [](const geometric::LinkGeometry& part) {
    geometric::TriangleMesh placed = *std::get<geometric::Mesh>(part.shape).triangles;
    for (Eigen::Vector3d& vertex : placed.vertices) {
      vertex = part.X_LG * vertex;
    }
    return geometric::bounding_box(placed);
  };
  const auto sheet = box(robot.links.back().visual[0]);
  EXPECT_LT((sheet.lower - Eigen::Vector3d(0, 0, 2)).norm(), 1e-6) << "scaled, and in its place";
  EXPECT_LT((sheet.upper - Eigen::Vector3d(2, 2, 2)).norm(), 1e-6);
  const auto solid = box(robot.links.back().visual[1]);
  EXPECT_LT((solid.upper - Eigen::Vector3d(0.1, 0.1, 0.1)).norm(), 1e-6);
}

TEST(MjcfReader, TakesFramesForBodies) {
  const RobotModel model(
      MjcfFile(R"(<worldbody><body name="a"><joint name="j" range="-1 1"/><geom size="0.1"/>
<frame pos="0 0 1" euler="0 90 0"><body name="b" pos="0 0 1"><geom size="0.1"/></body></frame>
</body></worldbody>)")
          .read());
  EXPECT_LT(
      (link_pose(model, Eigen::VectorXd::Zero(1), "b").translation() - Eigen::Vector3d(1, 0, 1))
          .norm(),
      1e-9);
}

TEST(MjcfReader, NamesLoopsThatItOpens) {
  EXPECT_THAT(MjcfRobot("<connect body1=\"distal\" body2=\"pin\" anchor=\"0 0 0\"/>")
                  .model()
                  .description()
                  .warnings,
              Contains(testing::AllOf(HasSubstr("loops"), HasSubstr("distal with pin"))));
}

/// Returns two bars of 0.1 m, 0.06 m from each other, with a third one of length `across` on the
/// second and a pin from there to the first one's end. @param knee a joint halfway up the first
/// bar.
RobotDescription four_bars(double across, const char* knee = "", const char* more = "") {
  return MjcfFile(fmt::format(R"(<worldbody><body name="a">
    <joint name="driver" axis="0 1 0" range="-45 45"/><geom size="0.01" pos="0 0 0.1"/>
    <body name="shin" pos="0 0 0.05">{}<geom size="0.01"/></body></body>
    <body name="b" pos="0.06 0 0"><joint name="side" axis="0 1 0" range="-90 90"/>
    <geom size="0.01"/><body name="c" pos="{} 0 0.1"><joint name="top" axis="0 1 0" range="-90 90"/>
    <geom size="0.01"/></body></body></worldbody>
    <equality><connect body1="shin" body2="c" anchor="0 0 0.05"/>{}</equality>)",
                              knee, across - 0.06, more))
      .read();
}

TEST(MjcfReader, ClosesLoopsWhoseJointsFollowInProportion) {
  const RobotDescription robot = four_bars(0.06);
  EXPECT_THAT(robot.warnings, testing::IsEmpty());
  const RobotModel model(robot);
  ASSERT_EQ(model.variable_count(), 1);
  EXPECT_EQ(model.variable(0).name, "driver");
  const Pose top = link_pose(model, Eigen::VectorXd::Constant(1, 0.7), "c");
  EXPECT_LT(
      (top.translation() - Eigen::Vector3d(0.06 + 0.1 * std::sin(0.7), 0, 0.1 * std::cos(0.7)))
          .norm(),
      1e-6);
  EXPECT_LT((top.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-6) << "it stays upright";
}

TEST(MjcfReader, HoldsTheSecondJointOfALoopOfTwoFreedoms) {
  const RobotModel model(four_bars(0.06, R"(<joint name="knee" axis="0 1 0" range="-90 0"/>)"));
  ASSERT_EQ(model.variable_count(), 1);
  const Pose shin = link_pose(model, Eigen::VectorXd::Constant(1, 0.7), "shin");
  EXPECT_NEAR(Eigen::AngleAxisd(shin.linear()).angle(), 0.7, 1e-9) << "straight";
}

TEST(MjcfReader, LetsWhatMovesTheFirstJointLeadALoop) {
  const RobotModel model(four_bars(0.06, "", R"(<joint joint1="driver" joint2="side"/>)"));
  ASSERT_EQ(model.variable_count(), 1);
  EXPECT_EQ(model.variable(0).name, "side");
}

TEST(MjcfReader, LeavesLoopsOpenWhereNoProportionsCloseThem) {
  const RobotDescription led = four_bars(0.06, "", R"(<joint joint1="top" joint2="side"/>)");
  EXPECT_THAT(led.warnings, Contains(HasSubstr("loops that are not kept closed")));
  const RobotDescription skew = four_bars(0.12);
  EXPECT_THAT(skew.warnings, Contains(HasSubstr("loops that are not kept closed")));
  EXPECT_EQ(RobotModel(skew).variable_count(), 3);
}

TEST(MjcfReader, RefusesInMujocosWords) {
  const MjcfRobot robot("<joint joint1=\"tp\"/>");
  EXPECT_THAT(
      test::refusal_of([&] { static_cast<void>(read_mjcf(robot.file())); }),
      testing::AllOf(HasSubstr("finger.xml"), HasSubstr("MuJoCo does not take"), HasSubstr("tp")));
}

}  // namespace
}  // namespace handway::import_mjcf
