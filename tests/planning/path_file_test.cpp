#include "handway/planning/paths/path_file.h"

#include "handway_test/input_errors.h"
#include "handway_test/paths.h"
#include "handway_test/planar_problems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <utility>

namespace handway::planning {
namespace {

namespace fs = std::filesystem;

using geometric::RobotModel;
using test::planar_configuration;
using test::refusal_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;

constexpr const char* kHeader = "time,shoulder,elbow,thumb,left,left_tip,right,right_tip\n";
constexpr const char* kRow = "0,0.1,0.2,0.3,0.4,0.2,0.6,0.3\n";

class PathCsv : public testing::Test {
 protected:
  [[nodiscard]] fs::path file(const std::string& text) const {
    const fs::path path = folder_.path() / "path.csv";
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  [[nodiscard]] Path read(const std::string& text) const { return read_path(model_, file(text)); }
  [[nodiscard]] std::string refusal(const std::string& text) const {
    return refusal_of([&] { static_cast<void>(read(text)); });
  }

  test::ScratchFolder folder_;
  RobotModel model_{test::planar_hand_arm()};
};

TEST_F(PathCsv, TakesOtherSeparators) {
  for (const char separator : {';', '\t', ' '}) {
    std::string text = std::string(kHeader) + kRow + "1,0.2,0.2,0.3,0.4,0.2,0.6,0.3\n";
    std::ranges::replace(text, ',', separator);
    EXPECT_EQ(read(text).waypoints.at(1)[0], 0.2) << separator;
  }
}

// A recording that keeps angles within ±π has these values.
TEST_F(PathCsv, TakesJointsWithoutEndsTheShortWayRound) {
  geometric::RobotDescription robot = test::planar_hand_arm();
  robot.joints.front().limits.lower = -std::numeric_limits<double>::infinity();
  robot.joints.front().limits.upper = std::numeric_limits<double>::infinity();
  const RobotModel model(std::move(robot));
  const std::string rest = ",0.2,0.3,0.4,0.2,0.6,0.3\n";
  const fs::path path = file(std::string(kHeader) + "0,3.05" + rest + "1,3.12" + rest + "2,-3.1" +
                             rest + "3,-3.02" + rest);
  JointsAtRest notes{model.neutral()};
  const Path read = read_path(model, path, &notes);
  EXPECT_NEAR(read.waypoints[3][0], 2.0 * std::numbers::pi - 3.02, 1e-12);
  EXPECT_THAT(notes.remark(path), HasSubstr("joint shoulder jumps by -356° after waypoint 2"));
}

TEST_F(PathCsv, ReadsJointTrajectories) {
  const std::string json =
      R"({"joint_names": ["elbow", "shoulder", "thumb", "left", "left_tip", "right"],
 "points": [{"positions": [0.2, 0.1, 0.3, 0.4, 0.2, 0.6], "time_from_start": {"secs": 0}},
            {"positions": [0.3, 0.1, 0.3, 0.4, 0.2, 0.6], "time_from_start": {"secs": 1}}]})";
  const std::string yaml = "trajectory:\n- joint_trajectory: " + json + "\n";
  for (const std::string& text : {json, yaml}) {
    const Path path = read(text);
    ASSERT_THAT(path.waypoints, SizeIs(2));
    EXPECT_EQ(path.waypoints[0], planar_configuration(0.1, 0.2, 0.3, 0.4, 0.6));
    EXPECT_EQ(path.waypoints[1], planar_configuration(0.1, 0.3, 0.3, 0.4, 0.6));
  }
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = json;
    text.replace(text.find(from), from.size(), to);
    return refusal(text);
  };
  EXPECT_THAT(changed("\"elbow\"", "\"elbwo\""),
              AllOf(HasSubstr("path.csv:1"), HasSubstr("elbwo"), HasSubstr("a joint of robot")));
  EXPECT_THAT(changed(", \"right\"]", "]"), HasSubstr("joint right 0 times"));
  EXPECT_THAT(changed("0.4, 0.2, 0.6]", "0.4, 0.3, 0.6]"),
              AllOf(HasSubstr("path.csv:2"), HasSubstr("as coupled to joint left")));
  EXPECT_THAT(changed("[0.2, 0.1", "[0.1"), HasSubstr("positions"));
}

