/// Tests reading of MoveIt problems, and planning for them.
#include "moveit_problem.h"

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/planners/planner.h"
#include "handway_test/input_errors.h"
#include "ompl_planner.h"
#include "small_problem.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

namespace handway::import_moveit {
namespace {

using geometric::Scene;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(MoveitProblem, IsKnownByItsKeys) {
  const SmallProblem problem;
  const MoveitImporter importer;
  EXPECT_TRUE(importer.can_read(problem.scene()));
  EXPECT_TRUE(importer.can_read(problem.request()));
  EXPECT_FALSE(importer.can_read(test::source_dir() / "scenes" / "can_on_table.yaml"));
  EXPECT_FALSE(importer.can_read(problem.folder() / "robots" / "crane.urdf"));
}

// RViz exports such texts: since Noetic objects have a pose of their own.
TEST(MoveitProblem, ReadsScenesAsText) {
  const SmallProblem problem;
  const std::filesystem::path file = problem.folder() / "kitchen.scene";
  const auto write = [&](const std::string& pose, const std::string& kind) {
    std::ofstream(file) << "kitchen\n* the table\n" + pose + "1\nbox\n1.2 0.8 0.05\n0.7 0 0.4\n" +
                               "0 0 0 1\n0.5 0.4 0.25 1\n* can\n" + pose + "1\n" + kind +
                               "\n0.03 0.12\n0.6 0.1 0.5\n0 0 0 1\n0 0 0 0\n.\n";
  };
  const MoveitImporter importer;
  EXPECT_TRUE(importer.can_read(file));
  write("", "cylinder");
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(importer.read(file)); }),
              testing::AllOf(HasSubstr("kitchen.scene"), HasSubstr("--robot FILE")));
  ::setenv("HANDWAY_ROBOT", (problem.folder() / "robots" / "crane.urdf").c_str(), 1);
  for (const double height : {0.0, 1.0}) {
    write(height > 0.0 ? "0 0 1\n0 0 0 1\n" : "", "cylinder");
    const auto scene = importer.read(file).scene;
    ASSERT_EQ(scene->objects.size(), 2U);
    EXPECT_EQ(scene->objects[0].name, "the table");
    EXPECT_EQ(std::get<geometric::Box>(scene->objects[0].shape).size.x(), 1.2);
    const auto& can = std::get<geometric::Cylinder>(scene->objects[1].shape);
    EXPECT_EQ(can.radius, 0.03);
    EXPECT_EQ(can.length, 0.12);
    EXPECT_NEAR(scene->objects[1].X_PO.translation().z(), 0.5 + height, 1e-12);
  }
  write("", "tube");
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(importer.read(file)); }),
              testing::AllOf(HasSubstr("kitchen.scene:11"), HasSubstr("tube"), HasSubstr("cone")));
  ::unsetenv("HANDWAY_ROBOT");
}

TEST(MoveitProblem, ReadsScenesAsTextWhateverNamesAreMadeOf) {
  const SmallProblem problem;
  const std::filesystem::path file = problem.folder() / "workshop.scene";
  std::ofstream(file) << "the \"workshop\"\n* 1\" pipe: #4\n1\nmesh\n4 4\n0 0 0\n1 0 0\n0 1 0\n"
                      << "0 0 1\n0 2 1\n0 1 3\n0 3 2\n1 2 3\n0.7 0 0.4\n0 0 0 1\n0 0 0 0\n.\n";
  ::setenv("HANDWAY_ROBOT", (problem.folder() / "robots" / "crane.urdf").c_str(), 1);
  const auto scene = MoveitImporter().read(file).scene;
  ::unsetenv("HANDWAY_ROBOT");
  ASSERT_EQ(scene->objects.size(), 1U);
  EXPECT_EQ(scene->objects[0].name, "1\" pipe: #4");
  EXPECT_EQ(std::get<geometric::Mesh>(scene->objects[0].shape).triangles->triangles.size(), 4U);
}

TEST(MoveitProblem, MovesTheJointsOfItsGroupAlone) {
  const SmallProblem problem;
  const auto scene = problem.read().scene;
  const geometric::RobotModel& model = *scene->robots.front().model;
  ASSERT_EQ(model.variable_count(), 3);
  EXPECT_EQ(model.variable(0).name, "turn");
  EXPECT_TRUE(scene->start->isApprox(Eigen::Vector3d(-0.8, 0.05, 0.0))) << "request over scene";
  EXPECT_TRUE(scene->goal->isApprox(Eigen::Vector3d(0.8, 0.05, 0.1)));
  std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(Eigen::Vector3d::Zero(), X_BL);
  const auto place = [&](const char* link) -> Eigen::Vector3d {
    return X_BL[static_cast<std::size_t>(*model.find_link(link))].translation();
  };
  EXPECT_TRUE(place("finger").isApprox(Eigen::Vector3d(0.51, 0.03, 0.45))) << "where it was";
  EXPECT_TRUE(place("finger_2").isApprox(Eigen::Vector3d(0.51, -0.03, 0.45))) << "coupled";
}

constexpr const char* kVirtualJoint =
    R"(<virtual_joint name="world_joint" type="planar" parent_frame="odom" child_link="base"/>
  <group name="crane_arm">)";

// The base is on the left of its place in the problem, turned by a quarter.
constexpr const char* kBaseState = R"(robot_state:
  multi_dof_joint_state:
    joint_names: [world_joint]
    transforms: [{translation: {x: 0, y: 3, z: 0}, rotation: {x: 0, y: 0, z: 0.7071068, w: 0.7071068}}]
)";

TEST(MoveitProblem, PutsARobotWhereItsVirtualJointIs) {
  const SmallProblem problem;
  const auto srdf = problem.folder() / "robots" / "crane.srdf";
  problem.replace(srdf, "<group name=\"crane_arm\">", kVirtualJoint);
  problem.replace(problem.scene(), "robot_state:\n", kBaseState);
  const auto scene = problem.read().scene;
  EXPECT_EQ(scene->robots.front().model->variable_count(), 3) << "the group does not name it";
  EXPECT_TRUE(scene->robots.front().X_WB.translation().isApprox(Eigen::Vector3d(0, 3, 0)));
}

