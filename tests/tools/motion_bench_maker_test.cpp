/// `handway bench --motionbenchmaker DIR`: sets of MoveIt problems, and paths of other planners.
#include "command_line.h"
#include "run_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace handway::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

constexpr const char* kArm = R"(<robot name="arm">
  <link name="base"/>
  <link name="upper">
    <collision><origin xyz="0.2 0 0"/><geometry><box size="0.4 0.04 0.04"/></geometry></collision>
  </link>
  <link name="lower">
    <collision><origin xyz="0.2 0 0"/><geometry><box size="0.4 0.04 0.04"/></geometry></collision>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" velocity="1" effort="1"/>
  </joint>
  <joint name="elbow" type="revolute">
    <parent link="upper"/><child link="lower"/><origin xyz="0.4 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-2.5" upper="2.5" velocity="1" effort="1"/>
  </joint>
</robot>
)";

std::string scene(const std::string& robot, double post) {
  return "robot_model_name: " + robot +
         "\nworld:\n  collision_objects:\n    - id: post\n"
         "      primitives: [{type: cylinder, dimensions: [0.3, 0.02]}]\n"
         "      primitive_poses: [{position: [" +
         std::to_string(post) + ", 0, 0], orientation: [0, 0, 0, 1]}]\n";
}

constexpr const char* kRequest =
    "start_state: {joint_state: {name: [shoulder, elbow], position: [-0.5, 0]}}\n"
    "goal_constraints:\n  - joint_constraints:\n"
    "      - {joint_name: shoulder, position: 0.5}\n      - {joint_name: elbow, position: 0}\n";

class MotionBenchMaker : public testing::Test {
 protected:
  MotionBenchMaker() {
    for (const char* folder : {"sets/robots", "sets/near_arm", "sets/far_arm"}) {
      fs::create_directories(line_.folder() / folder);
    }
    line_.write("sets/robots/arm.urdf", kArm);
    add("near_arm", "0001", "arm", 0.7);
    add("near_arm", "0002", "ghost", 0.7);
    add("near_arm", "0003", "ghost", 0.7);
    add("far_arm", "0001", "arm", 1.5);
  }
  void add(const std::string& set, const std::string& number, const std::string& robot,
           double post) const {
    line_.write("sets/" + set + "/scene" + number + ".yaml", scene(robot, post));
    line_.write("sets/" + set + "/request" + number + ".yaml", kRequest);
  }

  CommandLine line_;
};

TEST_F(MotionBenchMaker, RunsAllSetsAndNamesWhatCannotBeRead) {
  const Outcome run = line_.run(
      "bench --motionbenchmaker sets --planner rrt-connect --planner auto --check-paths --seeds 2");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("8 of 8 runs done, 8 solved"));
  EXPECT_THAT(run.err, AllOf(HasSubstr("near_arm/0002 and 1 more left out"),
                             HasSubstr("ghost.urdf"), Not(HasSubstr("near_arm/0003"))));
  EXPECT_THAT(line_.read("motionbenchmaker/report.md"),
              AllOf(HasSubstr("## By set"), HasSubstr("## By robot"), HasSubstr("## All problems"),
                    HasSubstr("near_arm/0002 and 1 more"), Not(HasSubstr("nan"))));
  EXPECT_THAT(line_.read("motionbenchmaker/groups.csv"),
              AllOf(HasSubstr("\nset,far_arm,rrt-connect,1,2,100.0,100.0,100.0,"),
                    HasSubstr("\nrobot,arm,auto,2,4,100.0,100.0,100.0,")));
  EXPECT_THAT(line_.read("motionbenchmaker/groups.md"), HasSubstr("| near_arm | auto | 1 | 2 |"));
  const Outcome again = line_.run(
      "bench --motionbenchmaker sets --planner rrt-connect --planner auto --check-paths --seeds 2 "
      "--resume");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(run_rows(line_.folder() / "motionbenchmaker" / "runs.sqlite"), SizeIs(8));
}

constexpr const char* kOneRun = "bench --motionbenchmaker sets --planner rrt-connect --out o ";

// The straight motion hits the near post; around the far one it is free.
TEST_F(MotionBenchMaker, ChecksPathsOfOtherPlanners) {
  line_.write("paths.csv",
              "planner,problem,time_s,elbow,shoulder\n"
              "straight,near_arm/0001,0.002,0,-0.5\nstraight,near_arm/0001,0.002,0,0.5\n"
              "straight,far_arm/0001,0.004,0,-0.5\nstraight,far_arm/0001,0.004,0,0.5\n"
              "straight,far_arm/0009,0.004,0,-0.5\n");
  const Outcome run = line_.run(std::string(kOneRun) + "--paths paths.csv");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("Paths of other planners: 2 checked, 1 valid"));
  EXPECT_THAT(run.err, HasSubstr("1 paths not checked, the first because: paths.csv:6: "));
  EXPECT_THAT(line_.read("o/other_paths.csv"),
              AllOf(HasSubstr("\nfar_arm/0001,straight,1,true,,0.004,2,1,"),
                    HasSubstr("\nnear_arm/0001,straight,1,false,"), HasSubstr("post")));
  EXPECT_THAT(line_.read("o/groups.csv"),
              AllOf(HasSubstr("\nset,far_arm,straight (its paths),1,1,100.0,100.0,100.0,4,"),
                    HasSubstr("\nset,near_arm,straight (its paths),1,1,100.0,0.0,0.0,2,")));
  EXPECT_THAT(line_.read("o/report.md"),
              HasSubstr("paths.csv:6: the campaign has no problem \"far_arm/0009\""));
}

TEST_F(MotionBenchMaker, ChecksAFolderOfPaths) {
  fs::create_directories(line_.folder() / "others/straight/far_arm");
  line_.write("others/straight/far_arm/0001.csv", "shoulder,elbow\n-0.5,0\n0.5,0\n");
  const Outcome run = line_.run(std::string(kOneRun) + "--paths others");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(line_.read("o/other_paths.csv"), HasSubstr("\nfar_arm/0001,straight,1,true,"));
}

TEST_F(MotionBenchMaker, RefusesFoldersAndPathsWithoutProblems) {
  fs::create_directories(line_.folder() / "empty");
  const Outcome empty = line_.run("bench --motionbenchmaker empty");
  EXPECT_EQ(empty.exit_code, 3);
  EXPECT_THAT(empty.err, AllOf(HasSubstr("no scene0001.yaml"), HasSubstr("request0001.yaml")));
  line_.write("paths.csv", "shoulder,elbow\n0,0\n");
  const Outcome unnamed = line_.run(std::string(kOneRun) + "--paths paths.csv");
  EXPECT_EQ(unnamed.exit_code, 3);
  EXPECT_THAT(unnamed.err, HasSubstr("no column \"problem\""));
  EXPECT_EQ(line_.run("bench open.yaml --motionbenchmaker sets").exit_code, 2);
  EXPECT_EQ(line_.run("bench open.yaml --paths paths.csv").exit_code, 2);
}

}  // namespace
}  // namespace handway::test