TEST_F(PathCsv, PassesOverOtherJointsOfTrajectories) {
  JointsAtRest rest{planar_configuration(0, 0)};
  const Path path = read_path(model_,
                              file("joint_names: [head_pan, shoulder]\npoints:\n"
                                   "- positions: [7, 0.1]\n- positions: [8, 0.2]\n"),
                              &rest);
  EXPECT_EQ(path.waypoints.at(1), planar_configuration(0.2, 0));
  EXPECT_THAT(rest.passed_over, testing::ElementsAre("head_pan"));
  EXPECT_THAT(refusal("joint_names: [head_pan]\npoints:\n- positions: [7]\n"),
              AllOf(HasSubstr("head_pan"), HasSubstr("a joint of robot")));
}

TEST_F(PathCsv, RefusesSeveralTrajectories) {
  EXPECT_THAT(refusal("trajectory:\n- joint_trajectory: {joint_names: [elbow], points: []}\n"
                      "- joint_trajectory: {joint_names: [elbow], points: []}\n"),
              AllOf(HasSubstr("path.csv:2"), HasSubstr("2 trajectories"), HasSubstr("a file")));
}

TEST_F(PathCsv, ReadsBackTheSameBits) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> angle(0.0, 1.0);
  Path path;
  for (int i = 0; i < 100; ++i) {
    path.waypoints.push_back(planar_configuration(angle(random), angle(random), -angle(random),
                                                  angle(random) * 1e-12, std::sqrt(angle(random))));
  }
  write_path_csv(path, model_, folder_.path() / "path.csv");
  const Path again = read_path(model_, folder_.path() / "path.csv");
  ASSERT_EQ(again.waypoints.size(), path.waypoints.size());
  for (std::size_t i = 0; i < path.waypoints.size(); ++i) {
    EXPECT_EQ(again.waypoints[i], path.waypoints[i]) << i;  // no tolerance
  }
  EXPECT_EQ(to_csv(again, model_), to_csv(path, model_));
}

TEST_F(PathCsv, QuotesNamesWithSeparators) {
  geometric::RobotDescription robot = test::planar_hand_arm();
  robot.joints.front().name = "shoulder, left; upper";
  const RobotModel model(std::move(robot));
  const Path path{{planar_configuration(0.1, 0.2), planar_configuration(0.3, 0.2)}};
  write_path_csv(path, model, folder_.path() / "path.csv");
  EXPECT_EQ(read_path(model, folder_.path() / "path.csv").waypoints, path.waypoints);
}

TEST_F(PathCsv, NamesEveryMovingJoint) {
  const Path path{{planar_configuration(0, 0), planar_configuration(0.5, 0, 0, 0.4, 0)}};
  std::istringstream lines(to_csv(path, model_));
  std::string header;
  std::getline(lines, header);
  std::istringstream names(header);
  std::vector<std::string> columns;
  for (std::string name; std::getline(names, name, ',');) {
    columns.push_back(name);
  }
  EXPECT_EQ(columns.front(), "time");
  EXPECT_THAT(columns, testing::UnorderedElementsAre("time", "shoulder", "elbow", "thumb", "left",
                                                     "left_tip", "right", "right_tip"));
}

TEST_F(PathCsv, SpacesWaypointsByTheSlowestJoint) {
  geometric::RobotDescription robot = test::planar_hand_arm();
  robot.joints[0].limits.velocity = 0.5;  // the shoulder
  const RobotModel model(robot);
  const Path path{
      {planar_configuration(0, 0), planar_configuration(0.5, 0.6), planar_configuration(0.5, 0.9)}};
  std::istringstream lines(to_csv(path, model));
  std::vector<double> times;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    times.push_back(std::stod(line));
  }
  ASSERT_THAT(times, SizeIs(3));
  EXPECT_DOUBLE_EQ(times[0], 0.0);
  EXPECT_DOUBLE_EQ(times[1], 1.0);  // 0.5 rad at 0.5 rad/s
  EXPECT_DOUBLE_EQ(times[2], 1.3);  // 0.3 rad at 1 rad/s, having no limit
}