TEST(MoveitProblem, MovesTheBaseOfAGroupThatNamesIt) {
  const SmallProblem problem;
  const auto srdf = problem.folder() / "robots" / "crane.srdf";
  problem.replace(srdf, "<group name=\"crane_arm\">",
                  std::string(kVirtualJoint) + "<joint name=\"world_joint\"/>");
  problem.replace(problem.scene(), "robot_state:\n", kBaseState);
  problem.replace(problem.request(), "goal_constraints:\n",
                  "workspace_parameters: {min_corner: [-1, -1, -1], max_corner: [1, 4, 1]}\n"
                  "goal_constraints:\n");
  EXPECT_THAT(problem.refusal(), HasSubstr("world_joint/x")) << "the goal says nothing of it";
  problem.replace(problem.request(), "      - {joint_name: reach, position: 0.1}\n",
                  "      - {joint_name: reach, position: 0.1}\n"
                  "      - {joint_name: world_joint/x, position: -0.5}\n"
                  "      - {joint_name: world_joint/y, position: 1}\n"
                  "      - {joint_name: world_joint/theta, position: 0}\n");
  const auto scene = problem.read().scene;
  const geometric::RobotModel& model = *scene->robots.front().model;
  ASSERT_EQ(model.variable_count(), 6);
  EXPECT_NEAR((*scene->start)[1], 3.0, 1e-12);
  EXPECT_NEAR((*scene->start)[2], std::numbers::pi / 2, 1e-6);
  EXPECT_EQ((*scene->goal)[0], -0.5);
  EXPECT_EQ(model.lower()[1], -1.0);
  EXPECT_EQ(model.upper()[1], 4.0);
}

TEST(MoveitProblem, ReadsPosesOfFloatingBases) {
  const SmallProblem problem;
  const auto srdf = problem.folder() / "robots" / "crane.srdf";
  std::string floating = kVirtualJoint;
  floating.replace(floating.find("planar"), 6, "floating");
  problem.replace(srdf, "<group name=\"crane_arm\">", floating + "<joint name=\"world_joint\"/>");
  problem.replace(problem.scene(), "robot_state:\n", kBaseState);
  problem.replace(problem.request(), "      - {joint_name: reach, position: 0.1}\n",
                  "      - {joint_name: reach, position: 0.1}\n"
                  "      - {joint_name: world_joint/trans_x, position: -0.5}\n"
                  "      - {joint_name: world_joint/trans_y, position: 1}\n"
                  "      - {joint_name: world_joint/trans_z, position: 0.25}\n"
                  "      - {joint_name: world_joint/rot_x, position: 0}\n"
                  "      - {joint_name: world_joint/rot_y, position: 0.38268343}\n"
                  "      - {joint_name: world_joint/rot_z, position: 0}\n"
                  "      - {joint_name: world_joint/rot_w, position: 0.92387953}\n");
  const auto scene = problem.read().scene;
  const geometric::RobotModel& model = *scene->robots.front().model;
  ASSERT_EQ(model.variable_count(), 9);
  const auto goal = [&](const char* joint) {
    return (*scene->goal)[model.find_variable(joint).value()];
  };
  EXPECT_EQ(goal("world_joint/trans_z"), 0.25);
  EXPECT_NEAR(goal("world_joint/pitch"), std::numbers::pi / 4.0, 1e-6);
  EXPECT_NEAR(goal("world_joint/yaw"), 0.0, 1e-6);
  EXPECT_NEAR((*scene->start)[model.find_variable("world_joint/yaw").value()],
              std::numbers::pi / 2.0, 1e-6)
      << "of the state";
  EXPECT_THAT(scene->warnings, testing::Not(testing::Contains(HasSubstr("rot_"))));
}

TEST(MoveitProblem, HasTheObjectsOfItsWorld) {
  const SmallProblem problem;
  const auto scene = problem.read().scene;
  ASSERT_EQ(scene->objects.size(), 5U);
  const auto* table = geometric::find_object(*scene, "table");
  ASSERT_TRUE(table);
  EXPECT_TRUE(std::get<geometric::Box>(table->shape).size.isApprox(Eigen::Vector3d(2, 2, 0.1)));
  EXPECT_NEAR(table->X_PO.translation().z(), -0.08, 1e-12) << "in the frame \"room\"";
  const auto* pillar = geometric::find_object(*scene, "pillar");
  ASSERT_TRUE(pillar);
  EXPECT_EQ(std::get<geometric::Cylinder>(pillar->shape).length, 0.4);
  EXPECT_EQ(std::get<geometric::Cylinder>(pillar->shape).radius, 0.05);
  EXPECT_TRUE(pillar->X_PO.translation().isApprox(Eigen::Vector3d(0.5, 0, 0.25)));
  const auto* cone = geometric::find_object(*scene, "pillar_2");
  ASSERT_TRUE(cone);
  EXPECT_EQ(std::get<geometric::Cone>(cone->shape).length, 0.1);
  const auto* wedge = geometric::find_object(*scene, "wedge");
  ASSERT_TRUE(wedge);
  EXPECT_EQ(std::get<geometric::Mesh>(wedge->shape).triangles->triangles.size(), 4U);
}

TEST(MoveitProblem, PutsFramesIntoEachOtherInAnyOrder) {
  const SmallProblem problem;
  problem.replace(problem.scene(), "  - child_frame_id: room\n",
                  "  - child_frame_id: /room\n    header: {frame_id: hall}\n");
  problem.replace(problem.scene(), "world:\n",
                  "  - child_frame_id: hall\n    header: {frame_id: odom}\n"
                  "    transform: {translation: {x: 1, y: 0, z: 0}, rotation: {w: 1}}\n"
                  "world:\n");
  const auto scene = problem.read().scene;
  const auto* table = geometric::find_object(*scene, "table");
  ASSERT_TRUE(table);
  EXPECT_TRUE(table->X_PO.translation().isApprox(Eigen::Vector3d(1, 0, -0.08), 1e-12));
}

