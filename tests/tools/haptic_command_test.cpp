/// `handway haptic guide` on an emulated device, with and without an emulated robot.
#include "background_process.h"
#include "command_line.h"
#include "sent_path.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

namespace handway::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class Haptic : public testing::Test {
 protected:
  void SetUp() override { line_.write("path.csv", planned_path()); }

  /// @returns what the emulated device is to be called by.
  std::string emulate(const std::vector<std::string>& options = {}) {
    std::vector<std::string> words{"haptic", "emulate", "--port", "0"};
    words.insert(words.end(), options.begin(), options.end());
    device_ = std::make_unique<BackgroundProcess>(words);
    return device_->read_line();
  }

  [[nodiscard]] Outcome guide(const std::string& to, const std::string& options = "") const {
    return line_.run("haptic guide path.csv --scene " + scene() + " --to " + to + " " + options);
  }

  CommandLine line_;
  std::unique_ptr<BackgroundProcess> device_;
};

TEST_F(Haptic, GuidesAHandToThePathsEnd) {
  const Outcome done = guide(emulate(), "--speed 0.5 --max-force 2 --log log.csv");
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("forces up to 2.00 N"), HasSubstr("grips"),
                              HasSubstr("done: the path's end is reached")));
  EXPECT_LE(number_after(done.out, "largest force"), 2.0);
  const std::vector<std::string> log = lines_of(line_.read("log.csv"));
  ASSERT_GT(log.size(), 50U);
  EXPECT_THAT(log.front(), StartsWith("time,progress,place,button,deviation,force.x,"));
}

TEST_F(Haptic, LeadsARobotThereToo) {
  BackgroundProcess robot({"ros", "emulate", "--port", "0", "--scene", scene()});
  const std::string where = robot.read_line();
  const std::string device = emulate();
  const Outcome dry = guide(device, "--robot " + where);
  EXPECT_EQ(dry.exit_code, 2);
  EXPECT_THAT(dry.err, HasSubstr("--yes"));
  const Outcome done = guide(device, "--speed 0.5 --yes --robot " + where);
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  const Outcome again = guide(device, "--speed 0.5 --yes --robot " + where);
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_THAT(again.err, AllOf(HasSubstr("joint_"), HasSubstr("the path's start")));
}

TEST_F(Haptic, LeadsNoRobotThroughASceneThatWasEdited) {
  BackgroundProcess robot({"ros", "emulate", "--port", "0", "--scene", scene()});
  const std::string where = robot.read_line();
  std::ifstream shipped(scene());
  const std::filesystem::path edited =
      line_.write("edited.yaml", {std::istreambuf_iterator<char>(shipped), {}});
  // The program waits for a reader of its log: between its first check and the start.
  const std::string log = (line_.folder() / "log").string();
  ASSERT_EQ(mkfifo(log.c_str(), 0600), 0);
  BackgroundProcess guiding({"haptic", "guide", (line_.folder() / "path.csv").string(), "--scene",
                             edited.string(), "--to", emulate(), "--yes", "--log", log, "--robot",
                             where});
  std::string line = "-";
  while (!line.empty() && line.find("of the tool") == std::string::npos) {
    line = guiding.read_line();
  }
  line_.replace("edited.yaml", "objects:\n",
                "objects:\n  - {name: wall, box: {size: [1.5, 0.02, 3]}, "
                "pose: {xyz: [0.92, 0.39, 0], rpy_deg: [0, 0, 23]}}\n");
  const int reader = open(log.c_str(), O_RDONLY | O_NONBLOCK);
  EXPECT_EQ(guiding.wait(), 1);
  close(reader);
}

TEST_F(Haptic, EndsIfItsLogCannotBeWritten) {
  const Outcome run = guide(emulate(), "--log no/such/folder/log.csv");
  EXPECT_EQ(run.exit_code, 1) << run.out;
  EXPECT_THAT(run.err, HasSubstr("no/such/folder/log.csv"));
}

TEST_F(Haptic, RefusesWhatMakesNoSense) {
  EXPECT_THAT(guide("arm://localhost").err, HasSubstr("haptic://HOST"));
  EXPECT_EQ(guide("haptic://localhost:1").exit_code, 3);
  EXPECT_THAT(guide("haptic://localhost:1", "--robot hand://localhost").err, HasSubstr("ros://"));
  EXPECT_THAT(guide("haptic://localhost:1", "--link leg").err, HasSubstr("leg"));
  EXPECT_EQ(guide("haptic://localhost:1", "--max-force nan").exit_code, 2);
}

struct HapticFaultCase {
  const char* fault;
  const char* message;
};

class FaultyHapticCommand : public Haptic, public testing::WithParamInterface<HapticFaultCase> {};

TEST_P(FaultyHapticCommand, EndsWithoutForceAndKeepsTheLog) {
  const std::string device = emulate({"--fault", GetParam().fault, "--fault-after", "0.4"});
  const Outcome done = guide(device, "--log log.csv");
  EXPECT_EQ(done.exit_code, kMotionStopped) << done.out << done.err;
  EXPECT_THAT(done.err, AllOf(HasSubstr(GetParam().message), HasSubstr("haptic://")));
  EXPECT_THAT(done.out, AllOf(HasSubstr("STOPPED after a fault"), Not(HasSubstr("done"))));
  EXPECT_GT(lines_of(line_.read("log.csv")).size(), 10U);
}

INSTANTIATE_TEST_SUITE_P(Faults, FaultyHapticCommand,
                         testing::Values(HapticFaultCase{"late", "no position"},
                                         HapticFaultCase{"lost", "connection broke"},
                                         HapticFaultCase{"refused", "too warm"},
                                         HapticFaultCase{"estop", "emergency stop"}),
                         [](const auto& test) { return std::string(test.param.fault); });

}  // namespace
}  // namespace handway::test
