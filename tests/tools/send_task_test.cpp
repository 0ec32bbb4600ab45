/// `handway task --to`: whole tasks on an emulated arm and hand.
#include "background_process.h"
#include "command_line.h"
#include "handway_test/paths.h"
#include "sent_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace handway::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// An emulated arm and hand at the start of a scene in which a can is put down elsewhere.
class SendTask : public testing::Test {
 protected:
  SendTask()
      : scene_(line_.write("can.yaml", line_.read(scene()))),
        arm_({"arm", "emulate", "--port", "0", "--scene", scene_.string()}),
        hand_({"hand", "emulate", "--port", "0", "--scene", scene_.string()}),
        targets_(arm_.read_line() + "," + hand_.read_line()) {}

  [[nodiscard]] std::string task(const std::string& options) const {
    return "task can.yaml --pick can --place-on table --to " + targets_ + " " + options;
  }

  CommandLine line_;
  std::filesystem::path scene_;
  BackgroundProcess arm_;
  BackgroundProcess hand_;
  std::string targets_;
};

TEST_F(SendTask, PicksAndPlacesStageByStage) {
  const Outcome done = line_.run(task("--yes --speed 0.5 --log log.csv"));
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_THAT(
      done.out,
      AllOf(HasSubstr("1 of 10: approach (pick can)"), HasSubstr("4 of 10: hold (pick can)"),
            HasSubstr("10 of 10: retreat (place on table)"), HasSubstr("done: ")));
  EXPECT_LT(number_after(done.out, "thumb_medial +"), 0.1);
  const Outcome compared = line_.run("compare log.csv");
  EXPECT_EQ(compared.exit_code, 0) << compared.err;
}

TEST_F(SendTask, WaitsAndNamesOutputsBeforeAnythingMoves) {
  line_.write("task.yaml",
              "handway_task: 1\nsteps:\n  - output: {name: do3, value: true}\n  - wait: 1\n"
              "  - move: ready\n  - wait: 0.5\n");
  const std::string send = "task can.yaml --task task.yaml --to " + targets_ + " --speed 0.5";
  const Outcome checked = line_.run(send);
  EXPECT_EQ(checked.exit_code, 2);
  EXPECT_THAT(checked.err, HasSubstr("The devices do not set these outputs: do3 to true."));
  const Outcome done = line_.run(send + " --yes");
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("1 of 3: wait 1 s"), HasSubstr("3 of 3: wait 0.5 s"),
                              HasSubstr("done: ")));
}

TEST_F(SendTask, MovesNothingWithoutYes) {
  const Outcome checked = line_.run(task("--speed 0.5"));
  EXPECT_EQ(checked.exit_code, 2);
  EXPECT_THAT(checked.out, AllOf(HasSubstr("cleared"), Not(HasSubstr("1 of 10"))));
  EXPECT_THAT(checked.err, HasSubstr("--yes"));
}

TEST_F(SendTask, RefusesARobotThatStandsElsewhere) {
  ASSERT_EQ(line_.run(task("--yes --speed 1")).exit_code, 0);
  const Outcome again = line_.run(task("--yes --speed 1"));
  EXPECT_EQ(again.exit_code, 1) << "it stands beside the can";
  EXPECT_THAT(again.err, HasSubstr("away from the start of the trajectory"));
}

TEST_F(SendTask, StopsWhenTheSceneIsEdited) {
  BackgroundProcess sending({"task", scene_.string(), "--pick", "can", "--place-on", "table",
                             "--to", targets_, "--yes", "--speed", "0.2"});
  const auto skip_to = [&](const std::string& words) {
    std::string line = "-";
    while (!line.empty() && line.find(words) == std::string::npos) {
      line = sending.read_line();
    }
    return line;
  };
  ASSERT_THAT(skip_to("0.5 of "), HasSubstr("arm error up to"));
  line_.write("new.yaml", line_.read("can.yaml") + "\n# edited\n");
  std::filesystem::rename(line_.folder() / "new.yaml", scene_);
  EXPECT_THAT(skip_to("paused"), HasSubstr("plan the task again"));
  EXPECT_THAT(skip_to("STOPPED"), HasSubstr("because of the scene"));
  EXPECT_EQ(sending.wait(), kMotionStopped);
}

}  // namespace
}  // namespace handway::test