TEST(MoveitProblem, TakesOrientationsAsMoveitDoes) {
  const SmallProblem problem;
  problem.replace(problem.scene(), "orientation: {x: 0, y: 0, z: 0, w: 1}",
                  "orientation: {x: 0, y: 0, z: 0, w: 0}");
  problem.replace(problem.scene(), "position: [-0.6, 0, 0.2], orientation: [0, 0, 0, 1]",
                  "position: [-0.6, 0, 0.2], orientation: [0, 0, 2, 2]");
  const auto scene = problem.read().scene;
  const auto* table = geometric::find_object(*scene, "table");
  const auto* wedge = geometric::find_object(*scene, "wedge");
  ASSERT_TRUE(table && wedge);
  EXPECT_TRUE(table->X_PO.linear().isIdentity(1e-12));
  EXPECT_TRUE(wedge->X_PO.linear().col(0).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_THAT(scene->warnings, testing::Contains(HasSubstr("taken for the identity")));
  EXPECT_THAT(scene->warnings, testing::Contains(HasSubstr("are normalised")));
}

// The objects of a scene after a further message about one, at the end of its world.
std::shared_ptr<const Scene> after_message(const std::string& message) {
  const SmallProblem problem;
  problem.replace(problem.scene(), "    - id: wedge\n", message + "    - id: wedge\n");
  return problem.read().scene;
}

TEST(MoveitProblem, RemovesObjectsHoweverTheOperationIsSpelled) {
  for (const char* spelling : {"1", "REMOVE", "remove", R"("\x01")", R"("\u0001")", "!!binary AQ==",
                               "CollisionObject.REMOVE", "0x01", "[1]", R"("b'\\x01'")"}) {
    const auto scene =
        after_message(fmt::format("    - {{id: pillar, operation: {}}}\n", spelling));
    EXPECT_FALSE(geometric::find_object(*scene, "pillar")) << spelling;
    EXPECT_FALSE(geometric::find_object(*scene, "pillar_2")) << spelling;
    EXPECT_TRUE(geometric::find_object(*scene, "table")) << spelling;
  }
  for (const char* spelling : {"0", R"("\0")", "!!binary AA==", "ADD", "\"\""}) {
    const auto scene =
        after_message(fmt::format("    - {{id: ball, primitives: [{{type: 2, dimensions: [0.1]}}], "
                                  "operation: {}}}\n",
                                  spelling));
    EXPECT_TRUE(geometric::find_object(*scene, "ball")) << spelling;
  }
}

TEST(MoveitProblem, IgnoresSizesBehindThoseOfAPrimitive) {
  const auto scene =
      after_message("    - {id: ball, primitives: [{type: 2, dimensions: [0.1, 0, 0]}]}\n");
  const auto* ball = geometric::find_object(*scene, "ball");
  ASSERT_TRUE(ball);
  EXPECT_EQ(std::get<geometric::Sphere>(ball->shape).radius, 0.1);
}

TEST(MoveitProblem, RemovesAllObjectsWhereNoneIsNamed) {
  const auto scene = after_message("    - {id: '', operation: 1}\n");
  EXPECT_FALSE(geometric::find_object(*scene, "table"));
  EXPECT_TRUE(geometric::find_object(*scene, "wedge")) << "added later";
  EXPECT_TRUE(geometric::find_object(*scene, "parcel")) << "carried";
}

TEST(MoveitProblem, AppendsMovesAndReplaces) {
  const auto more = after_message(
      "    - {id: table, operation: 2, primitives: [{type: 2, dimensions: [0.1]}], "
      "primitive_poses: [{position: [0, 0, 1]}]}\n");
  const auto* ball = geometric::find_object(*more, "table_2");
  ASSERT_TRUE(ball && geometric::find_object(*more, "table"));
  EXPECT_TRUE(ball->X_PO.translation().isApprox(Eigen::Vector3d(0, 0, 1)));

  const auto moved =
      after_message("    - {id: pillar, operation: 3, pose: {position: [0, 1, 0]}}\n");
  const auto* pillar = geometric::find_object(*moved, "pillar");
  const auto* cone = geometric::find_object(*moved, "pillar_2");
  ASSERT_TRUE(pillar && cone);
  EXPECT_TRUE(pillar->X_PO.translation().isApprox(Eigen::Vector3d(0, 1, 0.25)));
  EXPECT_TRUE(cone->X_PO.translation().isApprox(Eigen::Vector3d(0, 1, 0.5)));

  const auto again = after_message(
      "    - {id: pillar, operation: 0, primitives: [{type: 2, dimensions: [0.1]}]}\n");
  EXPECT_TRUE(geometric::find_object(*again, "pillar"));
  EXPECT_FALSE(geometric::find_object(*again, "pillar_2"));
  EXPECT_THAT(again->warnings, testing::Contains(HasSubstr("replaces the first")));

  const auto none = after_message("    - {id: nobody, operation: 3}\n");
  EXPECT_THAT(none->warnings, testing::Contains(HasSubstr("no object \"nobody\" to move")));
  EXPECT_THAT(after_message("    - {id: nobody, operation: 1}\n")->warnings,
              testing::Not(testing::Contains(HasSubstr("nobody"))))
      << "it is not there, as was asked for";
}

TEST(MoveitProblem, PutsObjectsIntoTheFramesOfOthersAndTheirSubframes) {
  const auto position = [](const Scene& scene, const char* name) -> Eigen::Vector3d {
    const auto* object = geometric::find_object(scene, name);
    EXPECT_TRUE(object) << name;
    return object ? Eigen::Vector3d(object->X_PO.translation()) : Eigen::Vector3d::Zero().eval();
  };
  const std::string ball = "primitives: [{type: 2, dimensions: [0.01]}]";
  const auto on_pillar = after_message(
      "    - {id: cup, header: {frame_id: pillar}, pose: {position: [0, 0.2, 0]}, " + ball + "}\n" +
      "    - {id: pillar, operation: 3, header: {frame_id: pillar}, "
      "pose: {position: [0, 0.1, 0]}}\n");
  EXPECT_TRUE(position(*on_pillar, "cup").isApprox(Eigen::Vector3d(0.5, 0.2, 0), 1e-9));
  EXPECT_TRUE(position(*on_pillar, "pillar").isApprox(Eigen::Vector3d(0.5, 0.1, 0.25), 1e-9));

  const std::string rack =
      "    - {id: rack, header: {frame_id: room}, pose: {position: [0, 1, 0], "
      "orientation: [0, 0, 0.70710678, 0.70710678]}, " +
      ball + ", subframe_names: [top], subframe_poses: [{position: [0.1, 0, 0.3]}]}\n";
  const auto in_rack =
      after_message(rack +
                    "    - {id: cup, header: {frame_id: rack/top}, pose: {position: [0.1, "
                    "0, 0]}, " +
                    ball + "}\n");
  EXPECT_TRUE(position(*in_rack, "cup").isApprox(Eigen::Vector3d(0, 1.2, 0.2), 1e-6))
      << "the rack is turned by a right angle, and the room is at -0.1";
  EXPECT_THAT(
      test::refusal_of([&] {
        after_message(rack + "    - {id: cup, header: {frame_id: rack/side}, " + ball + "}\n");
      }),
      HasSubstr("found the frame \"rack/side\""));
}

TEST(MoveitProblem, AttachesAndDetachesObjectsOfTheWorld) {
  const SmallProblem problem;
  problem.replace(problem.scene(), "  attached_collision_objects:\n",
                  "  attached_collision_objects:\n    - {link_name: tower, object: {id: wedge}}\n");
  const auto taken = problem.read().scene;
  const auto* wedge = geometric::find_object(*taken, "wedge");
  ASSERT_TRUE(wedge && wedge->attachment);
  EXPECT_EQ(wedge->attachment->link, "tower");
  EXPECT_TRUE((Eigen::AngleAxisd(-0.8, Eigen::Vector3d::UnitZ()) * wedge->X_PO.translation())
                  .isApprox(Eigen::Vector3d(-0.6, 0, 0.2), 1e-9))
      << "where it was in the world, on the tower that is turned by -0.8";

  problem.replace(
      problem.request(), "start_state:\n",
      "start_state:\n  is_diff: true\n  attached_collision_objects: [{link_name: slide, "
      "object: {id: parcel, operation: 1}}]\n");
  const auto dropped = problem.read().scene;
  const auto* parcel = geometric::find_object(*dropped, "parcel");
  ASSERT_TRUE(parcel);
  EXPECT_FALSE(parcel->attachment);
  EXPECT_NEAR(parcel->X_PO.translation().z(), 0.45 - 0.54 * std::sin(0.05), 1e-9)
      << "where it was, in the world";
}

TEST(MoveitProblem, CarriesWhatIsAttached) {
  const SmallProblem problem;
  const auto scene = problem.read().scene;
  const auto* parcel = geometric::find_object(*scene, "parcel");
  ASSERT_TRUE(parcel && parcel->attachment);
  EXPECT_EQ(parcel->attachment->link, "slide");
  EXPECT_THAT(parcel->attachment->touching, ElementsAre("finger", "finger_2"));
  EXPECT_TRUE(parcel->X_PO.translation().isApprox(Eigen::Vector3d(0.24, 0, 0)));
}

TEST(MoveitProblem, ReadsMeshesBesideIt) {
  const SmallProblem problem;
  std::ofstream(problem.folder() / "brick.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  problem.replace(problem.scene(), "    - id: wedge\n",
                  "    - id: brick\n      meshes:\n        - {resource: "
                  "\"package://things/brick.obj\", dimensions: [0.1, 0.1, 0.1]}\n      "
                  "mesh_poses: [{position: [0, 0.8, 0.4]}]\n    - id: wedge\n");
  const auto scene = problem.read().scene;
  const auto* brick = geometric::find_object(*scene, "brick");
  ASSERT_TRUE(brick);
  EXPECT_EQ(std::get<geometric::Mesh>(brick->shape).file.filename(), "brick.obj");
}

TEST(MoveitProblem, IsASceneWithoutARequestToo) {
  const SmallProblem problem;
  std::filesystem::remove(problem.request());
  const auto scene = MoveitImporter().read(problem.scene()).scene;
  EXPECT_FALSE(scene->start || scene->goal);
  EXPECT_EQ(scene->robots.front().model->variable_count(), 4);
  EXPECT_EQ(scene->name, "pillar");
}

TEST(MoveitProblem, TakesARobotThatShips) {
  const SmallProblem problem;
  problem.replace(problem.scene(), "robot_model_name: crane", "robot_model_name: tx90");
  problem.replace(problem.scene(), "[turn, lift, reach, grip, grip_2]", "[]");
  problem.replace(problem.scene(), "[0, 0, 0, 0.01, 0.01]", "[]");
  problem.replace(problem.scene(), "  attached_collision_objects:", "  is_diff: false\n  ignored:");
  std::filesystem::remove(problem.request());
  EXPECT_EQ(MoveitImporter().read(problem.scene()).scene->robots.front().model->name(), "tx90");
}

// Pairs of names that are checked, those of padded bodies among them.
std::set<std::pair<std::string, std::string>> checked_pairs(const Scene& scene) {
  const geometric::CollisionWorld world(scene);
  std::set<std::pair<std::string, std::string>> names;
  for (const auto& [a, b] : world.pairs()) {
    names.insert(std::minmax(world.body(a).name, world.body(b).name));
  }
  return names;
}

TEST(MoveitProblem, TakesTheMatrixOfTheSceneForThatOfTheRobot) {
  const SmallProblem problem;
  problem.replace(problem.scene(), "name: pillar\n", R"(name: pillar
allowed_collision_matrix:
  entry_names: [tower, boom, slide, finger, pillar]
  entry_values:
    - {enabled: [False, True, False, False, False]}
    - {enabled: [True, False, True, False, False]}
    - [false, true, false, true, true]
    - [false, false, true, false, false]
    - [false, false, true, false, false]
  default_entry_names: [parcel, table]
  default_entry_values: [true, false]
)");
  const auto scene = problem.read().scene;
  const auto pairs = checked_pairs(*scene);
  EXPECT_FALSE(pairs.contains({"boom", "slide"})) << "allowed by both";
  EXPECT_TRUE(pairs.contains({"slide", "tower"})) << "allowed by the SRDF, not by the matrix";
  EXPECT_FALSE(pairs.contains({"pillar", "slide"}));
  EXPECT_FALSE(pairs.contains({"pillar_2", "slide"})) << "every shape of the object";
  EXPECT_TRUE(pairs.contains({"boom", "pillar"}));
  EXPECT_FALSE(pairs.contains({"parcel", "tower"})) << "allowed by default";
  EXPECT_TRUE(pairs.contains({"parcel", "table"})) << "the other's default forbids it";
  EXPECT_FALSE(pairs.contains({"finger", "parcel"})) << "a touch link";

  const auto saved = problem.folder() / "saved.yaml";
  geometric::write_scene(*scene, saved);
  EXPECT_EQ(geometric::read_scene(saved).allowed_collisions, scene->allowed_collisions);
}

TEST(MoveitProblem, KeepsThePairsOfTheSrdfForLinksThatTheMatrixDoesNotName) {
  const SmallProblem problem;
  problem.replace(problem.scene(), "name: pillar\n", R"(name: pillar
allowed_collision_matrix:
  entry_names: [tower, boom]
  entry_values: [[false, true], [true, false]]
)");
  const auto scene = problem.read().scene;
  const auto pairs = checked_pairs(*scene);
  EXPECT_FALSE(pairs.contains({"finger", "slide"}));
  EXPECT_FALSE(pairs.contains({"slide", "tower"})) << "allowed by the SRDF, slide is not named";
  EXPECT_TRUE(pairs.contains({"boom", "finger"}));
  EXPECT_THAT(scene->warnings, testing::Contains(testing::AllOf(
                                   HasSubstr("the allowed-collision matrix does not name"),
                                   HasSubstr("of crane"), HasSubstr("slide"))));
}

TEST(MoveitProblem, PadsLinksTowardsObjectsAlone) {
  const SmallProblem problem;
  const auto clearances = [&] {
    const auto scene = problem.read().scene;
    auto checker = geometric::make_collision_checker(
        std::make_shared<const geometric::CollisionWorld>(*scene));
    checker->place(Eigen::Vector3d(0.0, 0.0, 0.0));
    std::map<std::pair<std::string, std::string>, double> found;
    for (int pair = 0; pair < static_cast<int>(checker->world().pairs().size()); ++pair) {
      const geometric::NamedPair named =
          geometric::named_pair(checker->world(), pair, checker->pair_distance(pair, 10.0));
      found[std::minmax(named.a, named.b)] = named.distance;
    }
    return found;
  };
  const auto before = clearances();
  problem.replace(problem.scene(), "name: pillar\n",
                  "name: pillar\nlink_padding: [{link_name: boom, padding: 0.01}, "
                  "{link_name: slide, padding: 0.005}, {link_name: claw, padding: 0.1}]\n"
                  "link_scale: [{link_name: boom, scale: 1.5}]\n");
  const auto after = clearances();
  EXPECT_EQ(before.size(), after.size());
  EXPECT_NEAR(before.at({"boom", "table"}) - after.at({"boom", "table"}), 0.02, 1e-9)
      << "half of 4 cm more, and the padding";
  EXPECT_NEAR(before.at({"parcel", "table"}) - after.at({"parcel", "table"}), 0.005, 1e-4)
      << "what the link carries";
  EXPECT_NEAR(before.at({"boom", "finger"}), after.at({"boom", "finger"}), 1e-9);
  const auto scene = problem.read().scene;
  EXPECT_THAT(scene->warnings, testing::Contains(HasSubstr("claw")));
  const auto saved = problem.folder() / "saved.yaml";
  geometric::write_scene(*scene, saved);
  EXPECT_EQ(geometric::read_scene(saved).robots.front().padding, scene->robots.front().padding);
}

TEST(MoveitProblem, HasPlanesAsHalfSpaces) {
  const SmallProblem problem;
  problem.replace(problem.scene(), "      meshes:\n",
                  "      planes: [{coef: [0, 0, 2, 0.2]}, [-1, 0, 0, 5]]\n"
                  "      plane_poses: [{}, {position: [1, 0, 0]}]\n      meshes:\n");
  const auto scene = problem.read().scene;
  const auto* floor = geometric::find_object(*scene, "wedge_2");
  const auto* wall = geometric::find_object(*scene, "wedge_3");
  ASSERT_TRUE(floor && wall);
  const double side = std::get<geometric::Box>(floor->shape).size.z();
  EXPECT_GT(side, 4.0) << "as far as the crane reaches, each way";
  EXPECT_NEAR(floor->X_PO.translation().z() + 0.5 * side, -0.1, 1e-9);
  EXPECT_NEAR(wall->X_PO.translation().x() - 0.5 * side, 6.0, 1e-9) << "behind, seen from the base";
}

TEST(MoveitProblem, MovesPlanesWithTheirHalfSpaces) {
  const auto top_of_hall = [](const std::string& move) {
    const auto scene = after_message("    - {id: hall, planes: [[0, 0, 1, 0.2]]}\n" + move);
    const auto* hall = geometric::find_object(*scene, "hall");
    EXPECT_TRUE(hall);
    return hall->X_PO.translation().z() + 0.5 * std::get<geometric::Box>(hall->shape).size.z();
  };
  EXPECT_NEAR(top_of_hall(""), -0.2, 1e-9);
  EXPECT_NEAR(top_of_hall("    - {id: hall, operation: 3, pose: {position: [3, 0, -1]}}\n"), -1.2,
              1e-9);
  EXPECT_NEAR(
      top_of_hall("    - {id: hall, operation: 3, plane_poses: [{position: [0, 0, -0.5]}]}\n"),
      -0.7, 1e-9);
}

std::string message_of(const octomap::OcTree& tree, bool binary) {
  std::stringstream bytes;
  if (binary) {
    tree.writeBinaryData(bytes);
  } else {
    tree.writeData(bytes);
  }
  std::string list;
  for (const char byte : bytes.str()) {
    list += fmt::format("{}{}", list.empty() ? "" : ", ", static_cast<int>(byte));
  }
  return fmt::format(
      "  octomap:\n    header: {{frame_id: room}}\n    origin: {{position: {{x: 1}}}}\n"
      "    octomap: {{binary: {}, id: OcTree, resolution: {}, data: [{}]}}\n"
      "  collision_objects:\n    - id: table",
      binary ? "True" : "False", tree.getResolution(), list);
}

TEST(MoveitProblem, HasOctomapsAsTheirOccupiedCells) {
  octomap::OcTree tree(0.05);
  for (const auto& [x, y, z] : {std::tuple(0.0, 0.0, 0.0), std::tuple(0.05, 0.0, 0.0),
                                std::tuple(0.05, 0.05, 0.0), std::tuple(-0.3, 0.2, 0.1)}) {
    tree.updateNode(octomap::point3d(static_cast<float>(x + 0.025), static_cast<float>(y + 0.025),
                                     static_cast<float>(z + 0.025)),
                    true);
  }
  tree.updateNode(octomap::point3d(0.525F, 0.0F, 0.0F), false);
  for (const bool binary : {true, false}) {
    const SmallProblem problem;
    problem.replace(problem.scene(), "  collision_objects:\n    - id: table",
                    message_of(tree, binary));
    const auto scene = problem.read().scene;
    const auto* map = geometric::find_object(*scene, "octomap");
    ASSERT_TRUE(map);
    EXPECT_TRUE(map->X_PO.translation().isApprox(Eigen::Vector3d(1.0, 0.0, -0.1)));
    EXPECT_TRUE(geometric::is_closed(map->shape)) << "nothing can be inside";
    const auto& mesh = *std::get<geometric::Mesh>(map->shape).triangles;
    EXPECT_EQ(mesh.triangles.size(), 2U * (14U + 6U)) << "three cells in a corner, and one";
    const geometric::Aabb box = geometric::bounding_box(mesh);
    EXPECT_TRUE(box.lower.isApprox(Eigen::Vector3d(-0.3, 0.0, 0.0), 1e-9));
    EXPECT_TRUE(box.upper.isApprox(Eigen::Vector3d(0.1, 0.25, 0.15), 1e-9));
  }
}

TEST(MoveitProblem, JoinsWhatAnOctomapHasPruned) {
  octomap::OcTree tree(0.1);
  for (int cell = 0; cell < 64; ++cell) {
    tree.updateNode(octomap::point3d(0.05F + 0.1F * static_cast<float>(cell % 4),
                                     0.05F + 0.1F * static_cast<float>(cell / 4 % 4),
                                     0.05F + 0.1F * static_cast<float>(cell / 16)),
                    true);
  }
  tree.updateNode(octomap::point3d(0.45F, 0.05F, 0.05F), true);
  tree.toMaxLikelihood();
  tree.prune();
  const SmallProblem problem;
  problem.replace(problem.scene(), "  collision_objects:\n    - id: table", message_of(tree, true));
  const auto scene = problem.read().scene;
  const auto& shape = geometric::find_object(*scene, "octomap")->shape;
  EXPECT_TRUE(geometric::is_closed(shape));
  const auto& mesh = *std::get<geometric::Mesh>(shape).triangles;
  EXPECT_EQ(mesh.triangles.size(), 2U * (6U * 16U + 4U));
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6.0;
  }
  EXPECT_NEAR(volume, 0.065, 1e-9) << "wound outwards";
}

