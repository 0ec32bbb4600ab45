/// Recordings in arrays and topics: NumPy, HDF5 and bags of ROS 2; also cut off and damaged.
#include "cdr_message.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/recording.h"
#include "handway/device/recordings/recorded_table.h"
#include "handway/device/recordings/recording_contents.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <matio.h>
#include <sqlite3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using test::joint_state;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// An array of version 1 with elements as they are in memory.
std::string npy(const std::string& type, const std::string& shape, const std::string& elements,
                bool fortran = false) {
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': {}, }}\n", type,
                                 fortran ? "True" : "False", shape);
  std::string bytes = "\x93NUMPY";
  bytes += '\x01';
  bytes += '\x00';
  bytes += static_cast<char>(text.size() & 0xFF);
  bytes += static_cast<char>(text.size() >> 8);
  return bytes + text + elements;
}

template <typename Number>
std::string bytes_of(const std::vector<Number>& numbers, bool swapped = false) {
  std::string bytes;
  for (const Number number : numbers) {
    std::string one(sizeof(Number), '\0');
    std::memcpy(one.data(), &number, sizeof(Number));
    bytes += swapped ? std::string(one.rbegin(), one.rend()) : one;
  }
  return bytes;
}

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Arrays : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
    return folder_.path() / name;
  }
  fs::path write_bag(const std::vector<std::string>& messages) {
    const fs::path file = folder_.path() / "bag.db3";
    sqlite3* bag = nullptr;
    EXPECT_EQ(sqlite3_open(file.c_str(), &bag), SQLITE_OK);
    sqlite3_exec(
        bag,
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, "
        "serialization_format TEXT);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER,"
        " data BLOB);"
        "INSERT INTO topics VALUES(1, '/joint_states', 'sensor_msgs/msg/JointState', 'cdr');"
        "INSERT INTO topics VALUES(2, '/tf', 'tf2_msgs/msg/TFMessage', 'cdr');",
        nullptr, nullptr, nullptr);
    for (const std::string& message : messages) {
      sqlite3_stmt* statement = nullptr;
      sqlite3_prepare_v2(bag, "INSERT INTO messages(topic_id, timestamp, data) VALUES(1, 5, ?1)",
                         -1, &statement, nullptr);
      sqlite3_bind_blob(statement, 1, message.data(), static_cast<int>(message.size()),
                        SQLITE_TRANSIENT);
      EXPECT_EQ(sqlite3_step(statement), SQLITE_DONE);
      sqlite3_finalize(statement);
    }
    sqlite3_close(bag);
    return file;
  }

  /// Reads a valid file that is cut off, and with flipped bytes: each is read or refused by an
  /// InputError.
  void survive_damage(const std::string& name, const std::string& valid, std::size_t step) {
    const auto read = [&](const std::string& bytes) {
      const fs::path file = write(name, bytes);
      static_cast<void>(test::refusal_of([&] {
        static_cast<void>(recording_contents(file));
        static_cast<void>(read_recorded_table(file));
      }));
    };
    for (std::size_t size = 0; size < valid.size(); size += step) {
      read(valid.substr(0, size));
    }
    for (std::size_t at = 0; at < valid.size(); at += step) {
      std::string damaged = valid;
      damaged[at] = static_cast<char>(damaged[at] ^ 0xFF);
      read(damaged);
    }
  }

  test::ScratchFolder folder_;
};

RecordedTable small_table() {
  RecordedTable table;
  table.names = {"pan", "t\u00EFlt"};
  table.times = Eigen::Vector3d(0.0, 0.1, 0.2);
  table.values = Eigen::MatrixXd{{0.1, 0.2}, {0.3, 0.4}, {0.5, -0.6}};
  return table;
}

TEST_F(Arrays, OfNumpyAreReadInEitherByteOrderAndOrderOfIndices) {
  const std::vector<float> rows = {1, 2, 3, 4, 5, 6};
  const std::vector<float> columns = {1, 3, 5, 2, 4, 6};
  const Eigen::MatrixXd expected{{1, 2}, {3, 4}, {5, 6}};
  for (const std::string& bytes :
       {npy("<f4", "(3, 2)", bytes_of(rows)), npy(">f4", "(3, 2)", bytes_of(rows, true)),
        npy("<f4", "(3, 2)", bytes_of(columns), true),
        npy("|u1", "(3, 2)", bytes_of(std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6})),
        npy(">i2", "(3, 2)", bytes_of(std::vector<std::int16_t>{1, 2, 3, 4, 5, 6}, true))}) {
    EXPECT_EQ(read_recorded_table(write("a.npy", bytes)).values, expected) << bytes;
  }
}

