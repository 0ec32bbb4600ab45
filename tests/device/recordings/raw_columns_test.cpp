/// Columns of a source beside the values that were derived from them.
#include "handway/device/glove/raw_columns.h"

#include "handway/device/emulators/landmark_unit.h"
#include "handway/device/glove/recording.h"
#include "handway/device/glove/recording_filters.h"
#include "handway/device/recordings/recorded_table.h"
#include "handway/device/recordings/recording_contents.h"
#include "handway/geometric/math/units.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

bool are_alike(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         ((a.array() == b.array()) || (a.array().isNaN() && b.array().isNaN())).all();
}

class Raw : public testing::Test {
 protected:
  [[nodiscard]] fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
    return folder_.path() / name;
  }
  [[nodiscard]] std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_.path() / name).rdbuf();
    return text.str();
  }
  test::ScratchFolder folder_;
};

RecordedTable derived_table() {
  RecordedTable table;
  table.glove.emplace();
  table.glove->kind = RecordingKind::kAngles;
  table.glove->sensors = {*find_sensor("IndexMPJ"), *find_sensor("IndexPIJ")};
  table.names = {"IndexMPJ", "IndexPIJ"};
  table.times = Eigen::Vector3d(0.0, 0.25, 0.5);
  table.values = Eigen::MatrixXd{{0.1, 0.2}, {0.3, 0.4}, {0.5, 0.6}};
  table.raw.emplace();
  table.raw->add("force", "N");
  table.raw->add("quality", "");
  table.raw->values = Eigen::MatrixXd{{5.5, 1.0}, {17.0, kMissing}, {28.0, 0.5}};
  return table;
}

TEST(RawColumns, AreNamedWithTheirUnits) {
  RawColumns columns;
  columns.add("angle", "deg");
  columns.add("plain", "");
  columns.add("odd [name]", "m");
  const std::vector<std::string> labels = labels_of(columns);
  EXPECT_THAT(labels, ElementsAre("angle [deg]", "plain", "odd [name] [m]"));
  const RawColumns again = raw_columns_of_labels(labels);
  EXPECT_EQ(again.names, columns.names);
  EXPECT_EQ(again.units, columns.units);
}

TEST_F(Raw, IsKeptInEveryFormatThatIsWrittenAndRead) {
  const RecordedTable written = derived_table();
  for (const char* name : {"hand.csv", "hand.npz", "hand.h5", "hand.mcap"}) {
    SCOPED_TRACE(name);
    write_recorded_table(written, folder_.path() / name);
    const RecordedTable read = read_recorded_table(folder_.path() / name);
    EXPECT_EQ(read.names, written.names);
    EXPECT_EQ(read.values, written.values);
    ASSERT_TRUE(read.raw);
    EXPECT_EQ(read.raw->names, written.raw->names);
    EXPECT_EQ(read.raw->units, written.raw->units);
    EXPECT_TRUE(are_alike(read.raw->values, written.raw->values)) << read.raw->values;
  }
}

TEST_F(Raw, IsAVariableThatIsChosenByItsNameOnly) {
  write_recorded_table(derived_table(), folder_.path() / "hand.npz");
  const std::string file = (folder_.path() / "hand.npz").string();
  EXPECT_EQ(read_recorded_table(file).names, derived_table().names);
  const RecordedTable raw = read_recorded_table(file + "#raw[0:1]");
  EXPECT_EQ(raw.values.col(0), derived_table().raw->values.col(0));
}

TEST_F(Raw, HasEmptyCellsForMissingValues) {
  write_recorded_table(derived_table(), folder_.path() / "hand.csv");
  EXPECT_THAT(content("hand.csv"), HasSubstr("time,IndexMPJ,IndexPIJ,raw:force [N],raw:quality\n"
                                             "0,0.1,0.2,5.5,1\n0.25,0.3,0.4,17,\n"));
}