TEST(MoveitProblem, TakesTheRobotThatTheEnvironmentNames) {
  const SmallProblem problem;
  const auto elsewhere = problem.folder() / "elsewhere";
  std::filesystem::rename(problem.folder() / "robots", elsewhere);
  EXPECT_THAT(problem.refusal(), HasSubstr("--robot"));
  ::setenv("HANDWAY_ROBOT", (elsewhere / "crane.urdf").c_str(), 1);
  EXPECT_EQ(problem.read().scene->robots.front().model->name(), "crane");
  ::setenv("HANDWAY_ROBOT", (elsewhere / "kran.urdf").c_str(), 1);
  EXPECT_THAT(problem.refusal(), HasSubstr("kran.urdf"));
  ::unsetenv("HANDWAY_ROBOT");
}

TEST(MoveitProblem, PassesOverWhatTheRobotHasNotAndTellsOnce) {
  const SmallProblem problem;
  problem.replace(problem.request(), "name: [turn, lift], position: [-0.8, 0.05]",
                  "name: [turn, wrist, claw], position: [-0.8, 1, 2]");
  problem.replace(
      problem.request(), "      - {joint_name: reach, position: 0.1}",
      "      - {joint_name: reach, position: 0.1}\n      - {joint_name: claw, position: 1}");
  problem.replace(problem.scene(), "touch_links: [finger, finger_2]",
                  "touch_links: [finger, finger_2, claw_tip]");
  const auto scene = problem.read().scene;
  EXPECT_EQ((*scene->start)[0], -0.8);
  EXPECT_THAT(scene->warnings,
              testing::Contains(AllOf(HasSubstr("crane has not"), HasSubstr("claw, wrist"))));
  EXPECT_THAT(scene->warnings, testing::Contains(HasSubstr("claw_tip")));
}