TEST(CsvTime, IsRoundedToNanosecondsAndAsShortAsPossible) {
  EXPECT_EQ(csv_time(9 * 0.004), "0.036");
  EXPECT_EQ(csv_time(0.1 + 0.2), "0.3");
  EXPECT_EQ(csv_time(1.0 / 3.0), "0.333333333");
  EXPECT_EQ(csv_time(0.0), "0");
  EXPECT_EQ(csv_time(3600.0), "3600");
}

TEST_F(PathCsv, TakesColumnsInAnyOrderAndWithoutCoupledJoints) {
  const Path path =
      read("elbow, right ,thumb,left,shoulder\r\n0.2,0.6,0.3,0.4,0.1\r\n\r\n0,0,0,0,1\r\n");
  ASSERT_THAT(path.waypoints, SizeIs(2));
  EXPECT_EQ(path.waypoints[0], planar_configuration(0.1, 0.2, 0.3, 0.4, 0.6));
  EXPECT_EQ(path.waypoints[1], planar_configuration(1, 0, 0, 0, 0));
}

TEST_F(PathCsv, NamesLineAndColumnOfWhatIsNoNumber) {
  for (const std::string bad : {"nan", "inf", "abc", "", "0.1.2", "1e999", "0,5"}) {
    const std::string cell = bad == "0,5" ? "\"0.5" : bad;
    EXPECT_THAT(refusal(std::string(kHeader) + kRow + "1,0.1," + bad + ",0.3,0.4,0.2,0.6,0.3\n"),
                HasSubstr("path.csv:3"))
        << bad;
  }
  EXPECT_THAT(refusal(std::string(kHeader) + kRow + "1,0.1,x2,0.3,0.4,0.2,0.6,0.3\n"),
              AllOf(HasSubstr("column elbow"), HasSubstr("\"x2\""), HasSubstr("a finite number")));
}

TEST_F(PathCsv, NamesTheLineOfARowOfAnotherLength) {
  EXPECT_THAT(
      refusal(std::string(kHeader) + kRow + "\n1,2,3\n"),
      AllOf(HasSubstr("path.csv:4"), HasSubstr("3 values"), HasSubstr("8 as in the header")));
  EXPECT_THAT(refusal(std::string(kHeader) + kRow + "0,0.1,0.2,0.3,0.4,0.2,0.6,0.3,\n"),
              HasSubstr("9 values"));
}

TEST_F(PathCsv, PassesOverColumnsThatAreNoJoint) {
  JointsAtRest rest{planar_configuration(0, 0)};
  const Path path = read_path(model_,
                              file("frame_index,wrist,shoulder,elbow,thumb,left,right,battery\n"
                                   "0,5,0.1,0,0,0,0,99\n1,5,0.2,0,0,0,0,98\n"),
                              &rest);
  EXPECT_EQ(path.waypoints.at(1)[0], 0.2);
  EXPECT_THAT(rest.remark("arm.csv"),
              HasSubstr("ignored names that no moving joint of the robot has: battery, "
                        "frame_index, wrist"));
}

TEST_F(PathCsv, RefusesColumnsThatAreSlips) {
  EXPECT_THAT(refusal("time,sholder,elbow,thumb,left,right\n0,0,0,0,0,0\n"),
              AllOf(HasSubstr("path.csv:1"), HasSubstr("\"sholder\""), HasSubstr("planar"),
                    HasSubstr("Did you mean \"shoulder\"?")));
  EXPECT_THAT(refusal("time,j1,j2\n0,0,0\n1,0,0\n"),
              AllOf(HasSubstr("path.csv:1"), HasSubstr("no joint of robot")));
}