TEST_F(Raw, ColumnsOfARecordingAreCheckedLikeOthers) {
  const std::string head = "# handway glove recording 1\n# kind: angles\n";
  const auto refusal = [&](const std::string& text) {
    return test::refusal_of(
        [&] { static_cast<void>(read_recording(write("bad.csv", head + text))); });
  };
  EXPECT_THAT(refusal("time,IndexMPJ,raw:a\n0,0.1,x\n"), HasSubstr("column raw:a"));
  EXPECT_THAT(refusal("time,raw:a,IndexMPJ\n0,1,0.1\n"), HasSubstr("raw columns last"));
  EXPECT_THAT(refusal("time,IndexMPJ,raw:a\n0,0.1\n"), HasSubstr("3 as in the header"));
}

TEST_F(Raw, OfATableHasItsUnitsAndTheColumnsThatWereNotUsed) {
  const Recording recording = read_recording(
      write("t.csv", "time,IndexMPJ [deg],IndexPIJ [deg],force\n0,10,20,1.5\n1,30,40,2.5\n"));
  EXPECT_NEAR(recording.values(1, 0), 30.0 * geometric::kDegree, 1e-12);
  ASSERT_TRUE(recording.raw);
  EXPECT_THAT(labels_of(*recording.raw),
              ElementsAre("time", "IndexMPJ [deg]", "IndexPIJ [deg]", "force"));
  EXPECT_EQ(recording.raw->values,
            (Eigen::MatrixXd{{0.0, 10.0, 20.0, 1.5}, {1.0, 30.0, 40.0, 2.5}}));
}

TEST_F(Raw, LeavesOutTheRowsThatTheRecordingLeavesOut) {
  const Recording recording = read_recording(
      write("t.csv", "time,IndexMPJ,IndexPIJ,force\n0,0.1,0.2,1\n1,,0.4,2\n2,0.5,0.6,\n"));
  ASSERT_EQ(recording.times.size(), 2);
  ASSERT_TRUE(recording.raw);
  EXPECT_EQ(recording.raw->values(0, 3), 1.0);
  EXPECT_TRUE(std::isnan(recording.raw->values(1, 3)));
  EXPECT_EQ(recording.raw->values(1, 1), 0.5);
}

TEST_F(Raw, IsNotRepeatedIfNothingWasDerived) {
  const Recording recording =
      read_recording(write("t.csv", "time,IndexMPJ,IndexPIJ\n0,0.1,0.2\n1,0.3,0.4\n"));
  EXPECT_FALSE(recording.raw);
}

TEST_F(Raw, OfVirtualHandHasItsSignsAndItsSwitch) {
  std::string row = "2026 3 1 12 0 0.5 1";
  for (int slot = 0; slot < 23; ++slot) {
    row += slot == 5 ? " -0.7" : " 0.1";
  }
  const Recording recording = read_recording(write("log.txt", row + "\n" + row + "\n"));
  ASSERT_TRUE(recording.raw);
  const auto column = [&](const char* name) {
    return std::ranges::find(recording.raw->names, name) - recording.raw->names.begin();
  };
  EXPECT_EQ(recording.raw->values(1, column("switch")), 1.0);
  const auto first = std::ranges::find(cyberglove_sensors(), 5, &GloveSensor::slot);
  ASSERT_NE(first, cyberglove_sensors().end());
  EXPECT_EQ(recording.raw->values(0, column(std::string(first->name).c_str())), -0.7);
}

TEST_F(Raw, OfMessagesHasAllNumbersOfTheHand) {
  for (const auto& [wire, name, count] :
       {std::tuple(HandWire::kOpenXr, "index_metacarpal.x", 26 * 7),
        std::tuple(HandWire::kRokoko, "leftIndexTip.qw", 21 * 7),
        std::tuple(HandWire::kManus, "IndexPIPStretch", 20),
        std::tuple(HandWire::kLandmarks, "landmark_20.z", 21 * 3)}) {
    LandmarkUnitSettings unit;
    unit.wire = wire;
    unit.left = true;
    const auto sender = make_landmark_unit(unit, [](double time) {
      GloveAngles angles{time, {}};
      angles.angles.fill(0.25);
      return angles;
    });
    std::string text;
    for (int k = 0; k < 3; ++k) {
      for (const auto& line : sender->advance(*sender->next_due())) {
        text.append(line.begin(), line.end());
      }
    }
    const Recording recording = read_recording(write("hand.jsonl", text));
    ASSERT_TRUE(recording.raw) << name;
    EXPECT_EQ(recording.raw->values.rows(), 3);
    EXPECT_EQ(recording.raw->values.cols(), count);
    EXPECT_EQ(std::ssize(recording.raw->names), count);
    EXPECT_THAT(recording.raw->names, Contains(name));
    EXPECT_TRUE(recording.raw->values.allFinite());
  }
}