TEST(MoveitProblem, FindsMeshesWhoseNamesHaveOtherLetters) {
  const SmallProblem problem;
  std::ofstream(problem.folder() / "Brick.OBJ")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  problem.replace(problem.scene(), "    - id: wedge\n",
                  "    - id: brick\n      meshes: [{resource: \"package://things/brick.obj\"}]\n"
                  "      pose: {position: [0, 0.8, 0.4]}\n    - id: wedge\n");
  EXPECT_THAT(problem.read().scene->warnings, testing::Contains(HasSubstr("Brick.OBJ")));
}

constexpr const char* kJointGoal = R"(  - joint_constraints:
      - {joint_name: turn, position: 0.8, tolerance_above: 0.001, tolerance_below: 0.001, weight: 1}
      - {joint_name: lift, position: 0.05}
      - {joint_name: reach, position: 0.1}
)";

constexpr const char* kPoseGoal = R"(  - position_constraints:
      - header: {frame_id: room}
        link_name: slide
        target_point_offset: [0.2, 0, 0]
        constraint_region:
          primitives: [{type: 2, dimensions: [0.02]}, {type: box, dimensions: [0.02, 0.04, 0.06]}]
          primitive_poses:
            - {position: [0.3, 0.4, 0.6], orientation: [0, 0, 0, 1]}
            - {position: [0.3, 0.45, 0.6], orientation: [0, 0, 0.70710678, 0.70710678]}
        weight: 1
    orientation_constraints:
      - header: {frame_id: world}
        link_name: slide
        orientation: {z: 0.38268343, w: 0.92387953}
        absolute_x_axis_tolerance: 0.1
        absolute_y_axis_tolerance: 0.2
        absolute_z_axis_tolerance: 3.2
        weight: 1
)";

