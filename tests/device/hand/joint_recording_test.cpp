/// Recordings of a robot hand's own joints, as drivers, plotters and scripts write them.
#include "handway/device/hand/joint_recording.h"

#include "handway/device/recordings/recorded_table.h"
#include "handway/geometric/math/units.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"
#include "handway_test/robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

namespace handway::device {
namespace {

using test::turning;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kTolerance = 1e-12;

/// A finger of two joints.
class JointRecording : public testing::Test {
 protected:
  JointRecording() { build("mcp"); }

  void build(const std::string& mcp) {
    geometric::RobotDescription finger;
    finger.name = "finger";
    for (const char* link : {"palm", "proximal", "distal"}) {
      finger.links.emplace_back().name = link;
    }
    finger.joints = {turning(mcp, "palm", "proximal", -0.5, 1.5),
                     turning("pip", "proximal", "distal", -0.5, 1.5)};
    hand_ = std::make_shared<const geometric::RobotModel>(finger);
  }

  Recording read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_joint_recording(file_, *hand_);
  }

  void expect_two_rows(const std::string& text, double seconds) {
    SCOPED_TRACE(text);
    const Recording recording = read(text);
    ASSERT_EQ(recording.values.rows(), 2);
    EXPECT_NEAR(recording.times[1] - recording.times[0], seconds, 1e-6);
    const Eigen::Matrix2d expected{{0.1, 0.2}, {0.3, 0.4}};
    EXPECT_LT((recording.values - expected).cwiseAbs().maxCoeff(), kTolerance);
  }