TEST_F(Arrays, OfObjectsAreRefusedWithTheReason) {
  const fs::path file = write("a.npy", npy("|O", "(3, 2)", "\x80\x04"));
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read_recording(file)); }),
              AllOf(HasSubstr(file.string()), HasSubstr("pickle")));
}

TEST_F(Arrays, ThatAreShorterThanTheirShapeAreRefused) {
  const fs::path file = write("a.npy", npy("<f8", "(100000, 22)", "short"));
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read_recording(file)); }),
              HasSubstr("cut off"));
}

TEST_F(Arrays, KeepNamesAndTimesInEveryFormatThatIsWritten) {
  for (const char* name :
       {"joints.npz", "joints.h5", "joints.csv", "joints.mcap", "joints.parquet"}) {
    SCOPED_TRACE(name);
    const fs::path file = folder_.path() / name;
    write_recorded_table(small_table(), file);
    const std::string bytes = content_of(file);
    const RecordedTable read = read_recorded_table(file);
    EXPECT_EQ(read.names, small_table().names);
    EXPECT_EQ(read.values, small_table().values);
    EXPECT_LT((read.times - small_table().times).cwiseAbs().maxCoeff(), 1e-12);
    write_recorded_table(small_table(), file);
    EXPECT_EQ(content_of(file), bytes);
  }
}

TEST_F(Arrays, KeepNamesWithSeparatorsAndQuotes) {
  RecordedTable table = small_table();
  table.names = {"=pan, left", "\"tilt\" 5\""};
  write_recorded_table(table, folder_.path() / "joints.csv");
  EXPECT_EQ(read_recorded_table(folder_.path() / "joints.csv").names, table.names);
}

TEST_F(Arrays, KeepValuesInTheUnitThatTheirNamesSay) {
  RecordedTable table = small_table();
  table.names = {"pan [deg]", "tilt_deg"};
  for (const char* name : {"joints.npz", "joints.csv"}) {
    SCOPED_TRACE(name);
    write_recorded_table(table, folder_.path() / name);
    const RecordedTable read = read_recorded_table(folder_.path() / name);
    EXPECT_EQ(read.names, table.names);
    EXPECT_EQ(read.values, table.values);
  }
}

TEST_F(Arrays, WithSeveralVariablesAreListedAndChosenByName) {
  RecordedTable glove = small_table();
  glove.names = {"IndexMPJ", "IndexPIJ"};
  const fs::path file = folder_.path() / "glove.npz";
  write_recorded_table(glove, file);
  const RecordingContents contents = recording_contents(file);
  EXPECT_EQ(contents.kind.name, "NumPy");
  ASSERT_EQ(contents.variables.size(), 3U);
  EXPECT_EQ(contents.variables[1].name, "values");
  EXPECT_EQ(contents.variables[1].shape, (std::vector<std::size_t>{3, 2}));
  EXPECT_EQ(read_recording(file.string() + "#values").values, glove.values);
  EXPECT_EQ(read_recorded_table(file.string() + "#values[1:2]").values, glove.values.col(1));
  EXPECT_THAT(
      test::refusal_of([&] { static_cast<void>(read_recording(file.string() + "#valeus")); }),
      AllOf(HasSubstr("values (3 x 2)"), HasSubstr("Did you mean")));
}

TEST_F(Arrays, OfBagsHoldTheLastPositionOfEachJoint) {
  const fs::path file =
      write_bag({joint_state(10.0, {"pan", "tilt"}, {0.1, 0.2}), joint_state(10.5, {"pan"}, {0.3}),
                 joint_state(11.0, {"tilt", "pan"}, {0.4, 0.5})});
  const RecordedTable table = read_recorded_table(file);
  EXPECT_THAT(table.names, ElementsAre("pan", "tilt"));
  EXPECT_EQ(table.values, (Eigen::MatrixXd{{0.1, 0.2}, {0.3, 0.2}, {0.5, 0.4}}));
  EXPECT_NEAR(table.times[2], 1.0, 1e-9);
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read_recording(file)); }),
              HasSubstr("--joints-of"));
  EXPECT_THAT(recording_contents(file).variables[1].problem, HasSubstr("tf2_msgs"));
}

