#include "handway/device/glove/recording.h"

#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace handway::device {
namespace {

using geometric::InputError;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class RecordingFile : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path write(const std::string& text) const {
    std::ofstream(file()) << text;
    return file();
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "recording.csv"; }
  [[nodiscard]] std::string content() const {
    std::ostringstream text;
    text << std::ifstream(file()).rdbuf();
    return text.str();
  }
  [[nodiscard]] std::string refusal(const std::string& text) const {
    try {
      (void)read_recording(write(text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  test::ScratchFolder folder_;
};

Recording two_rows() {
  Recording recording;
  recording.header = {
      RecordingKind::kAngles, "CyberGlove", "2026-03-01T12:00:00", "seed 7", {4, 0}};
  recording.times = Eigen::Vector2d(0.0, 0.01);
  recording.values = Eigen::Matrix2d{{0.1, 1.0 / 3.0}, {-1.5, 0.0}};
  return recording;
}

TEST_F(RecordingFile, IsReadAsItWasWritten) {
  const Recording written = two_rows();
  write_recording(written, file());
  const Recording read = read_recording(file());
  EXPECT_EQ(read.header.kind, RecordingKind::kAngles);
  EXPECT_EQ(read.header.device, "CyberGlove");
  EXPECT_EQ(read.header.date, "2026-03-01T12:00:00");
  EXPECT_EQ(read.header.origin, "seed 7");
  EXPECT_EQ(read.header.sensors, written.header.sensors);
  EXPECT_EQ(read.times, written.times);
  EXPECT_EQ(read.values, written.values);
  EXPECT_THAT(read.warnings, IsEmpty());
  EXPECT_EQ(column_of(read.header, 0), 1);
  EXPECT_EQ(column_of(read.header, 9), -1);
}

TEST_F(RecordingFile, LeavesOutALastRowThatIsCutOff) {
  write_recording(two_rows(), file());
  const std::string whole = content();
  const Recording read = read_recording(write(whole.substr(0, whole.size() - 1)));
  EXPECT_EQ(read.times.size(), 1);
  EXPECT_THAT(read.warnings, ElementsAre(HasSubstr(":8: left out, the row is cut off")));
}

TEST_F(RecordingFile, IsNotWrittenWithValuesThatAreNoNumbers) {
  Recording recording = two_rows();
  recording.values(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_recording(recording, file()), std::invalid_argument);
  EXPECT_FALSE(exists(file()));
}

TEST_F(RecordingFile, NamesFileAndLineOfWhatIsWrong) {
  const std::string own = "# handway glove recording 1\n# kind: counts\n";
  EXPECT_THAT(refusal(own + "time,IndexMPJ\n0,1\n0.1,x\n"),
              testing::AllOf(HasSubstr("recording.csv:5: column IndexMPJ"), HasSubstr("\"x\"")));
  EXPECT_THAT(refusal(own + "time,IndexMPJ\n0,1\n0.1,2,3\n"), HasSubstr(":5: found 3 values"));
  EXPECT_THAT(refusal(own + "time,IndxMPJ\n0,1\n"), HasSubstr("IndexMPJ"));
  EXPECT_THAT(refusal(own + "time,g\n0,300\n"), HasSubstr(":4: column IndexMPJ: found 300"));
  EXPECT_THAT(refusal(own + "g,h\n1,1\n"), HasSubstr("0 columns \"time\""));
  EXPECT_THAT(refusal("time,IndexMPJ\n0,1\n0.1,x\n"), HasSubstr("recording.csv:3: column 2"));
  EXPECT_THAT(refusal("time,IndexMPJ\n0,1\n0.1,2,3\n"), HasSubstr(":3: found 3 cells"));
  EXPECT_THAT(refusal("time,IndxMPJ\n0,1\n"), HasSubstr("IndexMPJ"));
  EXPECT_THAT(refusal("time,g,IndexMPJ\n0,1,1\n"), HasSubstr("second time"));
  EXPECT_THAT(refusal("time,g\n"), HasSubstr("no rows"));
  EXPECT_THAT(refusal("\"\n \"\""), HasSubstr("no rows"));
  EXPECT_THAT(refusal("time\n1\n"), HasSubstr("named as the glove's sensors"));
  EXPECT_THAT(refusal("# handway glove recording 1\n# kind: feet\ntime,g\n0,1\n"),
              HasSubstr(":2: kind"));
  EXPECT_THAT(refusal("# handway glove recording 1\n# kind: angles\ntime,g\n0,90\n"),
              HasSubstr("an angle in rad"));
}

TEST_F(RecordingFile, GoesOnWhereTheClockWasSetBack) {
  for (const char* head : {"# handway glove recording 1\n# kind: counts\n", ""}) {
    const Recording read =
        read_recording(write(head + std::string("time,g\n8,1\n8.5,2\n9,3\n2,4\n2.5,5\n")));
    ASSERT_EQ(read.times.size(), 5);
    EXPECT_DOUBLE_EQ(read.times[3], 9.5);
    EXPECT_DOUBLE_EQ(read.times[4], 10.0);
    EXPECT_THAT(read.warnings, Contains(HasSubstr("time runs back by 7 s at line")));
  }
}

TEST_F(RecordingFile, OfOthersIsCountsIfItsNumbersAreWhole) {
  const Recording counts = read_recording(write("g;time;h\r\n120;0;90\r\n121;0.5;90"));
  EXPECT_EQ(counts.header.kind, RecordingKind::kCounts);
  EXPECT_THAT(counts.header.sensors, ElementsAre(*find_sensor("g"), *find_sensor("h")));
  EXPECT_EQ(counts.times[1], 0.5);
  EXPECT_EQ(counts.values(1, 0), 121.0);
  const Recording angles = read_recording(write("time\tg\n0\t-0.25\n"));
  EXPECT_EQ(angles.header.kind, RecordingKind::kAngles);
}

TEST_F(RecordingFile, OfVirtualHandHasFlexionTurnedAndSlotsSorted) {
  std::string row = " 1";
  for (int slot = 0; slot < 23; ++slot) {
    row += " -0." + std::to_string(10 + slot);
  }
  const Recording read =
      read_recording(write("2014 12 31 23 59 59.99000" + row + "\n2015 01 01 00 00 00.00600" + row +
                           " \n2015 01 01 00 00 0"));
  EXPECT_EQ(read.header.kind, RecordingKind::kAngles);
  EXPECT_EQ(read.header.date, "2014-12-31T23:59:59.990");
  ASSERT_EQ(read.times.size(), 2);
  EXPECT_EQ(read.times[1], 0.016);
  EXPECT_EQ(read.values(0, *find_sensor("MiddleMPJ")), 0.18);
  EXPECT_EQ(read.values(0, *find_sensor("WristYaw")), 0.32);
  EXPECT_THAT(read.warnings[0], HasSubstr(":3: left out"));
}

TEST_F(RecordingFile, OfVirtualHandNamesItsBrokenLine) {
  std::string row = " 1";
  for (int slot = 0; slot < 23; ++slot) {
    row += " 0.5";
  }
  const std::string good = "2014 12 31 23 59 59.99000" + row + "\n";
  EXPECT_THAT(refusal(good + "2014 12 31 23 59\n" + good), HasSubstr("recording.csv:2"));
  EXPECT_THAT(refusal(good + "2014 13 31 23 59 59.99000" + row + "\n"),
              HasSubstr("recording.csv:2"));
  EXPECT_EQ(refusal(good + "2014 12 31 23 59 58.99000" + row + "\n"), "") << "time that runs back";
}

TEST_F(RecordingFile, OfTheReferenceIsReadWhole) {
  HANDWAY_NEED_REFERENCE(reference);
  const Recording read = read_recording(reference / "glove" / "calib-rad-su01.txt");
  EXPECT_EQ(read.times.size(), 6674);
  EXPECT_NEAR(read.values(0, 0), 0.90288, 1e-12);
}

TEST_F(RecordingFile, HoldsEveryRowOfAProgramThatIsKilled) {
  constexpr int kRows = 50;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    RecordingWriter writer(file(), {RecordingKind::kCounts, "", "", "", {0, 1, 2}});
    for (int row = 0; row < kRows; ++row) {
      writer.append(0.01 * row, std::array{1.0 * row, 2.0, 255.0});
    }
    (void)kill(getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  const Recording read = read_recording(file());
  EXPECT_EQ(read.times.size(), kRows);
  EXPECT_EQ(read.values(kRows - 1, 0), kRows - 1);
  EXPECT_THAT(read.warnings, IsEmpty());
}

TEST_F(RecordingFile, TakesFramesAsTheGloveSendsThem) {
  GloveFrame frame;
  frame.time = 1.5;
  frame.counts[4] = 77;
  {
    RecordingWriter writer(file(), {RecordingKind::kCounts, "", "", "", {4, 5}});
    writer.append(frame);
    EXPECT_EQ(writer.rows(), 1U);
    frame.time = 1.4;
    EXPECT_THROW(writer.append(frame), std::invalid_argument);
  }
  const Recording read = read_recording(file());
  EXPECT_EQ(read.times[0], 1.5);
  EXPECT_EQ(read.values(0, 0), 77.0);
}

TEST_F(RecordingFile, CannotBeginInAFolderThatIsNotThere) {
  EXPECT_THROW(RecordingWriter(file() / "none.csv", two_rows().header), InputError);
  EXPECT_THROW(RecordingWriter(file(), {RecordingKind::kCounts, "", "", "", {3, 3}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace handway::device
