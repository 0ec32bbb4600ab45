#include "handway/device/glove/recording.h"
#include "handway/geometric/math/units.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <matio.h>

#include <array>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using geometric::kDegree;
using testing::AllOf;
using testing::HasSubstr;

class Tables : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
    return folder_.path() / name;
  }
  /// A version 5 file with one matrix, row by row.
  fs::path write_matlab(const std::string& name, const std::string& variable, std::size_t columns,
                        const std::vector<double>& values) {
    const fs::path file = folder_.path() / name;
    const std::size_t rows = values.size() / columns;
    std::vector<double> by_column;
    for (std::size_t column = 0; column < columns; ++column) {
      for (std::size_t row = 0; row < rows; ++row) {
        by_column.push_back(values[row * columns + column]);
      }
    }
    std::array<std::size_t, 2> size{rows, columns};
    mat_t* opened = Mat_CreateVer(file.c_str(), nullptr, version_);
    matvar_t* matrix = Mat_VarCreate(in_structure_ ? "field" : variable.c_str(), MAT_C_DOUBLE,
                                     MAT_T_DOUBLE, 2, size.data(), by_column.data(), 0);
    if (in_structure_) {
      std::array<std::size_t, 2> one{1, 1};
      const char* field = variable.c_str();
      matvar_t* whole = Mat_VarCreateStruct("data", 2, one.data(), &field, 1);
      Mat_VarSetStructFieldByName(whole, field, 0, matrix);
      matrix = whole;
    }
    Mat_VarWrite(opened, matrix, MAT_COMPRESSION_ZLIB);
    Mat_VarFree(matrix);
    Mat_Close(opened);
    return file;
  }
  static double value(const Recording& recording, Eigen::Index row, const char* sensor) {
    return recording.values(row, column_of(recording.header, *find_sensor(sensor)));
  }

  [[nodiscard]] Recording read(const std::string& text) {
    return read_recording(write("table.txt", text));
  }

  test::ScratchFolder folder_;
  mat_ft version_ = MAT_FT_MAT5;
  bool in_structure_ = false;
};

std::string angles(int count, const std::string& separator, double first) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += (i > 0 ? separator : "") + std::to_string(first - 0.01 * i);
  }
  return text;
}

TEST_F(Tables, KnowsJointsWhoseBendingIsNamed) {
  const Recording recording =
      read_recording(write("a.csv",
                           "Frame,Elapsed_Time_In_Milliseconds,Thumb_CMC_Spread,Thumb_PIP_Flex,"
                           "Index_MCP_Spread,Index_MCP_Flex,Index_PIP_Flex\n"
                           "0,0,10,20,5,30,40\n1,8,11,21,6,31,41.5\n"));
  EXPECT_NEAR(value(recording, 0, "ThumbAbduct"), 10 * kDegree, 1e-9);
  EXPECT_NEAR(value(recording, 0, "ThumbMPJ"), 20 * kDegree, 1e-9);
  EXPECT_NEAR(value(recording, 1, "IndexPIJ"), 41.5 * kDegree, 1e-9);
  EXPECT_NEAR(recording.times[1], 0.008, 1e-9);
  EXPECT_EQ(column_of(recording.header, *find_sensor("MiddleIndexAbduct")), -1);
}

TEST_F(Tables, ReadVirtualHandsPosturesWithoutTimes) {
  const Recording recording = read_recording(
      write("gesture.txt", angles(23, " ", -0.1) + "\n" + angles(23, " ", -0.5) + "\n"));
  EXPECT_EQ(recording.header.kind, RecordingKind::kAngles);
  ASSERT_EQ(recording.values.rows(), 2);
  EXPECT_EQ(recording.times[1], 1.0);
  EXPECT_NEAR(value(recording, 0, "IndexMPJ"), 0.14, 1e-9) << "slot 4, flexion turned positive";
  EXPECT_NEAR(value(recording, 1, "MiddleMPJ"), 0.58, 1e-9) << "slot 8: slot 7 is no sensor's";
  EXPECT_NEAR(value(recording, 0, "RingMiddleAbduct"), -0.25, 1e-9);
  EXPECT_NEAR(value(recording, 0, "WristYaw"), 0.32, 1e-9);
}

