/// Tests the parts of a URDF that can't be read: those that planning needs are refused, by line;
/// the others give warnings.
#include "scratch_files.h"

#include <handway/geometric/formats/robot_loader.h>
#include <handway/geometric/formats/urdf.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace handway::geometric::urdf_elements {
namespace {

using test::input_error_of;
using test::kSquareObj;
using test::ScratchFiles;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::string kSphere = R"(<geometry><sphere radius="0.1"/></geometry>)";
const std::string kCollision = "<collision>" + kSphere + "</collision>";

// The body begins at line 3.
std::string robot(const std::string& body) {
  return "<?xml version=\"1.0\"?>\n<robot name=\"r\">\n" + body + "</robot>\n";
}

std::string link(const std::string& body) { return "<link name=\"a\">\n" + body + "\n</link>\n"; }

// A joint whose own elements are on line 5.
std::string jointed(const std::string& body, const std::string& type = "revolute") {
  return robot("<link name=\"a\"/><link name=\"b\"/>\n<joint name=\"j\" type=\"" + type +
               "\"><parent link=\"a\"/><child link=\"b\"/>\n" + body + "</joint>\n");
}

class UrdfElementsTest : public testing::Test {
 protected:
  std::string refusal(const std::string& content) const {
    const auto file = files_.write("r.urdf", content);
    return input_error_of([&] { static_cast<void>(read_urdf(file)); });
  }
  RobotDescription read(const std::string& content) const {
    return read_urdf(files_.write("r.urdf", content));
  }