TEST_F(Arrays, OfKeypointsAreLandmarksInMetresOrMillimetres) {
  GloveAngles bent;
  bent.angles.fill(0.3);
  const HandLandmarks points = hand_landmarks(bent);
  for (const double unit : {1.0, 1000.0}) {
    std::vector<double> elements;
    for (int frame = 0; frame < 3; ++frame) {
      const HandLandmarks scaled = unit * points;
      elements.insert(elements.end(), scaled.data(), scaled.data() + scaled.size());
    }
    const Recording recording =
        read_recording(write("hands.npy", npy("<f8", "(3, 21, 3)", bytes_of(elements))));
    ASSERT_EQ(recording.times.size(), 3);
    const int index = column_of(recording.header, *find_sensor("IndexPIJ"));
    const GloveAngles expected = glove_angles(in_palm_frame(points, false));
    EXPECT_NEAR(recording.values(2, index),
                expected.angles.at(static_cast<std::size_t>(*find_sensor("IndexPIJ"))), 1e-6);
    EXPECT_THAT(recording.warnings.back(), unit > 1.0 ? HasSubstr("in mm") : HasSubstr("hand"));
    EXPECT_THAT(recording.warnings.back(), testing::Not(HasSubstr("usual size")));
  }
}

TEST_F(Arrays, OfMatlabCellsAreNamedByRowAndColumn) {
  const fs::path file = folder_.path() / "cells.mat";
  mat_t* opened = Mat_CreateVer(file.c_str(), nullptr, MAT_FT_MAT5);
  std::array<std::size_t, 2> size{2, 23};
  std::array<std::size_t, 2> cell_count{1, 2};
  std::vector<std::vector<double>> values{std::vector<double>(46, 0.25),
                                          std::vector<double>(46, 0.5)};
  std::array<matvar_t*, 2> cells{};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells.at(i) =
        Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), values[i].data(), 0);
  }
  matvar_t* all = Mat_VarCreate("q", MAT_C_CELL, MAT_T_CELL, 2, cell_count.data(), cells.data(), 0);
  Mat_VarWrite(opened, all, MAT_COMPRESSION_ZLIB);
  Mat_VarFree(all);
  Mat_Close(opened);
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read_recording(file)); }),
              AllOf(HasSubstr("q{1,1} (2 x 23)"), HasSubstr("q{1,2} (2 x 23)")));
  const Recording second = read_recording(file.string() + "#q{1,2}");
  EXPECT_NEAR(std::abs(second.values(1, 0)), 0.5, 1e-12);
}

TEST_F(Arrays, OfAGloveWithAnImpossibleValueAreNotReadAsJoints) {
  const fs::path file = write("glove.csv", "time,IndexMPJ,IndexPIJ\n0,0.1,0.2\n0.1,0.1,5000.5\n");
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read_recorded_table(file)); }),
              HasSubstr("5000.5"));
}

TEST_F(Arrays, OfDamagedMessagesAreRefusedByTheirNumber) {
  const fs::path file = write_bag(
      {joint_state(10.0, {"pan"}, {0.1}), joint_state(11.0, {"pan"}, {0.1}).substr(0, 30)});
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read_recorded_table(file)); }),
              HasSubstr("/joint_states, message 2"));
}

TEST_F(Arrays, OfNumpySurviveAnyDamage) {
  survive_damage("a.npy", npy("<f8", "(3, 2)", bytes_of(std::vector<double>(6, 0.5))), 1);
  write_recorded_table(small_table(), folder_.path() / "b.npz");
  survive_damage("b.npz", content_of(folder_.path() / "b.npz"), 1);
}

TEST_F(Arrays, OfBagsSurviveAnyDamage) {
  survive_damage(
      "c.db3",
      content_of(write_bag({joint_state(10.0, {"pan"}, {0.1}), joint_state(11.0, {"pan"}, {0.2})})),
      13);
}

// Every file is read by several processes.
TEST_F(Arrays, OfHdf5SurviveAnyDamage) {
  write_recorded_table(small_table(), folder_.path() / "d.h5");
  const std::string valid = content_of(folder_.path() / "d.h5");
  survive_damage("d.h5", valid.substr(0, 4096), 61);
}

TEST_F(Arrays, AreNoTablesOfTimesAlone) {
  const std::filesystem::path file = folder_.path() / "times.csv";
  std::ofstream(file) << "stamp\n1\n2\n";
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read_recorded_table(file)); }),
              HasSubstr("found stamp, expected columns named as the glove's sensors"));
}

}  // namespace
}  // namespace handway::device