TEST_F(Tables, ReadLabelledPosturesWhoseLinesEndInCr) {
  std::string header = "S01";
  for (int i = 2; i <= 22; ++i) {
    header += ",S" + std::to_string(i);
  }
  const std::string rows = angles(22, ",", -0.1) + ",A\r" + angles(22, ",", -0.5) + ",B\r";
  for (const std::string& text : {rows, header + ",OUTPUT\r" + rows}) {
    const Recording recording = read_recording(write("libras.csv", text));
    ASSERT_EQ(recording.values.rows(), 2);
    EXPECT_EQ(recording.values.cols(), 21) << "without the wrist's abduction";
    EXPECT_NEAR(value(recording, 1, "ThumbMPJ"), 0.51, 1e-9);
  }
}

TEST_F(Tables, AreReadByAMapOfTheirColumns) {
  write("t.csv", "made by hand\r\nt;label;TR;I1\r\n0;A;-10;20\r\n40;B;-30;40\r\n");
  const fs::path map = write("map.yaml",
                             "table: t.csv\nskip: 1\nunit: deg\nsigns: negative\n"
                             "time: {column: t, gain: 0.001}\n"
                             "columns: {ThumbRotate: TR, g: {column: 4, gain: -1, offset: 5}}\n");
  const Recording recording = read_recording(map);
  EXPECT_EQ(recording.header.kind, RecordingKind::kAngles);
  EXPECT_NEAR(recording.times[1], 0.04, 1e-12);
  EXPECT_NEAR(value(recording, 1, "ThumbRotate"), 30 * kDegree, 1e-9);
  EXPECT_NEAR(value(recording, 1, "IndexMPJ"), 35 * kDegree, 1e-9);
}

TEST_F(Tables, SayWhichColumnOfAMapIsWrong) {
  write("t.csv", "1 2 x\n3 4 y\n");
  const auto refusal = [&](const std::string& columns) {
    const fs::path map = write("map.yaml", "table: t.csv\ncolumns: {" + columns + "}\n");
    return test::refusal_of([&] { static_cast<void>(read_recording(map)); });
  };
  EXPECT_THAT(refusal("IndexMPJ: 4"), AllOf(HasSubstr("map.yaml:2"), HasSubstr("from 1 to 3")));
  EXPECT_THAT(refusal("IndexMPK: 1"), HasSubstr("IndexMPJ"));
  EXPECT_THAT(refusal("IndexMPJ: 3"), AllOf(HasSubstr("t.csv:1"), HasSubstr("no number")));
  write("t.csv", "10 200\n");
  EXPECT_THAT(refusal("IndexMPJ: 2"), HasSubstr("unit: deg"));
}

TEST_F(Tables, ReadMatlabFilesOfGloves) {
  const std::vector<double> counts(44, 120.0);
  const Recording raw = read_recording(write_matlab("S1_A1_E1.mat", "glove", 22, counts));
  EXPECT_EQ(raw.header.kind, RecordingKind::kCounts);
  EXPECT_EQ(raw.values.rows(), 2);
  EXPECT_NEAR(raw.times[1], 0.01, 1e-12);
  std::vector<double> degrees(44, 10.0);
  degrees[22 + 4] = 45.0;
  const Recording calibrated = read_recording(write_matlab("S2.mat", "angles", 22, degrees));
  EXPECT_EQ(calibrated.header.kind, RecordingKind::kAngles);
  EXPECT_NEAR(value(calibrated, 1, "IndexMPJ"), 45 * kDegree, 1e-9);
}

TEST_F(Tables, ReadOtherMatlabFilesByAMap) {
  const fs::path file = write_matlab("q.mat", "q", 3, {0.0, 0.1, 0.2, 1.0, 1.1, 1.2});
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read_recording(file)); }),
              AllOf(HasSubstr("q (2 x 3)"), HasSubstr("map")));
  const fs::path map =
      write("q.yaml", "table: q.mat\nvariable: q\nrate: 50\ncolumns: {IndexMPJ: 2}\n");
  const Recording recording = read_recording(map);
  EXPECT_NEAR(value(recording, 1, "IndexMPJ"), 1.1, 1e-12);
  EXPECT_NEAR(recording.times[1], 0.02, 1e-12);
}

