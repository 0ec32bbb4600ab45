#include "scratch_files.h"

#include <handway/geometric/formats/robot_loader.h>
#include <handway/geometric/formats/urdf.h>
#include <handway/geometric/robot/base_joint.h>
#include <handway/geometric/robot/robot_state.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace handway::geometric {
namespace {

using test::input_error_of;
using test::kSquareObj;
using test::ScratchFiles;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kPi = std::numbers::pi;

std::string robot(const std::string& body) {
  return "<?xml version=\"1.0\"?>\n<robot name=\"r\">\n" + body + "</robot>\n";
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& more) {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" + more + "</joint>\n";
}

const std::string kLimit = R"(<limit lower="-1" upper="2" effort="0" velocity="3"/>)";

std::string refusal(const ScratchFiles& files, const std::string& content) {
  const auto file = files.write("broken.urdf", content);
  return input_error_of([&] { static_cast<void>(load_robot(file)); });
}

TEST(UrdfReader, ReadsLinksAndJointsInTheOrderOfTheFile) {
  const ScratchFiles files;
  const RobotDescription r = read_urdf(files.write(
      "r.urdf",
      robot("<link name=\"z\"/><link name=\"m\"/><link name=\"a\"/><link name=\"b\"/>\n" +
            joint("j2", "revolute", "z", "m",
                  R"(<origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/><axis xyz="0 2 0"/>)" +
                      kLimit) +
            joint("j1", "prismatic", "m", "a", "<axis xyz=\"0 0 -1\"/>" + kLimit) +
            joint("j0", "fixed", "m", "b", ""))));
  EXPECT_EQ(r.name, "r");
  EXPECT_THAT(r.links,
              ElementsAre(testing::Field(&Link::name, "z"), testing::Field(&Link::name, "m"),
                          testing::Field(&Link::name, "a"), testing::Field(&Link::name, "b")));
  ASSERT_EQ(r.joints.size(), 3U);
  const Joint& j2 = r.joints[0];
  EXPECT_EQ(j2.name, "j2");
  EXPECT_EQ(j2.type, JointType::kRevolute);
  EXPECT_TRUE(j2.axis.isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(j2.X_PJ.isApprox(pose_from_rpy({1, 2, 3}, 0, 0, kPi / 2), 1e-12));
  EXPECT_EQ(j2.limits.lower, -1.0);
  EXPECT_EQ(j2.limits.upper, 2.0);
  EXPECT_EQ(j2.limits.velocity, 3.0);
  EXPECT_TRUE(std::isinf(j2.limits.acceleration));
  EXPECT_EQ(r.joints[1].type, JointType::kPrismatic);
  EXPECT_EQ(r.joints[2].type, JointType::kFixed);
  EXPECT_THAT(r.warnings, IsEmpty());
}

TEST(UrdfReader, GivesAContinuousJointNoLimits) {
  const ScratchFiles files;
  const RobotDescription r = read_urdf(
      files.write("r.urdf", robot("<link name=\"a\"/><link name=\"b\"/>" +
                                  joint("spin", "continuous", "a", "b", "<axis xyz=\"0 0 1\"/>"))));
  EXPECT_EQ(r.joints[0].type, JointType::kRevolute);
  EXPECT_TRUE(r.joints[0].is_continuous());
  EXPECT_THAT(r.warnings, IsEmpty());
}

TEST(UrdfReader, ReadsAPlanarJointAsTwoSlidesAndATurn) {
  const ScratchFiles files;
  const RobotModel model(read_urdf(
      files.write("r.urdf", robot("<link name=\"a\"/><link name=\"b\"/>" +
                                  joint("drive", "planar", "a", "b", "<origin xyz=\"1 0 0\"/>")))));
  ASSERT_EQ(model.variable_count(), 3);
  EXPECT_EQ(model.variable(0).name, "drive/x");
  EXPECT_EQ(model.variable(1).name, "drive/y");
  EXPECT_EQ(model.variable(2).name, "drive/theta");
  EXPECT_TRUE(model.is_continuous(2));
  RobotState state(std::make_shared<const RobotModel>(model));
  state.set_configuration(Eigen::Vector3d(0.5, -0.25, kPi / 2));
  EXPECT_TRUE(state.link_pose("b").isApprox(pose_from_rpy({1.5, -0.25, 0}, 0, 0, kPi / 2), 1e-12))
      << "across z where the file names no normal";
}

TEST(UrdfReader, MovesAPlanarJointAcrossItsNormal) {
  const ScratchFiles files;
  const RobotModel model(read_urdf(
      files.write("r.urdf", robot("<link name=\"a\"/><link name=\"b\"/>" +
                                  joint("wall", "planar", "a", "b", "<axis xyz=\"0 2 0\"/>")))));
  EXPECT_NEAR(model.variable(0).axis.dot(Eigen::Vector3d::UnitY()), 0.0, 1e-12);
  EXPECT_NEAR(model.variable(1).axis.dot(Eigen::Vector3d::UnitY()), 0.0, 1e-12);
  EXPECT_TRUE(model.variable(2).axis.isApprox(Eigen::Vector3d::UnitY()));
}

// Any pose is reached, by the angles of URDF's rpy.
TEST(UrdfReader, ReadsAFloatingJointAsThreeSlidesAndThreeTurns) {
  const ScratchFiles files;
  const RobotModel model(read_urdf(files.write(
      "r.urdf",
      robot("<link name=\"a\"/><link name=\"b\"/>" + joint("free", "floating", "a", "b", "")))));
  ASSERT_EQ(model.variable_count(), 6);
  EXPECT_EQ(model.variable(2).name, "free/trans_z");
  EXPECT_EQ(model.variable(5).name, "free/roll");
  EXPECT_TRUE(model.is_continuous(3) && !model.is_continuous(4) && model.is_continuous(5));
  for (const Pose& X : {pose_from_rpy({0.1, -0.2, 0.3}, 2.5, -1.2, 3.0),
                        pose_from_rpy({0, 0, 0}, -3.0, 1.5, -0.1), Pose::Identity()}) {
    const std::vector<double> values = values_at(model.description().base_joints.front(), X);
    RobotState state(std::make_shared<const RobotModel>(model));
    state.set_configuration(Eigen::Map<const Eigen::VectorXd>(values.data(), 6));
    EXPECT_TRUE(state.link_pose("b").isApprox(X, 1e-12));
    EXPECT_TRUE(state.within_limits());
  }
}

TEST(UrdfReader, FollowsChainsOfCoupledJoints) {
  const ScratchFiles files;
  const auto model = load_robot(files.write(
      "r.urdf", robot("<link name=\"a\"/><link name=\"b\"/><link name=\"c\"/><link name=\"d\"/>" +
                      joint("lead", "revolute", "a", "b", kLimit) +
                      joint("second", "revolute", "b", "c",
                            kLimit + R"(<mimic joint="lead" multiplier="2" offset="1"/>)") +
                      joint("third", "revolute", "c", "d",
                            kLimit + R"(<mimic joint="second" multiplier="3" offset="5"/>)"))));
  ASSERT_EQ(model->variable_count(), 1);
  EXPECT_EQ(model->mimic_mapping(2).multiplier, 2.0);
  EXPECT_EQ(model->mimic_mapping(2).offset, 1.0);
  EXPECT_EQ(model->mimic_mapping(3).multiplier, 6.0);
  EXPECT_EQ(model->mimic_mapping(3).offset, 8.0);
}

TEST(UrdfReader, ReadsAllShapesAndColours) {
  const ScratchFiles files;
  files.write("meshes/s.obj", kSquareObj);
  const RobotDescription r = read_urdf(
      files.write("r.urdf", robot(R"(<material name="red"><color rgba="1 0 0 0.5"/></material>
<link name="a">
 <visual><origin xyz="0 0 1"/><geometry><box size="1 2 3"/></geometry><material name="red"/></visual>
 <visual><geometry><mesh filename="meshes/s.obj" scale="2 2 2"/></geometry>
  <material name="own"><color rgba="0 1 0 1"/></material></visual>
 <collision><geometry><sphere radius="0.5"/></geometry></collision>
 <collision><geometry><cylinder radius="0.1" length="2"/></geometry></collision>
</link>
)")));
  const Link& a = r.links[0];
  ASSERT_EQ(a.visual.size(), 2U);
  EXPECT_EQ(std::get<Box>(a.visual[0].shape).size, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(a.visual[0].X_LG.translation(), Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(a.visual[0].color, (Color{1, 0, 0, 0.5F}));
  EXPECT_EQ(a.visual[1].color, (Color{0, 1, 0, 1}));
  const Mesh& mesh = std::get<Mesh>(a.visual[1].shape);
  EXPECT_EQ(mesh.file, files.folder() / "meshes/s.obj");
  EXPECT_EQ(bounding_box(*mesh.triangles).upper, Eigen::Vector3d(2, 2, 0));
  ASSERT_EQ(a.collision.size(), 2U);
  EXPECT_EQ(std::get<Sphere>(a.collision[0].shape).radius, 0.5);
  EXPECT_EQ(std::get<Cylinder>(a.collision[1].shape).length, 2.0);
}

TEST(UrdfReader, FindsMeshesOfPackages) {
  const ScratchFiles files;
  const auto mesh = files.write("ws/meshes_of_r/parts/s.obj", kSquareObj);
  files.write("ws/r_description/own.obj", kSquareObj);
  const auto link = [](const std::string& name, const std::string& file) {
    return "<link name=\"" + name + "\"><collision><geometry><mesh filename=\"" + file +
           "\"/></geometry></collision></link>";
  };
  const RobotDescription r = read_urdf(files.write(
      "ws/r_description/urdf/r.urdf",
      robot(link("a", "package://meshes_of_r/parts/s.obj") +
            link("b", "package://r_description/own.obj") + link("c", "file://" + mesh.string()) +
            joint("x", "fixed", "a", "b", "") + joint("y", "fixed", "a", "c", ""))));
  EXPECT_EQ(std::get<Mesh>(r.links[0].collision[0].shape).file, mesh);
  EXPECT_EQ(std::get<Mesh>(r.links[1].collision[0].shape).file,
            files.folder() / "ws/r_description/own.obj");
  EXPECT_EQ(std::get<Mesh>(r.links[2].collision[0].shape).file, mesh);
}

TEST(UrdfReader, FindsPackagesWhereRosHasThem) {
  const ScratchFiles files;
  const auto mesh = files.write("ros/share/arm_description/meshes/s.obj", kSquareObj);
  const auto file = files.write(
      "mine/r.urdf", robot("<link name=\"a\"><collision><geometry><mesh "
                           "filename=\"package://arm_description/meshes/s.obj\"/></geometry>"
                           "</collision></link>"));
  const std::string ros = (files.folder() / "ros").string();
  for (const auto& [variable, value] : {std::pair("ROS_PACKAGE_PATH", "/nowhere:" + ros + "/share"),
                                        std::pair("AMENT_PREFIX_PATH", ros)}) {
    ASSERT_EQ(setenv(variable, value.c_str(), 1), 0);
    const RobotDescription r = read_urdf(file);
    unsetenv(variable);
    EXPECT_EQ(std::get<Mesh>(r.links[0].collision[0].shape).file, mesh);
  }
}

// The mesh is copied out of its package, or has another name than the package.
TEST(UrdfReader, TakesTheFileNearbyThatAMissingMeshMustBe) {
  const ScratchFiles files;
  files.write("other/meshes/s.obj", kSquareObj);
  const auto mesh = files.write("mine/meshes/s.obj", kSquareObj);
  const auto flat = files.write("mine/urdf/t.obj", kSquareObj);
  const auto read = [&](const std::string& name) {
    return read_urdf(files.write(
        "mine/urdf/r.urdf", robot("<link name=\"a\"><collision><geometry><mesh filename=\"" + name +
                                  "\"/></geometry></collision></link>")));
  };
  for (const char* name :
       {"package://r_description/meshes/s.obj", "model://r/meshes/s.obj", "meshes/s.obj",
        "$(find r)/meshes/s.obj", "https://example.org/r/meshes/s.obj",
        R"(C:\Users\me\meshes\s.obj)", "file:///home/me/ws/src/r/meshes/s.obj"}) {
    const RobotDescription r = read(name);
    EXPECT_EQ(std::get<Mesh>(r.links[0].collision[0].shape).file, mesh) << name;
    EXPECT_THAT(r.warnings, ElementsAre(HasSubstr(std::string(name) + " is " + mesh.string())));
  }
  EXPECT_EQ(std::get<Mesh>(read("package://r/visual/t.obj").links[0].collision[0].shape).file,
            flat);
  EXPECT_THROW(static_cast<void>(read("package://r/parts/u.obj")), MissingMeshError);
}

TEST(UrdfReader, CountsAllMissingMeshesAtOnce) {
  const ScratchFiles files;
  const auto link = [](const std::string& name) {
    return "<link name=\"" + name + "\"><collision><geometry><mesh filename=\"" + name +
           ".stl\"/></geometry></collision></link>\n";
  };
  const std::string error =
      refusal(files, robot(link("a") + link("b") + link("c") + joint("j", "fixed", "a", "b", "") +
                           joint("k", "fixed", "a", "c", "")));
  EXPECT_THAT(error, AllOf(HasSubstr("broken.urdf:3"), HasSubstr("a.stl"),
                           HasSubstr("3 collision meshes are missing in all")));
}

TEST(UrdfReader, SaysWhereAMissingMeshMayBe) {
  const ScratchFiles files;
  files.write("other/parts/s.obj", kSquareObj);
  for (const char* name : {"meshes/s.obj", "package://nowhere/s.obj"}) {
    const auto file =
        files.write("mine/r.urdf",
                    robot(std::string("<link name=\"a\"><collision><geometry><mesh filename=\"") +
                          name + "\"/></geometry></collision></link>"));
    EXPECT_THAT(
        input_error_of([&] { static_cast<void>(read_urdf(file)); }),
        AllOf(HasSubstr("r.urdf:"), HasSubstr(name), HasSubstr("\"../other/parts/s.obj\"")));
  }
}

TEST(UrdfReader, LooksForMissingMeshesInThePackagePath) {
  const ScratchFiles files, elsewhere;
  const auto link = [](const std::string& name, const std::string& file) {
    return "<link name=\"" + name + "\"><collision><geometry><mesh filename=\"" + file +
           "\"/></geometry></collision></link>";
  };
  const auto visual = elsewhere.write("robot/visual/s.obj", kSquareObj);
  const auto collision = elsewhere.write("robot/collision/s.obj", kSquareObj);
  const auto file =
      files.write("r.urdf", robot(link("a", "package://lost/collision/s.obj") +
                                  link("b", "visual/s.obj") + joint("j", "fixed", "a", "b", "")));
  EXPECT_THROW(static_cast<void>(read_urdf(file)), MissingMeshError);
  ASSERT_EQ(setenv("HANDWAY_PACKAGE_PATH", elsewhere.folder().c_str(), 1), 0);
  const RobotDescription r = read_urdf(file);
  unsetenv("HANDWAY_PACKAGE_PATH");
  EXPECT_EQ(std::get<Mesh>(r.links[0].collision[0].shape).file, collision);
  EXPECT_EQ(std::get<Mesh>(r.links[1].collision[0].shape).file, visual);
  EXPECT_THAT(r.warnings, testing::Contains(HasSubstr("visual/s.obj is " + visual.string())));
}

TEST(UrdfReader, NamesTheLineOfABrokenFile) {
  const ScratchFiles files;
  EXPECT_THAT(refusal(files, "<robot name=\"r\">\n<link name=\"a\">\n</robot>\n"),
              AllOf(HasSubstr("broken.urdf:3"), HasSubstr("broken XML")));
}

TEST(UrdfReader, NamesTheLineOfAWrongElement) {
  const ScratchFiles files;
  const std::string links = "<link name=\"a\"/>\n<link name=\"b\"/>\n";
  EXPECT_THAT(refusal(files, robot(links + joint("j", "screw", "a", "b", ""))),
              AllOf(HasSubstr("broken.urdf:5"), HasSubstr("screw"), HasSubstr("floating")));
  EXPECT_THAT(refusal(files, robot(links + joint("j", "revolute", "a", "b", ""))),
              AllOf(HasSubstr("broken.urdf:5"), HasSubstr("limit")));
  EXPECT_THAT(refusal(files, robot(links + joint("j", "fixed", "a", "nowhere", ""))),
              AllOf(HasSubstr("broken.urdf:5: joint j: found the unknown child link \"nowhere\""),
                    HasSubstr("There are: a, b")));
  // The misspelt child leaves two roots.
  EXPECT_THAT(
      refusal(files, robot(links + "<link name=\"c\"/>" + joint("j", "fixed", "a", "bb", "") +
                           joint("k", "fixed", "b", "c", ""))),
      HasSubstr("joint j: found the unknown child link \"bb\""));
  EXPECT_THAT(refusal(files, robot(links + joint("j", "revolute", "a", "b",
                                                 "<limit upper=\"-1\" effort=\"1\"/>"))),
              AllOf(HasSubstr("upper=\"-1\" alone"), HasSubstr("Write both limits")));
  EXPECT_THAT(refusal(files, robot(links + joint("j", "revolute", "a", "b",
                                                 "<axis xyz=\"0 0 0\"/>" + kLimit))),
              AllOf(HasSubstr("broken.urdf:5"), HasSubstr("axis")));
  EXPECT_THAT(refusal(files, robot("\n\n<link name=\"a\"><collision><geometry>"
                                   "<mesh filename=\"no.stl\"/></geometry></collision></link>")),
              AllOf(HasSubstr("broken.urdf:5"), HasSubstr("no.stl"), HasSubstr("no such file")));
  EXPECT_THAT(refusal(files, robot("<link name=\"a\"/><link/>")), HasSubstr("no name"));
  EXPECT_THAT(refusal(files, robot("<link name=\"a\"><collision><geometry>"
                                   "<sphere radius=\"-1\"/></geometry></collision></link>")),
              HasSubstr("-1"));
}

TEST(UrdfReader, RefusesWhatIsNoRobot) {
  const ScratchFiles files;
  EXPECT_THAT(refusal(files, ""), HasSubstr("empty file"));
  EXPECT_THAT(refusal(files, "   \n"), HasSubstr("empty file"));
  EXPECT_THAT(refusal(files, "<scene/>"), HasSubstr("<robot>"));
  EXPECT_THAT(refusal(files, std::string("\x7F"
                                         "ELF\x02\x01\0\0",
                                         8)),
              HasSubstr("no text"));
  EXPECT_THAT(refusal(files, robot("")), HasSubstr("broken.urdf"));
  EXPECT_THAT(refusal(files, robot("<link name=\"a\"/><link name=\"a\"/>")), HasSubstr("unique"));
  EXPECT_THAT(refusal(files, robot("<link name=\"a\"/><link name=\"b\"/>")), HasSubstr("root"));
  EXPECT_EQ(
      refusal(files, robot("<link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>\n<link "
                           "name=\"d\"/>" +
                           joint("j", "fixed", "a", "b", "") + joint("k", "fixed", "d", "c", ""))),
      (files.folder() / "broken.urdf").string() +
          ":4: robot: found several links that no joint carries: \"a\", \"d\", expected one, "
          "the root. Connect them by a fixed joint.");
  std::string deep;
  for (int i = 0; i < 100000; ++i) {
    deep += "<a>";
  }
  EXPECT_THAT(refusal(files, deep), HasSubstr("broken.urdf:1"));
  for (int i = 0; i < 100000; ++i) {
    deep += "</a>";
  }
  EXPECT_THAT(refusal(files, deep), HasSubstr("nested"));
  EXPECT_THAT(input_error_of([&] { static_cast<void>(read_urdf(files.folder() / "no.urdf")); }),
              HasSubstr("no such file"));
  EXPECT_THAT(input_error_of([&] { static_cast<void>(read_urdf(files.folder())); }),
              HasSubstr("folder"));
}

TEST(UrdfReader, RefusesNumbersThatAreNone) {
  const ScratchFiles files;
  const std::string links = "<link name=\"a\"/><link name=\"b\"/>";
  for (const std::string number : {"nan", "inf", "1e999", "one", ""}) {
    const std::string limit =
        "<limit lower=\"" + number + "\" upper=\"2\" effort=\"0\" velocity=\"3\"/>";
    EXPECT_NE(refusal(files, robot(links + joint("j", "revolute", "a", "b", limit))), "no error")
        << number;
    const std::string origin = "<origin xyz=\"0 0 " + number + "\"/>";
    EXPECT_NE(refusal(files, robot(links + joint("j", "fixed", "a", "b", origin))), "no error")
        << number;
  }
}

TEST(UrdfReader, RefusesCoupledJointsInARing) {
  const ScratchFiles files;
  EXPECT_NE(
      refusal(files, robot("<link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>" +
                           joint("j", "revolute", "a", "b", kLimit + "<mimic joint=\"k\"/>") +
                           joint("k", "revolute", "b", "c", kLimit + "<mimic joint=\"j\"/>"))),
      "no error");
}

TEST(RobotLoader, LetsJoinedAndOverlappingLinksTouchWithoutAnSrdf) {
  const ScratchFiles files;
  const std::string solid =
      "<collision><geometry><sphere radius=\"0.1\"/></geometry></collision></link>";
  const auto model = load_robot(files.write(
      "r.urdf", robot("<link name=\"a\">" + solid + "<link name=\"frame\"/><link name=\"b\">" +
                      solid + "<link name=\"c\">" + solid + joint("i", "fixed", "a", "frame", "") +
                      joint("j", "revolute", "frame", "b", kLimit) +
                      joint("k", "revolute", "b", "c", kLimit))));
  const AllowedCollisions& allowed = model->description().allowed_collisions;
  EXPECT_EQ(allowed.reason("a", "b"), AllowedReason::kAdjacent);
  EXPECT_EQ(allowed.reason("b", "c"), AllowedReason::kAdjacent);
  EXPECT_EQ(allowed.reason("a", "c"), AllowedReason::kAlways);
  EXPECT_EQ(allowed.entries().size(), 3U);
  EXPECT_EQ(model->find_group("arm")->size(), 2U);
  EXPECT_THAT(model->description().warnings,
              ElementsAre(AllOf(HasSubstr("SRDF"), HasSubstr("1 pair that overlaps")),
                          HasSubstr("may be an arm or a finger")));
}

TEST(RobotLoader, FindsTheGroupsThatAnSrdfCallsOtherwise) {
  const ScratchFiles files;
  const std::string far = "<origin xyz=\"0 0 0.5\"/>" + kLimit;
  std::string links;
  for (const char* name : {"base", "upper", "fore", "wrist", "left", "right", "head"}) {
    links += "<link name=\"" + std::string(name) + "\"/>";
  }
  const auto file =
      files.write("r.urdf", robot(links + joint("a", "revolute", "base", "upper", far) +
                                  joint("b", "revolute", "upper", "fore", far) +
                                  joint("c", "revolute", "fore", "wrist", far) +
                                  joint("l", "revolute", "wrist", "left", kLimit) +
                                  joint("r", "revolute", "wrist", "right", kLimit) +
                                  joint("h", "revolute", "base", "head", far)));
  files.write("r.srdf",
              "<robot name=\"r\"><group name=\"manipulator\"><joint name=\"a\"/></group>"
              "<disable_collisions link1=\"base\" link2=\"upper\"/></robot>");
  const auto model = load_robot(file);
  EXPECT_THAT(model->find_group("arm"), testing::Optional(ElementsAre(0, 1, 2)));
  EXPECT_THAT(model->find_group("hand"), testing::Optional(ElementsAre(3, 4)));
  EXPECT_THAT(model->description().warnings, IsEmpty());
}

TEST(RobotLoader, KnowsUrdfFilesByTheirTopElementToo) {
  const ScratchFiles files;
  const auto file = files.write("r.xml",
                                "<?xml version=\"1.0\"?>\n<!-- by hand -->\n"
                                "<robot name=\"r\"><link name=\"a\"/></robot>");
  EXPECT_TRUE(is_robot_file(file));
  EXPECT_EQ(load_robot(file)->link_count(), 1);
  EXPECT_FALSE(is_robot_file(files.write("p.xml", "<Problem name=\"r\"/>")));
}

TEST(RobotLoader, RefusesOtherKindsOfFiles) {
  const ScratchFiles files;
  const auto file = files.write("r.xacro", "<robot/>");
  EXPECT_THAT(input_error_of([&] { static_cast<void>(load_robot(file)); }), HasSubstr("xacro"));
}

TEST(UrdfReader, KeepsSoftLimits) {
  const ScratchFiles files;
  const auto limits = [&](const std::string& safety) {
    const RobotDescription r = read_urdf(files.write(
        "r.urdf",
        robot("<link name=\"a\"/><link name=\"b\"/>" +
              joint("j", "revolute", "a", "b", "<axis xyz=\"0 0 1\"/>" + kLimit + safety))));
    return std::tuple(r.joints[0].limits.lower, r.joints[0].limits.upper, r.warnings.size());
  };
  EXPECT_EQ(limits("<safety_controller k_velocity=\"0\" soft_lower_limit=\"-0.5\" "
                   "soft_upper_limit=\"1\"/>"),
            std::tuple(-0.5, 1.0, 0U));
  EXPECT_EQ(limits("<safety_controller soft_lower_limit=\"-0.5\"/>"), std::tuple(-0.5, 2.0, 0U));
  EXPECT_EQ(limits("<safety_controller soft_lower_limit=\"0\" soft_upper_limit=\"0\"/>"),
            std::tuple(-1.0, 2.0, 0U))
      << "exporters write zeros";
  EXPECT_EQ(limits("<safety_controller soft_lower_limit=\"-5\" soft_upper_limit=\"5\"/>"),
            std::tuple(-1.0, 2.0, 0U));
  EXPECT_EQ(limits("<safety_controller soft_lower_limit=\"3\" soft_upper_limit=\"4\"/>"),
            std::tuple(-1.0, 2.0, 1U))
      << "they leave no range";
}

TEST(RobotLoader, KeepsLimitsOfPositionsBesideTheRobot) {
  const ScratchFiles files;
  const auto file = files.write(
      "r.urdf", robot("<link name=\"a\"/><link name=\"b\"/>" +
                      joint("j", "revolute", "a", "b", "<axis xyz=\"0 0 1\"/>" + kLimit)));
  files.write(
      "joint_limits.yaml",
      "joint_limits:\n  j: {has_position_limits: true, min_position: -0.4, max_position: 9}\n");
  EXPECT_EQ(load_robot(file)->lower()[0], -0.4);
  EXPECT_EQ(load_robot(file)->upper()[0], 2.0);
  files.write("joint_limits.yaml", "joint_limits:\n  j: {min_positon: -0.4}\n");
  EXPECT_EQ(load_robot(file)->lower()[0], -1.0);
  EXPECT_THAT(load_robot(file)->description().warnings,
              testing::Contains(AllOf(HasSubstr("joint_limits.yaml:2"), HasSubstr("min_positon"))));
}

}  // namespace
}  // namespace handway::geometric