TEST_F(PathCsv, ReadsWhatRecordingsRead) {
  const Path expected = read(
      "shoulder,elbow,thumb,left,right\n0.1,0.2,0.3,0.4,0.6\n"
      "0.2,0.2,0.3,0.4,0.6\n");
  for (const char* text :
       {"timestamp,shoulder.pos,elbow.pos,thumb.pos,left.pos,right.pos\n"
        "1700000000000,0.1,0.2,0.3,0.4,0.6\n1700000000020,0.2,0.2,0.3,0.4,0.6\n",
        "__time,/joint_states/shoulder/position,/joint_states/shoulder/velocity,"
        "/joint_states/elbow/position,/joint_states/thumb/position,/joint_states/left/position,"
        "/joint_states/right/position\n0,0.1,7,0.2,0.3,0.4,0.6\n1,0.2,7,0.2,0.3,0.4,0.6\n",
        ",time,shoulder,elbow,thumb,left,right\n0,0,0.1,0.2,0.3,0.4,0.6\n"
        "1,1,0.2,0.2,0.3,0.4,0.6\n",
        "2024-03-01 12:00:00,shoulder,elbow,thumb,left,right,0.1,0.2,0.3,0.4,0.6\n"
        "2024-03-01 12:00:01,shoulder,elbow,thumb,left,right,0.2,0.2,0.3,0.4,0.6\n",
        "1700000000,5,,shoulder,elbow,thumb,left,right,0.1,0.2,0.3,0.4,0.6\n"
        "1700000001,5,,shoulder,elbow,thumb,left,right,0.2,0.2,0.3,0.4,0.6\n",
        "time;shoulder;elbow;thumb;left;right\n0;0,1;0,2;0,3;0,4;0,6\n1;0,2;0,2;0,3;0,4;0,6\n",
        "stamp,name,position\n0,\"['shoulder', 'elbow', 'thumb', 'left', 'right']\","
        "\"[0.1, 0.2, 0.3, 0.4, 0.6]\"\n1,\"['shoulder']\",\"[0.2]\"\n",
        "header: {stamp: {sec: 1, nanosec: 0}}\nname: [shoulder, elbow, thumb, left, right]\n"
        "position: [0.1, 0.2, 0.3, 0.4, 0.6]\n---\nheader: {stamp: {sec: 2, nanosec: 0}}\n"
        "name: [shoulder]\nposition: [0.2]\n---\n"}) {
    const Path path = read(text);
    ASSERT_THAT(path.waypoints, SizeIs(2)) << text;
    EXPECT_EQ(path.waypoints[0], expected.waypoints[0]) << text;
    EXPECT_EQ(path.waypoints[1], expected.waypoints[1]) << text;
  }
}

TEST_F(PathCsv, TakesDegreesOnlyWhereTheHeaderNamesThem) {
  const Path path = read("shoulder [deg],elbow_deg,thumb,left,right\n90,0,0,0,0\n45,0,0,0,0\n");
  EXPECT_NEAR(path.waypoints.at(0)[0], 0.5 * M_PI, 1e-12);
  EXPECT_THAT(refusal("shoulder,elbow,thumb,left,right\n0,0,0,0,0\n45,10,0,0,0\n"),
              AllOf(HasSubstr("joint shoulder"), HasSubstr("45"), HasSubstr("look like degrees")));
}

TEST_F(PathCsv, TakesUnitsInBracketsAndInARowOfTheirOwn) {
  const double half_turn = 0.5 * M_PI;
  for (const char* text :
       {"time,shoulder,elbow,thumb,left,right\nms,deg,rad,,,\n0,90,0,0,0,0\n20,45,0,0,0,0\n",
        "shoulder [turns],elbow [mrad],thumb,left,right\n0.25,0,0,0,0\n0.125,0,0,0,0\n",
        "shoulder [rad/s],shoulder [deg],elbow,thumb,left,right\n7,90,0,0,0,0\n7,45,0,0,0,0\n"}) {
    EXPECT_NEAR(read(text).waypoints.at(0)[0], half_turn, 1e-12) << text;
  }
  geometric::RobotDescription robot = test::planar_hand_arm();
  robot.joints.front().type = geometric::JointType::kPrismatic;
  const Path path = read_path(RobotModel(std::move(robot)),
                              file("shoulder [mm],elbow,thumb,left,right\n20,0,0,0,0\n"
                                   "30,0,0,0,0\n"));
  EXPECT_NEAR(path.waypoints.at(1)[0], 0.03, 1e-12);
}