TEST(MoveitProblem, HasGoalsAsPosesOfALink) {
  const SmallProblem problem;
  problem.replace(problem.request(), kJointGoal, kPoseGoal);
  const auto scene = problem.read().scene;
  ASSERT_EQ(scene->goal_poses.size(), 2U) << "one for each primitive";
  const geometric::PoseGoal& ball = scene->goal_poses[0];
  EXPECT_EQ(ball.link, "slide");
  EXPECT_TRUE(ball.X_WG.isApprox(
      geometric::pose_from_rpy({0.3, 0.4, 0.5}, 0, 0, std::numbers::pi / 4), 1e-6))
      << "in the frame \"room\"";
  EXPECT_TRUE(ball.X_LT.translation().isApprox(Eigen::Vector3d(0.2, 0, 0)));
  EXPECT_NEAR(ball.position_tolerance.norm(), 0.02, 1e-9) << "inside of the ball";
  EXPECT_TRUE(ball.rotation_tolerance.isApprox(Eigen::Vector3d(0.1, 0.2, 3.2)));
  EXPECT_NEAR(scene->goal_poses[1].position_tolerance.norm(), 0.01, 1e-9) << "across the axes";
  const planning::PlanningProblem planned = planning::make_problem(scene, nullptr);
  ASSERT_FALSE(planned.goals.empty()) << planned.goal_fault;
  const planning::PlanResult result =
      planning::PlannerRegistry().create("auto")->plan(planned, {.time_limit_s = 60.0});
  ASSERT_TRUE(result.solved()) << result.reason;
  EXPECT_THAT(planning::check_path(planned, result.path, 0.001).faults, IsEmpty());
}