// The file is saved by a spreadsheet of a country with decimal commas.
TEST_F(Tables, ReadSpreadsheetsWithDecimalCommasAndNamesOfOthers) {
  const Recording recording = read(
      "\xEF\xBB\xBFTrial 7;;;;;\r\n"
      "Time (ms);Index MCP [deg];index_pip_deg;Middle-Index abduction;Subject;Thumb CMC\r\n"
      "0;12,5;40,25;-3,5;anna;90,5\r\n10;13;41;-3,25;anna;91\r\n");
  EXPECT_EQ(recording.header.kind, RecordingKind::kAngles);
  ASSERT_EQ(recording.values.rows(), 2);
  EXPECT_NEAR(recording.times[1], 0.01, 1e-12);
  EXPECT_NEAR(value(recording, 0, "IndexMPJ"), 12.5 * kDegree, 1e-9);
  EXPECT_NEAR(value(recording, 0, "MiddleIndexAbduct"), -3.5 * kDegree, 1e-9);
  EXPECT_NEAR(value(recording, 1, "ThumbRotate"), 91 * kDegree, 1e-9);
  EXPECT_THAT(recording.warnings,
              testing::Contains(AllOf(HasSubstr("degrees"), HasSubstr("passed over: Subject"))));
}

TEST_F(Tables, ReadUnitsInARowBelowTheNames) {
  const Recording recording =
      read("t,IndexMPJ,IndexPIJ\nms,deg,deg\n0,1.5,2.25\n20,2,3\n40,2.5,4\n");
  ASSERT_EQ(recording.values.rows(), 3);
  EXPECT_NEAR(recording.times[1], 0.02, 1e-12);
  EXPECT_NEAR(value(recording, 0, "IndexPIJ"), 2.25 * kDegree, 1e-12);
}

TEST_F(Tables, KeepRadWhereTheNamesSaySo) {
  EXPECT_EQ(value(read("IndexMPJ [rad],IndexPIJ [rad]\n1,2\n2,1\n"), 0, "IndexPIJ"), 2.0);
  EXPECT_THAT(test::refusal_of([&] {
                static_cast<void>(read("IndexMPJ [rad],IndexPIJ [rad]\n0.5,0.2\n8.5,0.3\n"));
              }),
              AllOf(HasSubstr("IndexMPJ"), HasSubstr("8.5"), HasSubstr("an angle in rad")));
}

TEST_F(Tables, ReadTheNamesOfKinMus) {
  const Recording recording = read(
      "CMC1_F,CMC1_A,MCP1_F,IP1_F,MCP2_F,PIP2_F,MCP2-3_A,W_F\n"
      "10.5,5,20,30,45,60,8,-20\n11,5,20,30,46,60,8,-20\n");
  EXPECT_NEAR(value(recording, 1, "IndexMPJ"), 46 * kDegree, 1e-9);
  EXPECT_NEAR(value(recording, 0, "WristPitch"), -20 * kDegree, 1e-9);
  EXPECT_NEAR(recording.times[1], 0.01, 1e-12) << "no times: as fast as gloves measure";
}

TEST_F(Tables, LeaveOutRowsWithGapsAndColumnsWithoutAnyNumber) {
  const Recording recording = read(
      "t\tIndexMPJ\tIndexPIJ\tRingDIJ\n"
      "0\t0.1\t0.2\tNaN\n0.1\tNaN\t0.2\t\n0.2\t0.3\t\t\n0.3\t0.4\t0.5\tNaN\n");
  EXPECT_EQ(recording.values.cols(), 2);
  ASSERT_EQ(recording.values.rows(), 2);
  EXPECT_EQ(recording.times[1], 0.3);
  EXPECT_EQ(value(recording, 1, "IndexPIJ"), 0.5);
  EXPECT_THAT(recording.warnings, testing::Contains(HasSubstr("2 of 4 rows left out")));
  EXPECT_THAT(recording.warnings, testing::Contains(HasSubstr("passed over: RingDIJ")));
}