  test::ScratchFolder folder_;
  std::filesystem::path file_ = folder_.path() / "joints";
  std::shared_ptr<const geometric::RobotModel> hand_;
};

TEST_F(JointRecording, IsATableWithJointsNamesInAnyOrder) {
  expect_two_rows("time,pip,mcp\n5,0.2,0.1\n5.5,0.4,0.3\n", 0.5);
  expect_two_rows("mcp;pip\n0,1;0,2\n0,3;0,4\n", 0.01);
  expect_two_rows("# mcp pip\n1.0e-01 2.0e-01\n3.0e-01 4.0e-01\n", 0.01);
}

TEST_F(JointRecording, KnowsTheColumnsOfPlottersAndOfRos) {
  expect_two_rows(
      "__time,/joint_states/mcp/position,/joint_states/mcp/velocity,/joint_states/pip/position\n"
      "1700000000.25,0.1,9,0.2\n1700000000.5,0.3,9,0.4\n",
      0.25);
  expect_two_rows(
      "%time,field.header.seq,field.name0,field.name1,field.position0,field.position1\n"
      "1700000000000000000,1,pip,mcp,0.2,0.1\n1700000000500000000,2,pip,mcp,0.4,0.3\n",
      0.5);
  expect_two_rows("timestamp,mcp_pos,pip_pos\n1700000000000,0.1,0.2\n1700000000020,0.3,0.4\n",
                  0.02);
}

TEST_F(JointRecording, KnowsJointsWithDotsInTheirNames) {
  build("joint_0.0");
  expect_two_rows("joint_0.0,pip\n0.1,0.2\n0.3,0.4\n", 0.01);
  expect_two_rows("joint_0.0.position,pip.position\n0.1,0.2\n0.3,0.4\n", 0.01);
  expect_two_rows("/js/joint_0.0/position,/js/joint_0.0/effort,/js/pip\n0.1,7,0.2\n0.3,7,0.4\n",
                  0.01);
}

TEST_F(JointRecording, HasTimesOfManyKinds) {
  expect_two_rows("Timestamp_ns,mcp,pip\n0,0.1,0.2\n20000000,0.3,0.4\n", 0.02);
  expect_two_rows("Date,Time,mcp,pip\n2024-03-01,12:00:00.5,0.1,0.2\n2024-03-01,12:00:01,0.3,0.4\n",
                  0.5);
  expect_two_rows("mcp;pip;Zeit [ms]\n0,1;0,2;0\n0,3;0,4;12,5\n", 0.0125);
  expect_two_rows("\"time\",\"mcp\",\"pip\"\n\"0,0\",\"0,1\",\"0,2\"\n\"0,5\",\"0,3\",\"0,4\"\n",
                  0.5);
  expect_two_rows("2024-03-01T12:00:00Z,mcp,pip,0.1,0.2\n2024-03-01T12:00:01Z,mcp,pip,0.3,0.4\n",
                  1.0);
}

TEST_F(JointRecording, HasNamesInItsRows) {
  expect_two_rows(
      "1700000000,250000000,base,pip,arm_1,mcp,0.2,3,0.1,0,0,0\n"
      "1700000000,500000000,base,mcp,pip,0.3,0.4\n",
      0.25);
  expect_two_rows("1700000000,250000000,,mcp,pip,0.1,0.2\n1700000000,500000000,,mcp,pip,0.3,0.4\n",
                  0.25);
  expect_two_rows(
      "time,name,position\n0.5,\"['mcp', 'pip']\",\"[0.1, 0.2]\"\n"
      "1.5,\"['pip', 'mcp']\",\"array('d', [0.4, 0.3])\"\n",
      1.0);
}

TEST_F(JointRecording, KeepsUnitsOfItsColumns) {
  const Recording recording = read("mcp [deg],pip_deg\n1,2\n3,4\n");
  EXPECT_NEAR(recording.values(1, 1), 4.0 * geometric::kDegree, kTolerance);
  EXPECT_NEAR(read("mcp_rad,pip_rad\n1,2\n3,7\n").values(1, 1), 7.0, kTolerance);
  expect_two_rows("mcp [actual],mcp [A],pip (measured)\n0.1,9,0.2\n0.3,9,0.4\n", 0.01);
}

TEST_F(JointRecording, KeepsUnitsOfColumnsOfArrays) {
  RecordedTable table;
  table.names = {"mcp [deg]", "pip_deg"};
  table.times = Eigen::Vector2d(0.0, 0.1);
  table.values = Eigen::Matrix2d{{1.0, 2.0}, {3.0, 4.0}};
  const std::filesystem::path file = folder_.path() / "joints.npz";
  write_recorded_table(table, file);
  const Recording recording = read_joint_recording(file, *hand_);
  EXPECT_LT((recording.values - table.values * geometric::kDegree).cwiseAbs().maxCoeff(),
            kTolerance);
}

TEST_F(JointRecording, DoesNotTakeAJointsOwnNameForAUnit) {
  build("mcp_deg");
  expect_two_rows("mcp_deg,pip\n0.1,0.2\n0.3,0.4\n", 0.01);
}

TEST_F(JointRecording, RefusesPositionsInUnknownUnits) {
  EXPECT_EQ(test::refusal_of([&] { read("mcp [ticks],pip\n1,2\n3,4\n"); }),
            file_.string() +
                ":1: column \"mcp [ticks]\": found the unit \"ticks\", expected rad, mrad, deg or "
                "turns, or m, cm or mm. Convert its values to one of them.");
}

TEST_F(JointRecording, NamesTimesInUnknownUnits) {
  for (const char* time : {"time [ticks]", "time_ticks"}) {
    const Recording recording =
        read(time + std::string(",mcp,pip\n0,0.1,0.2\n1,0.3,0.4\n2,0.3,0.4\n"));
    EXPECT_EQ(recording.times[2], 2.0);
    EXPECT_THAT(recording.warnings,
                ElementsAre(HasSubstr("the header says \"ticks\" for times, which is not a known "
                                      "unit (s, ms, \u00B5s, ns, min, h): they are taken for s")));
  }
}

TEST_F(JointRecording, GoesOnWhereTheClockWasSetBack) {
  const Recording recording =
      read("time,mcp,pip\n8,0.1,0.2\n9,0.1,0.2\n2,0.3,0.4\n3,0.3,0.4\n4,0.3,0.4\n");
  ASSERT_EQ(recording.values.rows(), 5);
  EXPECT_EQ(recording.times[4], 4.0);
  EXPECT_THAT(recording.warnings, ElementsAre(HasSubstr("time runs back by 7 s at line 4")));
}

TEST_F(JointRecording, LeavesOutSingleValuesThatAreNoAngles) {
  std::string text = "mcp,pip\n";
  for (int row = 0; row < 200; ++row) {
    text += row == 100 ? "0.1,4000\n" : "0.1,0.2\n";
  }
  const Recording recording = read(text);
  EXPECT_EQ(recording.values.rows(), 199);
  EXPECT_EQ(recording.values(150, 1), 0.2) << "not taken for degrees";
  EXPECT_THAT(recording.warnings, testing::Contains(HasSubstr("line 102 pip has 4000")));
}

TEST_F(JointRecording, IsJointStateMessages) {
  expect_two_rows(
      "header:\n  stamp:\n    sec: 1700000000\n    nanosec: 0\nname: [mcp, pip]\n"
      "position: [0.1, 0.2]\nvelocity: []\n---\n"
      "header:\n  stamp:\n    sec: 1700000001\n    nanosec: 500000000\nname:\n- pip\n- mcp\n"
      "position:\n- 0.4\n- 0.3\n---\n",
      1.5);
  expect_two_rows(
      R"({"msg": {"header": {"stamp": {"secs": 3, "nsecs": 0}}, "name": ["mcp", "pip"], "position": [0.1, 0.2]}})"
      "\n"
      R"({"msg": {"header": {"stamp": {"secs": 4, "nsecs": 0}}, "name": ["mcp", "pip"], "position": [0.3, 0.4]}})"
      "\n",
      1.0);
}

TEST_F(JointRecording, IsAJointTrajectory) {
  expect_two_rows(
      "{\n \"joint_names\": [\"pip\", \"mcp\"],\n \"points\": [\n"
      "  {\"positions\": [0.2, 0.1], \"time_from_start\": {\"sec\": 0, \"nanosec\": 0}},\n"
      "  {\"positions\": [0.4, 0.3], \"time_from_start\": {\"sec\": 0, \"nanosec\": "
      "40000000}}]\n}\n",
      0.04);
}

TEST_F(JointRecording, HoldsWhatAMessageDoesNotHave) {
  const Recording recording = read(
      "name: [mcp]\nposition: [0.1]\n---\nname: [arm_1]\nposition: [3]\n---\n"
      "name: [pip]\nposition: [0.2]\n---\nname: [mcp]\nposition: [0.3]\n");
  ASSERT_EQ(recording.values.rows(), 2);
  EXPECT_EQ(recording.values.row(0), Eigen::RowVector2d(0.1, 0.2));
  EXPECT_EQ(recording.values.row(1), Eigen::RowVector2d(0.3, 0.2));
  EXPECT_THAT(recording.warnings, ElementsAre(HasSubstr("arm_1"), HasSubstr("1 row left out")));
}

TEST_F(JointRecording, TakesLargeAnglesForDegrees) {
  const Recording recording = read("mcp,pip\n10,20\n30,40\n");
  EXPECT_NEAR(recording.values(1, 1), 40.0 * geometric::kDegree, kTolerance);
  EXPECT_THAT(recording.warnings, ElementsAre(HasSubstr("degrees")));
}

TEST_F(JointRecording, SaysWhatItDoesNotHaveAndWhatItLeavesOut) {
  const Recording recording = read("time,mcp,label\n0,0.1,a\n1,nan,a\n3,0.2,a\n2,0.3,a\n4,0.4,b\n");
  EXPECT_EQ(recording.values.rows(), 4) << "one comes a little late";
  EXPECT_TRUE(recording.values.col(1).isZero());
  EXPECT_THAT(recording.warnings, ElementsAre(HasSubstr("label"), HasSubstr("no values of pip"),
                                              HasSubstr("1 row left out"),
                                              HasSubstr("1 row kept in the file's order")));
}

TEST_F(JointRecording, LeavesOutALastLineThatIsCutOff) {
  const Recording recording = read("mcp,pip\n0.1,0.2\n0.3,0.4\n0.5");
  EXPECT_EQ(recording.values.rows(), 2);
  EXPECT_THAT(recording.warnings, ElementsAre(HasSubstr("last row")));
}

TEST_F(JointRecording, LeavesOutALastMessageThatIsCutOff) {
  const std::string whole = "name: [mcp, pip]\nposition: [0.1, 0.2]\n---\n";
  for (const char* rest : {"name: [mcp, p", "name: [mcp, pip]\n", "header:\n  stamp:\n    se",
                           "name: [mcp, pip]\nposition: [0.1]\n"}) {
    SCOPED_TRACE(rest);
    const Recording recording = read(whole + rest);
    EXPECT_EQ(recording.values.rows(), 1);
    EXPECT_THAT(recording.warnings, ElementsAre(HasSubstr("last message")));
  }
}

TEST_F(JointRecording, RefusesWhatIsNone) {
  const auto refuses = [&](const std::string& text, const std::string& why) {
    SCOPED_TRACE(text);
    EXPECT_THAT(test::refusal_of([&] { read(text); }), HasSubstr(why));
  };
  refuses("time,j1\n0,1\n", "Its joints are mcp, pip");
  refuses("mcp,pip\n", "no values of joints of finger");
  refuses("mcp,pip\n0.1\n0.2,0.3\n", ":2");
  refuses("# handway postures 1\n# hand: finger\nmcp,pip\n0.1,0.2\n", "normalised postures");
  refuses("name: [mcp, pip]\nposition: [0.1]\n", "1 position");
  refuses("name: [mcp]\n---\nposition: [0.1]\n", "position");
}

TEST_F(JointRecording, IsNotTakenForAGlovesRecording) {
  std::ofstream(file_) << "name: [mcp]\nposition: [0.1]\n---\nname: [mcp]\nposition: [0.1]\n";
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read_recording(file_)); }),
              HasSubstr("--joints-of"));
}