TEST(MoveitProblem, HasGoalsInTheFramesOfObjects) {
  const SmallProblem problem;
  std::string goal = kPoseGoal;
  goal.replace(goal.find("room"), 4, "pillar");
  problem.replace(problem.request(), kJointGoal, goal);
  const auto scene = problem.read().scene;
  ASSERT_EQ(scene->goal_poses.size(), 2U);
  EXPECT_TRUE(
      scene->goal_poses[0].X_WG.translation().isApprox(Eigen::Vector3d(0.8, 0.4, 0.6), 1e-9));
}

TEST(MoveitProblem, HasGoalsAndConstraintsOfWhatIsCarried) {
  const SmallProblem problem;
  problem.replace(problem.scene(), "        id: parcel\n",
                  "        id: parcel\n        pose: {position: [0.05, 0, 0], orientation: "
                  "[0, 0, 0.70710678, 0.70710678]}\n");
  std::string goal = kPoseGoal;
  for (std::size_t at = goal.find("slide"); at != std::string::npos; at = goal.find("slide")) {
    goal.replace(at, 5, "parcel");
  }
  problem.replace(problem.request(), kJointGoal,
                  goal +
                      "path_constraints:\n  orientation_constraints:\n    - {link_name: parcel, "
                      "orientation: {w: 1}, absolute_x_axis_tolerance: 3.14, "
                      "absolute_y_axis_tolerance: 0.3, absolute_z_axis_tolerance: 0.3}\n");
  const auto scene = problem.read().scene;
  ASSERT_EQ(scene->goal_poses.size(), 2U);
  EXPECT_EQ(scene->goal_poses[0].link, "slide");
  EXPECT_TRUE(scene->goal_poses[0].X_LT.isApprox(
      geometric::pose_from_rpy({0.05, 0.2, 0}, 0, 0, 0.5 * std::numbers::pi), 1e-6));
  ASSERT_EQ(scene->constraints.size(), 1U);
  EXPECT_EQ(scene->constraints[0].body, "slide");
  EXPECT_TRUE(std::get<geometric::OrientationConstraint>(scene->constraints[0].what)
                  .axis.isApprox(Eigen::Vector3d::UnitY(), 1e-6))
      << "the parcel's x axis";
}

TEST(MoveitProblem, LeavesWhatIsCarriedWhereItsLinkHoldsIt) {
  const SmallProblem problem;
  problem.replace(
      problem.request(), "start_state:\n",
      "start_state:\n  is_diff: true\n  attached_collision_objects: [{link_name: slide, "
      "object: {id: parcel, operation: 3, pose: {position: [1, 0, 0]}}}]\n");
  const auto scene = problem.read().scene;
  EXPECT_TRUE(geometric::find_object(*scene, "parcel")
                  ->X_PO.translation()
                  .isApprox(Eigen::Vector3d(0.24, 0, 0)));
  EXPECT_THAT(scene->warnings, testing::Contains(HasSubstr("attached objects can't be moved")));
}

TEST(MoveitProblem, KeepsTheAxesOfABoxWithoutAnOrientation) {
  const SmallProblem problem;
  std::string pose = kPoseGoal;
  pose.resize(pose.find("    orientation_constraints"));
  problem.replace(problem.request(), kJointGoal, pose);
  const auto scene = problem.read().scene;
  ASSERT_EQ(scene->goal_poses.size(), 2U);
  EXPECT_TRUE(scene->goal_poses[1].position_tolerance.isApprox(Eigen::Vector3d(0.01, 0.02, 0.03)));
  EXPECT_GE(scene->goal_poses[1].rotation_tolerance.minCoeff(), std::numbers::pi);
}

TEST(MoveitProblem, TakesTheGoalsThatHaveAPoseIfTheFirstHasOne) {
  const SmallProblem problem;
  problem.replace(problem.request(), kJointGoal, std::string(kPoseGoal) + kJointGoal);
  const auto scene = problem.read().scene;
  EXPECT_EQ(scene->goal_poses.size(), 2U);
  EXPECT_THAT(scene->warnings, testing::Contains(HasSubstr("only the first of 2 goals is used")));
}

TEST(MoveitProblem, RefusesPosesThatAreNone) {
  const auto refused = [](const char* from, const char* to) {
    const SmallProblem problem;
    std::string pose = kPoseGoal;
    pose.replace(pose.find(from), std::string(from).size(), to);
    problem.replace(problem.request(), kJointGoal, pose);
    return problem.refusal();
  };
  EXPECT_THAT(refused("link_name: slide", "link_name: boom"), HasSubstr("the link \"boom\""));
  EXPECT_THAT(refused("link_name: slide", "link_name: slid"), HasSubstr("Did you mean \"slide\"?"));
  EXPECT_THAT(refused("link_name: slide", "link_name: base"), HasSubstr("no joint of the group"));
  EXPECT_THAT(refused("primitives: [{type: 2,", "primitives: [{type: 4,"), HasSubstr("dimensions"));
  EXPECT_THAT(refused("tolerance: 0.1", "tolerance: -0.1"), HasSubstr("0 rad or more"));
  EXPECT_THAT(refused("frame_id: room", "frame_id: rom"), HasSubstr("the frame \"rom\""));
}