TEST_F(PathCsv, ReadsBackAnyNamesOfJoints) {
  for (const std::string prefix : {"=", "+", "-", "@", "\"", "5\", ", "; ", "a\"\","}) {
    geometric::RobotDescription robot = test::planar_hand_arm();
    robot.groups.clear();
    for (geometric::Joint& joint : robot.joints) {
      joint.name = prefix + joint.name + "\"";
      if (joint.mimic) {
        joint.mimic->joint = prefix + joint.mimic->joint + "\"";
      }
    }
    const RobotModel model(std::move(robot));
    Path path;
    path.waypoints = {planar_configuration(0.1, 0.2, 0.3, 0.4, 0.5),
                      planar_configuration(0.2, 0.2, 0.3, 0.4, 0.5)};
    const fs::path written = file("");
    write_path_csv(path, model, written);
    const Path again = read_path(model, written);
    ASSERT_THAT(again.waypoints, SizeIs(2)) << prefix;
    EXPECT_EQ(again.waypoints[0], path.waypoints[0]) << prefix;
    EXPECT_EQ(again.waypoints[1], path.waypoints[1]) << prefix;
  }
}

// A continuous joint may have turned several times.
TEST_F(PathCsv, TakesSeveralTurnsWhereTheUnitIsClear) {
  geometric::RobotDescription robot = test::planar_hand_arm();
  robot.joints.front().limits.lower = -std::numeric_limits<double>::infinity();
  robot.joints.front().limits.upper = std::numeric_limits<double>::infinity();
  const RobotModel model(std::move(robot));
  const auto last_shoulder = [&](const std::string& header, double start) {
    JointsAtRest rest{planar_configuration(start, 0, 0.3, 0.4, 0.6)};
    return read_path(model, file("time," + header + "\n0,20\n1,18\n"), &rest).waypoints.at(1)[0];
  };
  EXPECT_EQ(last_shoulder("shoulder", 20.0), 18.0);
  EXPECT_EQ(last_shoulder("shoulder [rad]", 0.0), 18.0);
  EXPECT_THAT(refusal_of([&] { last_shoulder("shoulder", 0.0); }),
              AllOf(HasSubstr("turns without end"), HasSubstr("or \"shoulder [rad]\"")));
}

TEST_F(PathCsv, IsNotReadToWhereItIsCutOff) {
  EXPECT_THAT(refusal("shoulder,elbow,thumb,left,right\n0,0,0,0,0\n1,0,0,0,0\n1,0,0"),
              HasSubstr("the last row"));
}

TEST_F(PathCsv, LeavesJointsThatItHasNotWhereTheyRest) {
  JointsAtRest rest{planar_configuration(9, 9, 0.3, 0.4, 0.6)};
  const Path path = read_path(model_, file("time,elbow,shoulder\n0,0.2,0.1\n1,0.5,0.4\n"), &rest);
  EXPECT_THAT(rest.names, testing::UnorderedElementsAre("left", "right", "thumb"));
  ASSERT_THAT(path.waypoints, SizeIs(2));
  EXPECT_EQ(path.waypoints[0], planar_configuration(0.1, 0.2, 0.3, 0.4, 0.6));
  EXPECT_EQ(path.waypoints[1], planar_configuration(0.4, 0.5, 0.3, 0.4, 0.6));
  const Path printed = read_path(model_,
                                 file("joint_names: [shoulder, elbow]\npoints:\n"
                                      "- positions: [0.1, 0.2]\n- positions: [0.4, 0.5]\n"
                                      "---\n"),
                                 &rest);
  EXPECT_EQ(printed.waypoints, path.waypoints);
}

