/// Tests that errors in a MoveIt problem are reported with file, line, what was found and expected.
#include "small_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace handway::import_moveit {
namespace {

using testing::AllOf;
using testing::HasSubstr;

struct Breach {
  const char* name;
  bool in_scene;
  const char* from;
  const char* to;
  const char* place;
  const char* found;
  const char* expected;
};

class BrokenMoveitProblem : public testing::TestWithParam<Breach> {};

TEST_P(BrokenMoveitProblem, IsRefusedInWords) {
  const Breach& breach = GetParam();
  const SmallProblem problem;
  problem.replace(breach.in_scene ? problem.scene() : problem.request(), breach.from, breach.to);
  EXPECT_THAT(problem.refusal(),
              AllOf(HasSubstr(breach.place), HasSubstr(breach.found), HasSubstr(breach.expected)));
}

INSTANTIATE_TEST_SUITE_P(
    Files, BrokenMoveitProblem,
    testing::Values(
        Breach{"NoRobot", true, "robot_model_name: crane", "robot_model_name: kran",
               "scene0001.yaml:2", "the robot \"kran\"", "kran.urdf"},
        Breach{"NoGroup", false, "group_name: crane_arm", "group_name: crane_am",
               "request0001.yaml:1", "the group \"crane_am\"", "Did you mean \"crane_arm\"?"},
        Breach{"NoJoint", false, "joint_name: lift", "joint_name: left", "request0001.yaml:7",
               "no joint constraint for \"lift\"", "all joints of the group"},
        Breach{"MisspeltPoses", true, "      primitive_poses:\n        - position",
               "      primitive_pose:\n        - position", "scene0001.yaml:24",
               "the unknown key \"primitive_pose\"", "Did you mean \"primitive_poses\"?"},
        Breach{"MisspeltObjects", true, "collision_objects:\n    - id: table",
               "colision_objects:\n    - id: table", "scene0001.yaml:19", "colision_objects",
               "Did you mean \"collision_objects\"?"},
        Breach{"TooFewPositions", true, "[0, 0, 0, 0.01, 0.01]", "[0, 0, 0, 0.01]",
               "scene0001.yaml:6", "4 positions", "5, one for each name"},
        Breach{"UnknownFrame", true, "header: {frame_id: room}", "header: {frame_id: rom}",
               "scene0001.yaml:21", "the frame \"rom\"", "a link of the robot"},
        Breach{"UnknownShape", true, "type: 1,", "type: 7,", "scene0001.yaml:23", "\"7\"",
               "box (1), sphere (2)"},
        Breach{"FlatBox", true, "[2, 2, 0.1]", "[2, 2, 0]", "scene0001.yaml:23",
               "a size that is not above 0", "sizes in metres"},
        Breach{"TooManyPoses", true, "mesh_poses: [{", "mesh_poses: [{}, {", "scene0001.yaml:37",
               "2 poses", "1, one for each of meshes"},
        Breach{"UnknownOperation", true, "    - id: wedge\n",
               "    - id: wedge\n      operation: 7\n", "scene0001.yaml:34", "\"7\"",
               "ADD (0), REMOVE (1), APPEND (2) or MOVE (3)"},
        Breach{"QuaternionOfWords", true, "orientation: {x: 0, y: 0, z: 0, w: 1}",
               "orientation: {x: 0, y: none, z: 0, w: 1}", "scene0001.yaml:26", "\"none\"",
               "a finite number"},
        Breach{"NoSuchVertex", true, "[1, 2, 3]]", "[1, 2, 4]]", "scene0001.yaml:36",
               "the vertex 4", "one of the 4 vertices"},
        Breach{"NoLink", true, "link_name: slide", "link_name: hook", "scene0001.yaml:8",
               "the link \"hook\"", "a link of the robot"},
        Breach{"PlaneWithoutDirection", true, "      meshes:",
               "      planes: [{coef: [0, 0, 0, 1]}]\n      meshes:", "scene0001.yaml:34",
               "a plane without direction", "ax + by + cz + d = 0"},
        Breach{"RaggedMatrix", true, "name: pillar\n",
               "name: pillar\nallowed_collision_matrix: {entry_names: [boom, slide], "
               "entry_values: [[false, true], [true]]}\n",
               "scene0001.yaml:2", "1 value", "2, one for each name"},
        Breach{"NegativePadding", true, "name: pillar\n",
               "name: pillar\nlink_padding: [{link_name: boom, padding: -0.1}]\n",
               "scene0001.yaml:2", "-0.1", "0 m or more"},
        Breach{"NoOctomap", true, "  collision_objects:\n    - id: table",
               "  octomap: {octomap: {id: OcTree, binary: false, resolution: 0.1, data: [1]}}\n"
               "  collision_objects:\n    - id: table",
               "scene0001.yaml:19", "an octomap whose data can't be read", "OcTree"},
        Breach{"JointsAlongThePath", false, "num_planning_attempts: 1",
               "path_constraints: {joint_constraints: [{joint_name: turn}]}", "request0001.yaml:2",
               "constraints along the path that are not planned with",
               "position and orientation constraints"},
        Breach{"FreeAboutTwoAxes", false, "num_planning_attempts: 1",
               "path_constraints: {orientation_constraints: [{link_name: slide, orientation: "
               "{w: 1}, absolute_x_axis_tolerance: 0.1, absolute_y_axis_tolerance: 3.2, "
               "absolute_z_axis_tolerance: 3.2}]}",
               "request0001.yaml:2", "free about two axes", "about one"},
        Breach{"ExactAlongThePath", false, "num_planning_attempts: 1",
               "path_constraints: {orientation_constraints: [{link_name: slide, orientation: "
               "{w: 1}}]}",
               "request0001.yaml:2", "a tolerance of 0", "above 0 rad"},
        Breach{"FrameThatMoves", false, "num_planning_attempts: 1",
               "path_constraints: {orientation_constraints: [{header: {frame_id: boom}, "
               "link_name: slide, orientation: {w: 1}}]}",
               "request0001.yaml:2", "the frame of \"boom\", which moves", "stays where it is"},
        Breach{"FrameThatMovesOfRos1", false, "num_planning_attempts: 1",
               "path_constraints: {orientation_constraints: [{header: {frame_id: /boom}, "
               "link_name: slide, orientation: {w: 1}}]}",
               "request0001.yaml:2", "the frame of \"boom\", which moves", "stays where it is"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(BrokenMoveitProblems, ARequestNeedsItsScene) {
  const SmallProblem problem;
  std::filesystem::remove(problem.scene());
  EXPECT_THAT(problem.refusal(), AllOf(HasSubstr("request0001.yaml"), HasSubstr("scene0001.yaml")));
}

}  // namespace
}  // namespace handway::import_moveit