TEST_F(Tables, TurnSignsWhereBendingIsNegative) {
  const Recording recording = read(
      "IndexMPJ,IndexPIJ,MiddleMPJ,MiddlePIJ,RingMPJ,RingMiddleAbduct\n"
      "-10.5,-45,-20,-60,5,4\n-30.5,-50,-30,-70,-2,4\n");
  EXPECT_NEAR(value(recording, 0, "IndexPIJ"), 45 * kDegree, 1e-9);
  EXPECT_NEAR(value(recording, 0, "RingMPJ"), -5 * kDegree, 1e-9);
  EXPECT_NEAR(value(recording, 0, "RingMiddleAbduct"), 4 * kDegree, 1e-9);
  EXPECT_THAT(recording.warnings, testing::Contains(HasSubstr("turned")));
}

TEST_F(Tables, ReadTheOrderOfAGloveWithoutNames) {
  const auto counts = [](int columns, int first) {
    std::string text = std::to_string(first);
    for (int c = 1; c < columns; ++c) {
      text += ' ' + std::to_string(first + c);
    }
    return text + '\r';
  };
  const Recording plain = read(counts(22, 100) + counts(22, 101));
  EXPECT_EQ(plain.header.kind, RecordingKind::kCounts);
  EXPECT_EQ(value(plain, 1, "IndexMPJ"), 105.0);
  std::string timed;
  for (int row = 0; row < 6; ++row) {
    timed += std::to_string(0.02 * row) + ' ' + counts(18, 100);
  }
  const Recording with_times = read(timed);
  EXPECT_NEAR(with_times.times[5], 0.1, 1e-9);
  EXPECT_EQ(value(with_times, 0, "MiddleMPJ"), 106.0) << "18 sensors, without the distal ones";
}

TEST_F(Tables, ReadVirtualHandLogsHoweverTheyAreSeparated) {
  std::string row = "2014;12;31;23;59;59,5;1";
  for (int slot = 0; slot < 23; ++slot) {
    row += ";-0," + std::to_string(10 + slot);
  }
  const Recording recording = read(row + "\n" + row + "\n");
  EXPECT_EQ(recording.values.rows(), 2);
  EXPECT_NEAR(value(recording, 0, "IndexMPJ"), 0.14, 1e-9);
}

TEST_F(Tables, SayWhatColumnsWithoutNamesMayBe) {
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read("1 2 3\n4 5 6\n")); }),
              AllOf(HasSubstr("3 columns without names"), HasSubstr("map")));
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read("time,x,y\n0,5,6\n")); }),
              AllOf(HasSubstr("x, y"), HasSubstr("map")));
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read("time,g\n0,700.5\n")); }),
              AllOf(HasSubstr("700.5"), HasSubstr("gains")));
}

// HUST's and others' files have matrices by any name, sensors along either side, in structures.
TEST_F(Tables, ReadTheOneMatrixOfAGloveInAMatlabFile) {
  std::vector<double> degrees(2 * 22, 10.5);
  degrees[22 + 4] = 45.0;
  degrees[0] = std::numeric_limits<double>::quiet_NaN();
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    for (const bool in_structure : {false, true}) {
      version_ = version;
      in_structure_ = in_structure;
      const Recording recording =
          read_recording(write_matlab("hand.mat", "joint_data", 22, degrees));
      ASSERT_EQ(recording.values.rows(), 1) << "the first has a gap";
      EXPECT_NEAR(value(recording, 0, "IndexMPJ"), 45 * kDegree, 1e-9);
    }
  }
  version_ = MAT_FT_MAT5;
  in_structure_ = false;
  std::vector<double> along(22 * 40, 100.0);
  along[4 * 40 + 39] = 130.0;
  const Recording turned = read_recording(write_matlab("turned.mat", "glove", 40, along));
  ASSERT_EQ(turned.values.rows(), 40);
  EXPECT_EQ(value(turned, 39, "IndexMPJ"), 130.0);
}

}  // namespace
}  // namespace handway::device