TEST_F(JointRecording, IsKnownByItsMessagesOrHalfOfTheJoints) {
  const auto is_one = [&](const std::string& text) {
    std::ofstream(file_) << text;
    return is_joint_recording(file_, *hand_);
  };
  EXPECT_TRUE(is_one("name: [mcp]\nposition: [0.1]\n"));
  EXPECT_TRUE(is_one("# made by a script\ntime,arm_1,pip\n0,0,0.1\n"));
  EXPECT_FALSE(is_one("time,IndexMPJ,ThumbMPJ\n0,0,0.1\n"));
  EXPECT_FALSE(is_one(R"([{"name": "wrist", "position": [0, 0, 0]}])"));
  EXPECT_FALSE(is_joint_recording(file_ / "nowhere", *hand_));
}

TEST_F(JointRecording, BecomesPosturesWithinTheLimits) {
  const OwnJoints joints(*hand_);
  const MappedPostures mapped = joints.map_recording(read("mcp,pip\n-1,0.2\n0.3,2\n"));
  EXPECT_THAT(mapped.joints, ElementsAre("mcp", "pip"));
  EXPECT_EQ(mapped.postures, Eigen::Matrix2d({{-0.5, 0.2}, {0.3, 1.5}}));
  EXPECT_EQ(mapped.unclamped, Eigen::Matrix2d({{-1, 0.2}, {0.3, 2}}));
  EXPECT_THAT(mapped.clamped, ElementsAre(1, 1));
}

}  // namespace
}  // namespace handway::device