  ScratchFiles files_;
};

TEST_F(UrdfElementsTest, RefusesCollisionGeometryThatCannotBeRead) {
  for (const std::string shape :
       {R"(<sphere radius="0,03"/>)", R"(<sphere radius="nan"/>)",
        R"(<cylinder radius="0" length="1"/>)", "<sphere/>", R"(<sphere radius="1 2"/>)",
        R"(<box size="1 1"/>)", R"(<box size="1 1 -1"/>)", R"(<box size="1 1 1e7"/>)",
        R"(<cylinder radius="1"/>)", R"(<cylinder radius="1" length="inf"/>)",
        R"(<capsule radius="1"/>)", "", R"(<mesh/>)", R"(<mesh filename="s.obj" scale="1 1"/>)",
        R"(<mesh filename="s.obj" scale="1 0 1"/>)", R"(<mesh filename="s.obj" scale="1 x 1"/>)",
        R"(<box size="1 1 1"/><sphere radius="1"/>)"}) {
    EXPECT_THAT(refusal(robot(link(kCollision + "<collision><geometry>" + shape +
                                   "</geometry></collision>"))),
                AllOf(HasSubstr("r.urdf:4"), HasSubstr("link a, collision"), HasSubstr("expected")))
        << shape;
  }
  EXPECT_THAT(refusal(robot(
                  link(R"(<collision><geometry><sphere radius="0,03"/></geometry></collision>)"))),
              AllOf(HasSubstr("radius=\"0,03\""), HasSubstr("a number"), HasSubstr("0.5")));
}

TEST_F(UrdfElementsTest, RefusesOriginsThatCannotBeRead) {
  for (const std::string origin :
       {R"(<origin xyz="0 0"/>)", R"(<origin xyz="0 0 nan"/>)", R"(<origin rpy="0 0 0 1"/>)",
        R"(<origin xyz=""/>)", R"(<origin xzy="0 0 1"/>)", R"(<origin x="1" y="0" z="0"/>)",
        R"(<origin quat_xyzw="0 0 0 0"/>)"}) {
    EXPECT_THAT(refusal(robot(link("<collision>" + origin + kSphere + "</collision>"))),
                HasSubstr("r.urdf:4"))
        << origin;
    EXPECT_THAT(refusal(jointed(origin, "fixed")), HasSubstr("r.urdf:5")) << origin;
  }
}

TEST_F(UrdfElementsTest, ReadsOriginsOfUrdf12) {
  const RobotDescription r =
      read(jointed(R"(<origin xyz="1 2 3" quat_xyzw="0 0 0.6 0.8"/>)", "fixed"));
  EXPECT_TRUE(
      r.joints[0].X_PJ.isApprox(pose_from_rpy({1, 2, 3}, 0, 0, 2.0 * std::atan2(0.6, 0.8)), 1e-12));
}

TEST_F(UrdfElementsTest, RefusesMisspeltElements) {
  EXPECT_THAT(refusal(robot(link("<collison>" + kSphere + "</collison>"))),
              AllOf(HasSubstr("r.urdf:4"), HasSubstr("<collison>"),
                    HasSubstr("Did you mean <collision>?")));
  for (const std::string& body :
       {"<Collision>" + kSphere + "</Collision>", "<COLLISION>" + kSphere + "</COLLISION>",
        std::string("<collision><geomtry/></collision>"),
        std::string(R"(<collision><geometry><shpere radius="1"/></geometry></collision>)"),
        std::string(R"(<collision><geometry><box sizes="1 1 1"/></geometry></collision>)")}) {
    EXPECT_THAT(refusal(robot(link(body))), HasSubstr("Did you mean")) << body;
  }
  EXPECT_THAT(refusal(robot("<link name=\"a\"/><lnk name=\"b\"/>")), HasSubstr("Did you mean"));
  EXPECT_THAT(refusal(jointed(R"(<limits lower="-1" upper="1"/>)")), HasSubstr("Did you mean"));
  EXPECT_THAT(refusal(jointed(R"(<limit lowr="-1" upper="1"/>)")),
              HasSubstr("Did you mean lower?"));
  EXPECT_THAT(refusal(robot(link("<xacro:if value=\"1\"/>"))),
              AllOf(HasSubstr("<xacro:if>"), HasSubstr("a name that ends in .xacro")));
}

TEST_F(UrdfElementsTest, TakesWhatXacroLeftOfMacrosThatItDidNotKnow) {
  EXPECT_THAT(read(robot(link("<xacro:body/>"))).warnings,
              ElementsAre(HasSubstr("<xacro:body>"), HasSubstr("what they stand for is missing")));
}

// Older files have their gains among the limits.
TEST_F(UrdfElementsTest, TakesStrangeAttributesBesideThoseThatTheyResemble) {
  const RobotDescription r =
      read(jointed(R"(<limit lower="-1" upper="1" velocity="3" k_velocity="10" effort="1"/>)"));
  EXPECT_EQ(r.joints[0].limits.velocity, 3.0);
  EXPECT_THAT(r.warnings, ElementsAre(HasSubstr("k_velocity of <limit>")));
}

TEST_F(UrdfElementsTest, ReadsCapsulesAsThreeShapes) {
  const RobotDescription r = read(robot(link(
      R"(<collision><origin xyz="1 0 0" rpy="0 1.5707963267948966 0"/><geometry>
<capsule radius="0.1" length="2"/></geometry></collision>
<visual><geometry><capsule radius="0.1" length="2"/></geometry></visual>)")));
  ASSERT_THAT(r.links[0].collision, SizeIs(3));
  EXPECT_THAT(r.links[0].visual, SizeIs(3));
  double farthest = 0.0;
  for (const LinkGeometry& part : r.links[0].collision) {
    farthest = std::max(farthest, part.X_LG.translation().x());
  }
  EXPECT_NEAR(farthest, 2.0, 1e-12) << "a ball at the end of the cylinder, along the turned z";
  EXPECT_THAT(r.warnings, IsEmpty());
}

// Converters give such shapes to links that are frames.
TEST_F(UrdfElementsTest, LeavesOutShapesWithoutSize) {
  for (const char* shape : {R"(<box size="0 0 0"/>)", R"(<sphere radius="0.0"/>)",
                            R"(<cylinder radius="0" length="0"/>)"}) {
    const RobotDescription r = read(robot(link(std::string("<collision><geometry>") + shape +
                                               "</geometry></collision>" + kCollision)));
    EXPECT_THAT(r.links[0].collision, SizeIs(1));
    EXPECT_THAT(r.warnings, ElementsAre(HasSubstr("without size, which collide with nothing: a")));
  }
}

TEST_F(UrdfElementsTest, LeavesOutLinksThatNoJointConnects) {
  const RobotDescription r =
      read(robot("<link name=\"a\"/><link name=\"lone\"/><link name=\"b\"/><joint name=\"j\" "
                 "type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/></joint>"));
  EXPECT_THAT(r.links, SizeIs(2));
  EXPECT_THAT(r.warnings, ElementsAre("links that no joint connects are left out: lone"));
}

TEST_F(UrdfElementsTest, RefusesJointsThatFormNoTree) {
  const auto fixed = [](const std::string& name, const std::string& from, const std::string& to) {
    return "<joint name=\"" + name + "\" type=\"fixed\"><parent link=\"" + from +
           "\"/><child link=\"" + to + "\"/></joint>\n";
  };
  const std::string links = "<link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>\n";
  EXPECT_THAT(refusal(robot(links + fixed("j", "a", "b") + fixed("j", "b", "c"))),
              AllOf(HasSubstr("r.urdf:5"), HasSubstr("a second joint \"j\"")));
  EXPECT_THAT(
      refusal(robot(links + fixed("j", "a", "b") + fixed("k", "b", "c") + fixed("l", "a", "c"))),
      AllOf(HasSubstr("r.urdf:6"), HasSubstr("a second joint that carries link \"c\"")));
  EXPECT_THAT(
      refusal(robot(links + fixed("j", "a", "b") + fixed("k", "b", "c") + fixed("l", "c", "a"))),
      AllOf(HasSubstr("r.urdf:2"), HasSubstr("no link that is the root")));
  EXPECT_THAT(refusal(robot("")), HasSubstr("found no links"));
}

TEST_F(UrdfElementsTest, CallsARobotWithoutANameAfterItsFile) {
  const RobotDescription r = read("<robot><link name=\"a\"/></robot>");
  EXPECT_EQ(r.name, "r");
  EXPECT_THAT(r.warnings, ElementsAre(HasSubstr("no name")));
}

TEST_F(UrdfElementsTest, RefusesWhatPlanningNeedsWhereNobodyLooksForIt) {
  EXPECT_THAT(refusal(robot(link("<geometry/>"))), HasSubstr("no place in it"));
  EXPECT_THAT(refusal(robot(link("<collision><box size=\"1 1 1\"/></collision>"))),
              HasSubstr("no place in it"));
  EXPECT_THAT(refusal(robot("<link name=\"a\"/>" + kCollision)), HasSubstr("no place in it"));
}

TEST_F(UrdfElementsTest, TellsOfVendorsElementsOnce) {
  const RobotDescription r = read(
      robot(link(kCollision + R"(<drake:proximity/><contact><stiffness value="1"/></contact>)") +
            R"(<gazebo reference="a"><collison/></gazebo><gazebo/>
                    <transmission name="t"><joint name="j"/></transmission>)"));
  EXPECT_THAT(r.links[0].collision, SizeIs(1));
  EXPECT_THAT(r.warnings,
              ElementsAre(AllOf(HasSubstr("not read"), HasSubstr("<gazebo> (2)"),
                                HasSubstr("<transmission>"), HasSubstr("<drake:proximity>"),
                                HasSubstr("<contact>"))));
}

TEST_F(UrdfElementsTest, KeepsTheGeometryOfLinksWhoseOtherElementsAreBroken) {
  const RobotDescription r = read(robot(R"(<material name="bad"><color rgba="red"/></material>
<material name="half"><color rgba="1 0 0"/></material><material name="half"/>)" +
                                        link(R"(<inertial><mass value="1,5"/></inertial>
<visual>)" + kSphere + R"(<material name="nowhere"/></visual>
<visual>)" + kSphere + R"(<material name="half"/></visual>
<visual>)" + kSphere + R"(<material><color rgba="0 0 1 1"/></material></visual>)" +
                                             kCollision)));
  ASSERT_THAT(r.links, SizeIs(1));
  EXPECT_THAT(r.links[0].collision, SizeIs(1));
  ASSERT_THAT(r.links[0].visual, SizeIs(3));
  EXPECT_EQ(r.links[0].visual[1].color, (Color{1, 0, 0, 1}));
  EXPECT_EQ(r.links[0].visual[2].color, (Color{0, 0, 1, 1}));
  EXPECT_THAT(r.warnings, ElementsAre(AllOf(HasSubstr("materials"), HasSubstr("nowhere"))));
}

TEST_F(UrdfElementsTest, DrawsTheCollisionGeometryWhereVisualsCannotBeRead) {
  files_.write("s.obj", kSquareObj);
  const RobotDescription r =
      read(robot(link(R"(<visual><geometry><mesh filename="lost.dae"/></geometry></visual>
<visual><geometry><sphere radius="0,1"/></geometry></visual>
<visual><geometry><mesh filename="package://nowhere/lost.stl"/></geometry></visual>
<visual><origin xyz="0 0 nan"/>)" +
                      kSphere + R"(</visual>
<collision><geometry><mesh filename="s.obj"/></geometry></collision>)")));
  ASSERT_THAT(r.links[0].visual, SizeIs(1));
  EXPECT_TRUE(std::holds_alternative<Mesh>(r.links[0].visual[0].shape));
  EXPECT_THAT(r.warnings,
              ElementsAre(AllOf(HasSubstr("4 visual elements"), HasSubstr("and 1 more"))))
      << "one summary";
}

TEST_F(UrdfElementsTest, NamesLinksThatCollideWithNothing) {
  const RobotDescription r =
      read(robot("<link name=\"a\"><visual>" + kSphere +
                 "</visual></link><link name=\"frame\"/><joint name=\"j\" type=\"fixed\">"
                 "<parent link=\"a\"/><child link=\"frame\"/></joint>"));
  EXPECT_THAT(r.warnings, ElementsAre(AllOf(HasSubstr("no collision geometry"), HasSubstr(": a"))));
}

TEST_F(UrdfElementsTest, RefusesLimitsThatMakeNoSense) {
  for (const std::string limit :
       {R"(lower="-1e308" upper="1")", R"(lower="1" upper="-1")", R"(lower="nan" upper="1")",
        R"(lower="-1" upper="1" velocity="-1")", R"(lower="-1" upper="1" velocity="nan")",
        R"(lower="-1" upper="1,5")"}) {
    EXPECT_THAT(refusal(jointed("<limit " + limit + "/>")),
                AllOf(HasSubstr("r.urdf:5"), HasSubstr("joint j")))
        << limit;
  }
  EXPECT_THAT(refusal(jointed(R"(<limit velocity="-1"/>)", "continuous")), HasSubstr("velocity"));
}

TEST_F(UrdfElementsTest, TakesLimitsWithoutWhatPlanningDoesNotNeed) {
  const RobotDescription r = read(jointed(
      R"(<limit lower="-1" upper="1"/><dynamics/><safety_controller/><calibration rising="x"/>)"));
  EXPECT_EQ(r.joints[0].limits.lower, -1.0);
  EXPECT_THAT(r.warnings, IsEmpty());
  const RobotDescription wheel =
      read(jointed(R"(<limit lower="-1e16" upper="1e16" effort="x" velocity="3"/>)", "continuous"));
  EXPECT_EQ(wheel.joints[0].limits.velocity, 3.0);
  EXPECT_THAT(read(jointed("<limit/>")).warnings, Contains(HasSubstr("can't move")));
}

// Such limits are written for joints that have none.
TEST_F(UrdfElementsTest, TakesLimitsThatAreTooLargeForNone) {
  for (const char* limit : {R"(lower="-1e10" upper="1e10")", R"(lower="-inf" upper="inf")"}) {
    const RobotDescription r = read(jointed(std::string("<limit ") + limit + "/>"));
    EXPECT_TRUE(r.joints[0].is_continuous());
    EXPECT_THAT(r.warnings, ElementsAre(HasSubstr("turn without end: j")));
    const RobotDescription slide =
        read(jointed(std::string("<limit ") + limit + "/>", "prismatic"));
    EXPECT_EQ(slide.joints[0].limits.upper, 2.0);
    EXPECT_THAT(slide.warnings, ElementsAre(HasSubstr("go ±2 m: j")));
  }
  for (const char* velocity : {"inf", "1e9"}) {
    const RobotDescription r =
        read(jointed(std::string(R"(<limit lower="-1" upper="1" velocity=")") + velocity + "\"/>"));
    EXPECT_TRUE(std::isinf(r.joints[0].limits.velocity));
    EXPECT_THAT(r.warnings, IsEmpty());
  }
}

TEST_F(UrdfElementsTest, RefusesCouplingsThatMakeNoSense) {
  const std::string limit = R"(<limit lower="-1" upper="1"/>)";
  for (const std::string mimic :
       {R"(joint="nobody")", R"(joint="j" multiplier="1e300")", R"(joint="j" multiplier="nan")",
        R"(joint="j" offset="x")", R"(joint="j" multiplyer="2")", "multiplier=\"1\""}) {
    EXPECT_THAT(refusal(jointed(limit + "<mimic " + mimic + "/>")), HasSubstr("r.urdf:5")) << mimic;
  }
}

TEST_F(UrdfElementsTest, LetsAnEndlessJointFollowAtAnyRatio) {
  const RobotDescription r =
      read(robot("<link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>"
                 "<joint name=\"j\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/>"
                 "<limit lower=\"-3\" upper=\"3\"/></joint>"
                 "<joint name=\"wheel\" type=\"continuous\"><parent link=\"b\"/><child link=\"c\"/>"
                 "<mimic joint=\"j\" multiplier=\"20\"/></joint>"));
  const RobotModel model(r);
  EXPECT_EQ(model.upper()[0], 3.0);
  EXPECT_TRUE(model.joint(2).is_continuous());
}

TEST_F(UrdfElementsTest, FindsFilesWhoseNamesHaveOtherLetters) {
  files_.write("Meshes/Part.OBJ", kSquareObj);
  const RobotDescription r = read(robot(
      link(R"(<collision><geometry><mesh filename="meshes\part.obj"/></geometry></collision>)")));
  EXPECT_EQ(std::get<Mesh>(r.links[0].collision[0].shape).file,
            files_.folder() / "Meshes/Part.OBJ");
  EXPECT_THAT(r.warnings, ElementsAre(AllOf(HasSubstr("other letters"), HasSubstr("part.obj"))));
  files_.write("Meshes/part.Obj", kSquareObj);
  EXPECT_THAT(
      refusal(robot(link(
          R"(<collision><geometry><mesh filename="meshes/part.obj"/></geometry></collision>)"))),
      HasSubstr("no such file"))
      << "which of the two?";
}

}  // namespace
}  // namespace handway::geometric::urdf_elements