TEST_F(Raw, OfLandmarksInATableHasItsOtherColumns) {
  GloveAngles bent;
  bent.angles.fill(0.3);
  const HandLandmarks hand = 1000.0 * hand_landmarks(bent);  // mm
  std::string text = "frame,score";
  for (int point = 0; point < 21; ++point) {
    for (const char* axis : {"x", "y", "z"}) {
      text += "," + std::string(axis) + std::to_string(point);
    }
  }
  for (int frame = 0; frame < 3; ++frame) {
    text += "\n" + std::to_string(frame) + "," + (frame == 1 ? "0.25" : "0.75");
    for (const double coordinate : hand.reshaped()) {
      text += frame == 0 ? ",0" : "," + std::to_string(coordinate);  // no hand at first
    }
  }
  const Recording recording = read_recording(write("hand.csv", text + "\n"));
  ASSERT_EQ(recording.times.size(), 2);
  ASSERT_TRUE(recording.raw);
  EXPECT_EQ(recording.raw->names.at(1), "score");
  EXPECT_EQ(recording.raw->values(0, 1), 0.25);
  EXPECT_EQ(recording.raw->values(1, 1), 0.75);
  EXPECT_NEAR(recording.raw->values(0, 2 + 3 * 8), hand(0, 8), 1e-5) << "in mm, as in the file";
}

TEST_F(Raw, FollowsTheRowsOfFilters) {
  Recording recording;
  recording.header = *derived_table().glove;
  recording.times = derived_table().times;
  recording.values = derived_table().values;
  recording.raw = derived_table().raw;
  const Recording part = trimmed(recording, 0.2, 1.0);
  ASSERT_TRUE(part.raw);
  EXPECT_TRUE(are_alike(part.raw->values, recording.raw->values.bottomRows(2)));
  EXPECT_FALSE(resampled(recording, 10.0).raw) << "its rows are no rows of the source";
}

TEST(JoinedTables, KeepTheRawColumnsOfAll) {
  RecordedTable second = derived_table();
  second.raw->names[1] = "score";
  const std::vector<RecordedTable> tables{derived_table(), second};
  const std::vector<fs::path> files{"a.csv", "b.csv"};
  const RecordedTable joined = joined_tables(tables, files);
  ASSERT_TRUE(joined.raw);
  EXPECT_THAT(joined.raw->names, ElementsAre("force", "quality", "score"));
  const Eigen::MatrixXd expected{{5.5, 1.0, kMissing},       {17.0, kMissing, kMissing},
                                 {28.0, 0.5, kMissing},      {5.5, kMissing, 1.0},
                                 {17.0, kMissing, kMissing}, {28.0, kMissing, 0.5}};
  EXPECT_TRUE(are_alike(joined.raw->values, expected)) << joined.raw->values;
}

TEST_F(Raw, IsWrittenWhileAGloveIsRecorded) {
  RecordingHeader header = *derived_table().glove;
  RawColumns raw;
  raw.add("wrist.x", "m");
  GloveFrame frame;
  frame.angles.emplace();
  frame.angles->fill(0.5);
  {
    RecordingWriter writer(folder_.path() / "live.csv", header, raw);
    frame.raw = {1.25};
    writer.append(frame);
    frame.time = 0.5;
    frame.raw = {1.0, 2.0};  // of another sender
    writer.append(frame);
  }
  const Recording read = read_recording(folder_.path() / "live.csv");
  ASSERT_TRUE(read.raw);
  EXPECT_EQ(read.raw->units, raw.units);
  EXPECT_EQ(read.raw->values(0, 0), 1.25);
  EXPECT_TRUE(std::isnan(read.raw->values(1, 0)));
}

}  // namespace
}  // namespace handway::device
