#include "command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::test {
namespace {

using testing::HasSubstr;

TEST(RecordingCommand, ConvertsThereAndBackAndShowsTheContents) {
  const CommandLine handway;
  const std::string text = "time,pan,tilt\n0,0.1,0.2\n0.5,0.3,0.4\n";
  handway.write("joints.csv", text);
  EXPECT_EQ(handway.run("recording convert joints.csv --out joints.npz").exit_code, 0);
  EXPECT_EQ(handway.run("recording convert joints.npz --out again.csv").exit_code, 0);
  EXPECT_EQ(handway.read("again.csv"), text);
  const Outcome shown = handway.run("recording info joints.npz");
  EXPECT_EQ(shown.exit_code, 0);
  EXPECT_THAT(shown.out, HasSubstr("2 columns: pan, tilt"));
  EXPECT_THAT(shown.out, HasSubstr("values (2 x 2), float64"));
}

TEST(RecordingCommand, TellsWrongUsageInputAndOutputApart) {
  const CommandLine handway;
  handway.write("joints.csv", "time,pan,tilt\n0,0.1,0.2\n0.5,0.3,0.4\n");
  EXPECT_EQ(handway.run("recording convert joints.csv --out joints.xyz").exit_code, 2);
  EXPECT_EQ(handway.run("recording info missing.npz").exit_code, 3);
  EXPECT_EQ(handway.run("recording convert joints.csv --out missing/joints.h5").exit_code, 1);
}

}  // namespace
}  // namespace handway::test