// Measures like moveit::kinematic_constraints::OrientationConstraint.
bool is_allowed(const Eigen::Matrix3d& R, const Eigen::Vector3d& tolerance, bool rotation_vector) {
  const Eigen::AngleAxisd turn(R);
  const Eigen::Vector3d off = rotation_vector
                                  ? Eigen::Vector3d(turn.angle() * turn.axis())
                                  : Eigen::Vector3d(std::atan2(-R(1, 2), R(2, 2)),
                                                    std::asin(std::clamp(R(0, 2), -1.0, 1.0)),
                                                    std::atan2(-R(0, 1), R(0, 0)));
  return (off.cwiseAbs().array() <= tolerance.array() + 1e-9).all();
}

struct TurnTolerance {
  const char* name;
  Eigen::Vector3d about;  ///< x, y and z, rad
  int parameterization;
};

class MoveitOrientations : public testing::TestWithParam<TurnTolerance> {};

TEST_P(MoveitOrientations, BecomeConesInsideOfWhatIsAllowed) {
  const auto& [name, tolerance, parameterization] = GetParam();
  const SmallProblem problem;
  problem.replace(problem.request(), "num_planning_attempts: 1",
                  fmt::format("path_constraints: {{orientation_constraints: [{{link_name: slide, "
                              "orientation: {{z: 0.6, w: 0.8}}, absolute_x_axis_tolerance: {}, "
                              "absolute_y_axis_tolerance: {}, absolute_z_axis_tolerance: {}, "
                              "parameterization: {}}}]}}",
                              tolerance.x(), tolerance.y(), tolerance.z(), parameterization));
  const auto scene = problem.read().scene;
  ASSERT_FALSE(scene->constraints.empty());
  const Eigen::Matrix3d R_WG = Eigen::Quaterniond(0.8, 0, 0, 0.6).toRotationMatrix();
  std::mt19937 draws(3);
  std::normal_distribution<> normal;
  int kept = 0;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d about(normal(draws), normal(draws), normal(draws));
    const double angle = std::numbers::pi * (i % 100) / 99.0;
    const Eigen::Matrix3d R = Eigen::AngleAxisd(angle, about.normalized()).toRotationMatrix();
    const bool keeps = std::ranges::all_of(scene->constraints, [&](const auto& one) {
      const auto& cone = std::get<geometric::OrientationConstraint>(one.what);
      return std::acos(std::clamp((R_WG * R * cone.axis).dot(cone.direction), -1.0, 1.0)) <=
             cone.angle;
    });
    kept += keeps ? 1 : 0;
    EXPECT_FALSE(keeps && !is_allowed(R, tolerance, parameterization == 1));
  }
  EXPECT_GT(kept, 100);
}

INSTANTIATE_TEST_SUITE_P(
    Tolerances, MoveitOrientations,
    testing::Values(TurnTolerance{"Upright", {0.2, 0.3, 6.3}, 0},
                    TurnTolerance{"FreeAboutX", {3.2, 0.3, 0.4}, 0},
                    TurnTolerance{"FreeAboutNothing", {0.3, 0.4, 0.9}, 0},
                    TurnTolerance{"WideAboutX", {2.5, 2.9, 2.0}, 0},
                    TurnTolerance{"UprightAsRotationVector", {0.5, 0.3, 6.3}, 1},
                    TurnTolerance{"FreeAboutYAsRotationVector", {0.5, 3.2, 0.6}, 1},
                    TurnTolerance{"FreeAboutNothingAsRotationVector", {0.3, 0.4, 0.9}, 1}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(MoveitProblem, KeepsItsPathConstraints) {
  const SmallProblem problem;
  problem.replace(problem.request(), "num_planning_attempts: 1", R"(path_constraints:
  orientation_constraints:
    - {header: {frame_id: world}, link_name: slide, orientation: {w: 1}, absolute_x_axis_tolerance: 0.3,
       absolute_y_axis_tolerance: 0.3, absolute_z_axis_tolerance: 3.14159, weight: 1}
  position_constraints:
    - header: {frame_id: room}
      link_name: slide
      target_point_offset: {x: 0.2}
      constraint_region:
        primitives: [{type: box, dimensions: [2, 2, 0.5]}]
        primitive_poses: [{position: [0, 0, 0.5], orientation: [0, 0, 0, 1]}]
      weight: 1)");
  const auto scene = problem.read().scene;
  ASSERT_EQ(scene->constraints.size(), 2U);
  EXPECT_EQ(scene->constraints[0].name, "orientation of slide");
  EXPECT_EQ(scene->constraints[0].body, "slide");
  EXPECT_EQ(std::get<geometric::OrientationConstraint>(scene->constraints[0].what),
            (geometric::OrientationConstraint{.angle = 0.3}));
  const auto& region = std::get<geometric::PositionConstraint>(scene->constraints[1].what);
  EXPECT_TRUE(region.X_WR.translation().isApprox(Eigen::Vector3d(0, 0, 0.4)));
  EXPECT_TRUE(region.size.isApprox(Eigen::Vector3d(2, 2, 0.5)));
  EXPECT_TRUE(region.point.isApprox(Eigen::Vector3d(0.2, 0, 0)));
  const planning::PlanningProblem planned = planning::make_problem(scene, nullptr);
  const planning::PlanResult result =
      planning::PlannerRegistry().create("auto")->plan(planned, {.time_limit_s = 60.0});
  ASSERT_TRUE(result.solved()) << result.reason;
  EXPECT_THAT(planning::check_path(planned, result.path, 0.001).faults, IsEmpty());
}

TEST(MoveitProblem, IsSolvedByPlannersOverAllJoints) {
  const SmallProblem small;
  const planning::SceneState loaded = small.read();
  const planning::PlanningProblem problem = planning::make_problem(loaded.scene, loaded.basis);
  planning::PlannerRegistry planners;
  planner_ompl::register_planners(planners);
  for (const char* name : {"rrt-connect", "ompl-rrt-connect", "ompl-prm"}) {
    const planning::PlanResult result =
        planners.create(name)->plan(problem, {.time_limit_s = 60.0});
    ASSERT_TRUE(result.solved()) << name << ": " << result.reason;
    EXPECT_GT(result.path.waypoints.size(), 2U) << "around the pillar";
    EXPECT_THAT(planning::check_path(problem, result.path, 0.001).faults, IsEmpty());
  }
}

}  // namespace
}  // namespace handway::import_moveit