TEST_F(PathCsv, NamesJointsThatRest) {
  EXPECT_EQ(JointsAtRest{}.remark("arm.csv"), "");
  EXPECT_EQ((JointsAtRest{{}, {"left", "thumb"}}.remark("arm.csv")),
            "arm.csv does not have all joints: left, thumb stay at the start");
  EXPECT_EQ((JointsAtRest{{}, {"thumb"}}.remark("arm.csv")),
            "arm.csv does not have all joints: thumb stays at the start");
  EXPECT_EQ((JointsAtRest{{}, {"a", "b", "c", "d", "e", "f", "g"}}.remark("arm.csv")),
            "arm.csv does not have all joints: a, b, c and 4 more stay at the start");
}

TEST_F(PathCsv, IsKnownByItsNameOrItsBeginning) {
  EXPECT_TRUE(is_path_file("Path.CSV"));
  const auto written = [this](const char* name, const char* text) {
    std::ofstream(folder_.path() / name) << text;
    return folder_.path() / name;
  };
  EXPECT_TRUE(is_path_file(written("t.yaml", "joint_names: [a]\npoints: []\n")));
  EXPECT_TRUE(is_path_file(written("t.json", R"({"trajectory": {"joint_names": ["a"]}})")));
  EXPECT_FALSE(is_path_file(written("scene.yaml", "handway: 1\nname: Scene\n")));
  EXPECT_FALSE(is_path_file(folder_.path() / "none.yaml"));
}

TEST_F(PathCsv, RefusesMissingAndRepeatedJoints) {
  EXPECT_THAT(refusal("time,shoulder,elbow,thumb,left\n0,0,0,0,0\n"),
              AllOf(HasSubstr("0 columns"), HasSubstr("right")));
  EXPECT_THAT(refusal("time,shoulder,elbow,thumb,left,right,elbow\n0,0,0,0,0,0,0\n"),
              AllOf(HasSubstr("2 columns"), HasSubstr("elbow")));
}

TEST_F(PathCsv, RefusesCoupledJointsThatDoNotFollow) {
  EXPECT_THAT(refusal(std::string(kHeader) + kRow + "1,0.1,0.2,0.3,0.4,0.25,0.6,0.3\n"),
              AllOf(HasSubstr("path.csv:3"), HasSubstr("left_tip"), HasSubstr("0.25"),
                    HasSubstr("0.2"), HasSubstr("coupled to joint left")));
}

TEST_F(PathCsv, TakesJointsFromThoseThatFollowThem) {
  const Path path = read("shoulder,elbow,thumb,left_tip,right\n0,0,0,0.2,0\n0,0,0,0.3,0\n");
  EXPECT_NEAR(path.waypoints.at(1)[model_.find_variable("left").value()], 0.6, 1e-12);
}

TEST_F(PathCsv, NeedsTwoWaypoints) {
  EXPECT_THAT(refusal(std::string(kHeader) + kRow), HasSubstr("1 waypoint"));
  EXPECT_THAT(refusal(kHeader), HasSubstr("0 waypoints"));
  EXPECT_THAT(refusal(""), HasSubstr("empty"));
}

TEST_F(PathCsv, NamesAFileThatIsNotThere) {
  EXPECT_THAT(
      refusal_of([&] { static_cast<void>(read_path(model_, folder_.path() / "none.csv")); }),
      AllOf(HasSubstr("none.csv"), HasSubstr("no such file")));
  EXPECT_FALSE(refusal_of([&] { static_cast<void>(read_path(model_, folder_.path())); }).empty());
}

TEST_F(PathCsv, LeavesTheOldFileWhenItCanNotWrite) {
  const Path path{{planar_configuration(0, 0), planar_configuration(0.5, 0)}};
  EXPECT_FALSE(
      refusal_of([&] { write_path_csv(path, model_, folder_.path() / "none" / "p.csv"); }).empty());
  EXPECT_FALSE(refusal_of([&] { write_path_csv(path, model_, "/dev/full"); }).empty());
}

}  // namespace
}  // namespace handway::planning
