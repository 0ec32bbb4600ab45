/// `handway send` on emulated devices: whole paths, every fault, and stops.
#include "background_process.h"
#include "command_line.h"
#include "handway_test/flooding_proxy.h"
#include "sent_path.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace handway::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

/// An emulated arm and hand at the scene's start, and a path of the scene.
class Send : public testing::Test {
 protected:
  void SetUp() override { line_.write("path.csv", planned_path()); }

  void emulate(const std::vector<std::string>& arm_options,
               const std::vector<std::string>& hand_options) {
    arm_ = emulator("arm", arm_options);
    hand_ = emulator("hand", hand_options);
    targets_ = arm_->read_line() + "," + hand_->read_line();
  }

  [[nodiscard]] std::string send(const std::string& options) const {
    return "send path.csv --scene " + scene() + " --to " + targets_ + " --log log.csv " + options;
  }

  /// The log's rows without its header; all of the same width.
  [[nodiscard]] std::vector<std::string> log_rows() const {
    std::vector<std::string> rows = lines_of(line_.read("log.csv"));
    if (rows.empty()) {
      return rows;
    }
    EXPECT_THAT(rows.front(), StartsWith("time,device,joint_1,"));
    EXPECT_THAT(rows.front(), HasSubstr(",ring_medial.measured"));
    const auto width = [](const std::string& row) { return std::ranges::count(row, ','); };
    for (const std::string& row : rows) {
      EXPECT_EQ(width(row), width(rows.front())) << row;
    }
    rows.erase(rows.begin());
    return rows;
  }

  CommandLine line_;
  std::string targets_;

 private:
  static std::unique_ptr<BackgroundProcess> emulator(const std::string& kind,
                                                     const std::vector<std::string>& options) {
    std::vector<std::string> words{kind, "emulate", "--port", "0", "--scene", scene()};
    words.insert(words.end(), options.begin(), options.end());
    return std::make_unique<BackgroundProcess>(words);
  }

  std::unique_ptr<BackgroundProcess> arm_;
  std::unique_ptr<BackgroundProcess> hand_;
};

TEST_F(Send, RunsAWholePathOnArmAndHand) {
  emulate({}, {});
  const Outcome done = line_.run(send("--yes --speed 0.2"));
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("cleared"), HasSubstr("following error"),
                              HasSubstr("joint_6"), HasSubstr("done")));
  const double joint_4 = number_after(done.out, "joint_4 +");
  EXPECT_GT(joint_4, 1e-4) << "servos lag";
  EXPECT_LT(joint_4, 0.1);
  const double duration = number_after(done.out, "done:");
  const Outcome timed = line_.run("time path.csv --scene " + scene() + " --speed 0.2");
  EXPECT_NEAR(duration, number_after(timed.out, "points,"), 0.3);
  EXPECT_GT(log_rows().size(), 100.0 * duration) << "100 Hz of the hand, 50 Hz of the arm";
}

TEST_F(Send, WritesALogThatIsComparedWithThePlan) {
  emulate({}, {});
  ASSERT_EQ(line_.run(send("--yes --speed 0.5")).exit_code, 0);
  const Outcome compared = line_.run("compare log.csv --plots");
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  EXPECT_THAT(compared.out, AllOf(HasSubstr("arm: "), HasSubstr("hand: "), HasSubstr("joint_6"),
                                  HasSubstr("ring_medial"), HasSubstr("RMS [rad]")));
  EXPECT_THAT(line_.read("log.svg"),
              AllOf(HasSubstr(">joint_6</text>"), HasSubstr(">error [mrad]</text>")));
  line_.write("broken.csv", "time,device,a,a.measured\n0.1,arm,0.5,x\n");
  const Outcome broken = line_.run("compare broken.csv");
  EXPECT_EQ(broken.exit_code, 3);
  EXPECT_THAT(broken.err, AllOf(HasSubstr("broken.csv:2"), HasSubstr("\"x\"")));
  line_.write("empty.csv", "time,device,a,a.measured\n0.1,arm,,0.5\n");
  const Outcome empty = line_.run("compare empty.csv");
  EXPECT_EQ(empty.exit_code, 3);
  EXPECT_THAT(empty.err,
              AllOf(HasSubstr("empty.csv:2"), HasSubstr("no number for any joint of arm")));
  EXPECT_EQ(line_.run("compare path.csv").exit_code, 3);
}

TEST_F(Send, EndsIfItsLogCannotBeWritten) {
  emulate({}, {});
  std::string words = send("--yes");
  words.replace(words.find("log.csv"), std::string("log.csv").size(), "no/such/folder/log.csv");
  const Outcome run = line_.run(words);
  EXPECT_EQ(run.exit_code, 1) << run.out;
  EXPECT_THAT(run.err, HasSubstr("no/such/folder/log.csv"));
}

TEST_F(Send, MovesNothingWithoutYes) {
  emulate({}, {});
  const Outcome done = line_.run(send(""));
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.out,
              AllOf(HasSubstr("cleared"), HasSubstr("no acceleration limits given"),
                    HasSubstr("6 joints"), HasSubstr("13 joints"), Not(HasSubstr("done"))));
  EXPECT_THAT(done.err, HasSubstr("--yes"));
  EXPECT_FALSE(std::filesystem::exists(line_.folder() / "log.csv"));
  const Outcome then = line_.run(send("--yes --speed 0.5"));
  EXPECT_EQ(then.exit_code, 0) << "it still stands at the start: " << then.out << then.err;
}

TEST_F(Send, RefusesARobotThatStandsElsewhere) {
  emulate({}, {});
  ASSERT_EQ(line_.run(send("--yes --speed 0.5")).exit_code, 0);
  const Outcome again = line_.run(send("--yes"));
  EXPECT_EQ(again.exit_code, 1) << "it stands at the goal now";
  EXPECT_THAT(again.out,
              AllOf(HasSubstr("away from the start of the trajectory"), HasSubstr("NOT CLEARED")));
}

TEST_F(Send, StopsOnRequestWithinATenthOfASecond) {
  emulate({}, {});
  BackgroundProcess sending({"send", (line_.folder() / "path.csv").string(), "--scene", scene(),
                             "--to", targets_, "--log", (line_.folder() / "log.csv").string(),
                             "--yes"});
  const auto skip_to = [&](const std::string& words) {
    for (int k = 0; k < 100; ++k) {
      const std::string line = sending.read_line();
      if (line.find(words) != std::string::npos) {
        return line;
      }
    }
    return std::string();
  };
  ASSERT_THAT(skip_to("1.0 of "), HasSubstr("arm error up to")) << "progress";
  sending.send(SIGINT);
  const std::string stopped = skip_to("STOPPED");
  EXPECT_EQ(sending.wait(), kMotionStopped);
  EXPECT_THAT(stopped, HasSubstr("on request"));
  EXPECT_LT(number_after(stopped, "STOP sent to all devices within"), 100.0) << stopped;
  EXPECT_LT(number_after(stopped, "at rest"), 1000.0) << stopped;
  EXPECT_GT(log_rows().size(), 60U);
}

/// Sending to the arm, and to the hand through a proxy that can flood.
class SendToAFloodingHand : public Send {
 protected:
  void SetUp() override {
    Send::SetUp();
    emulate({}, {});
    const std::size_t hand = targets_.find(',') + 1;
    proxy_ = std::make_unique<FloodingProxy>(port_of(targets_.substr(hand)));
    targets_.resize(hand);
    targets_ += "hand://localhost:" + std::to_string(proxy_->port());
  }
  [[nodiscard]] BackgroundProcess start() const {
    return BackgroundProcess({"send", (line_.folder() / "path.csv").string(), "--scene", scene(),
                              "--to", targets_, "--yes"});
  }
  /// Interrupts it. @returns how long it goes on, s.
  static double interrupt(BackgroundProcess& sending) {
    const auto begin = std::chrono::steady_clock::now();
    sending.send(SIGINT);
    EXPECT_EQ(sending.wait(), kMotionStopped) << "not as if the devices were wrong";
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  std::unique_ptr<FloodingProxy> proxy_;
};

TEST_F(SendToAFloodingHand, EndsOnRequestUnderWay) {
  BackgroundProcess sending = start();
  std::string line = "-";
  while (!line.empty() && line.find("0.5 of") == std::string::npos) {
    line = sending.read_line();
  }
  ASSERT_THAT(line, HasSubstr("arm error up to"));
  proxy_->flood();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_LT(interrupt(sending), 2.0) << "at most 1.5 s until the devices are seen at rest";
  EXPECT_GT(proxy_->flooded(), 1000000U);
}

TEST_F(SendToAFloodingHand, EndsOnRequestBeforeItIsConnected) {
  proxy_->flood("\n");
  BackgroundProcess sending = start();
  const auto begin = std::chrono::steady_clock::now();
  while (proxy_->flooded() == 0 &&
         std::chrono::steady_clock::now() - begin < std::chrono::seconds(10)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_LT(interrupt(sending), 1.0);
}

/// Sending in a scene whose file is edited while the robot moves.
class SendInAnEditedScene : public Send {
 protected:
  void SetUp() override {
    Send::SetUp();
    emulate({}, {});
    std::ifstream shipped(scene());
    edited_ = line_.write("edited.yaml", {std::istreambuf_iterator<char>(shipped), {}});
    sending_ = std::make_unique<BackgroundProcess>(
        std::vector<std::string>{"send", (line_.folder() / "path.csv").string(), "--scene",
                                 edited_.string(), "--to", targets_, "--yes"});
    ASSERT_THAT(skip_to("0.5 of "), HasSubstr("arm error up to"));
  }

  std::string skip_to(const std::string& words) {
    std::string line = "-";
    while (!line.empty() && line.find(words) == std::string::npos) {
      line = sending_->read_line();
    }
    return line;
  }
  // All at once, as editors write.
  void add_object(const std::string& object) const {
    const std::string before = line_.read("edited.yaml");
    std::string text = before;
    const std::string key = "objects:\n";
    text.insert(text.find(key) + key.size(), "  - " + object + "\n");
    line_.write("new.yaml", text);
    std::filesystem::rename(line_.folder() / "new.yaml", edited_);
  }

  std::filesystem::path edited_;
  std::unique_ptr<BackgroundProcess> sending_;
};

TEST_F(SendInAnEditedScene, StopsForAWallInTheWay) {
  add_object(
      "{name: wall, box: {size: [1.5, 0.02, 3]}, pose: {xyz: [0.92, 0.39, 0], rpy_deg: [0, 0, "
      "23]}}");
  EXPECT_THAT(skip_to("STOPPED"), HasSubstr("because of the scene"));
  EXPECT_EQ(sending_->wait(), kMotionStopped);
}

TEST_F(SendInAnEditedScene, GoesOnIfTheRestIsFree) {
  add_object("{name: far, box: {size: [0.1, 0.1, 0.1]}, pose: {xyz: [9, 9, 0]}}");
  EXPECT_THAT(skip_to("done"), HasSubstr("done"));
  EXPECT_EQ(sending_->wait(), 0);
}

TEST_F(SendInAnEditedScene, StopsIfItsFileCanNotBeRead) {
  line_.write("edited.yaml", "handway: 1\nrobots: [\n");
  EXPECT_THAT(skip_to("STOPPED"), HasSubstr("because of the scene"));
  EXPECT_EQ(sending_->wait(), kMotionStopped);
}

TEST_F(Send, ChecksTheSceneAsItsFileIsWhenTheRobotStarts) {
  emulate({}, {});
  std::ifstream shipped(scene());
  const std::filesystem::path edited =
      line_.write("edited.yaml", {std::istreambuf_iterator<char>(shipped), {}});
  // The program waits for a reader of its log: between its checks and the start.
  const std::string log = (line_.folder() / "log").string();
  ASSERT_EQ(mkfifo(log.c_str(), 0600), 0);
  BackgroundProcess sending({"send", (line_.folder() / "path.csv").string(), "--scene",
                             edited.string(), "--to", targets_, "--log", log, "--yes"});
  std::string line = sending.read_line();
  EXPECT_THAT(line, HasSubstr("cleared"));
  while (!line.empty() && line.find("13 joints") == std::string::npos) {
    line = sending.read_line();
  }
  line_.replace("edited.yaml", "objects:\n",
                "objects:\n  - {name: wall, box: {size: [1.5, 0.02, 3]}, "
                "pose: {xyz: [0.92, 0.39, 0], rpy_deg: [0, 0, 23]}}\n");
  const int reader = open(log.c_str(), O_RDONLY | O_NONBLOCK);
  EXPECT_EQ(sending.wait(), 1);
  close(reader);
  const Outcome then = line_.run(send("--yes --speed 0.5"));
  EXPECT_EQ(then.exit_code, 0) << "it still stands at the start: " << then.out << then.err;
}

TEST_F(Send, RefusesTargetsThatMakeNoSense) {
  const auto refusal = [&](const std::string& to) {
    const Outcome done = line_.run("send path.csv --scene " + scene() + " --yes --to " + to);
    EXPECT_EQ(done.exit_code, 3) << to;
    EXPECT_THAT(done.out, IsEmpty());
    return done.err;
  };
  EXPECT_THAT(refusal("leg://localhost:1"), HasSubstr("arm://"));
  EXPECT_THAT(refusal("localhost:11000"), HasSubstr("arm://"));
  EXPECT_THAT(refusal("arm://localhost:1,arm://localhost:2"), HasSubstr("two devices"));
  EXPECT_THAT(refusal("arm://localhost:99999"), HasSubstr("65535"));
  EXPECT_THAT(refusal("arm://localhost:1"), AllOf(HasSubstr("joint"), HasSubstr("No device")));
  EXPECT_THAT(refusal("arm://localhost:1,hand://localhost:1"), HasSubstr("arm://localhost:1"));
}

struct FaultCase {
  const char* device;
  const char* fault;
  const char* message;
};

class SendWithFault : public Send, public testing::WithParamInterface<FaultCase> {};

TEST_P(SendWithFault, StopsAllDevicesAndKeepsTheLog) {
  const std::vector<std::string> fault{"--fault", GetParam().fault, "--fault-after", "0.5"};
  const bool arm = std::string(GetParam().device) == "arm";
  emulate(arm ? fault : std::vector<std::string>{}, arm ? std::vector<std::string>{} : fault);
  // The motion is so slow that a device which a busy machine delays by a tenth of a second still
  // follows.
  const bool is_slow = std::string(GetParam().fault) == "slow";
  const Outcome done = line_.run(send(is_slow ? "--yes --speed 0.1 --following-tolerance 0.05"
                                              : "--yes --speed 0.2 --following-tolerance 0.2"));
  EXPECT_EQ(done.exit_code, kMotionStopped) << done.out;
  EXPECT_THAT(done.err, AllOf(HasSubstr(GetParam().message),
                              HasSubstr(std::string(GetParam().device) + "://")));
  EXPECT_LT(number_after(done.out, "STOPPED at"), is_slow ? 4.2 : 2.1) << done.out;
  EXPECT_LT(number_after(done.out, "STOP sent to all devices within"), 100.0) << done.out;
  EXPECT_THAT(done.out, AllOf(HasSubstr("following error"), Not(HasSubstr("done"))));
  EXPECT_GT(log_rows().size(), 30U);
}

INSTANTIATE_TEST_SUITE_P(Faults, SendWithFault,
                         testing::Values(FaultCase{"arm", "late", "no joint positions"},
                                         FaultCase{"arm", "lost", "connection broke"},
                                         FaultCase{"arm", "refused", "refused"},
                                         FaultCase{"arm", "estop", "emergency stop"},
                                         FaultCase{"arm", "joint-limit", "refused"},
                                         FaultCase{"arm", "slow", "does not follow"},
                                         FaultCase{"hand", "late", "no joint positions"},
                                         FaultCase{"hand", "lost", "connection broke"},
                                         FaultCase{"hand", "refused", "refused"},
                                         FaultCase{"hand", "estop", "emergency stop"},
                                         FaultCase{"hand", "joint-limit", "at its limit"},
                                         FaultCase{"hand", "slow", "does not follow"}),
                         [](const auto& test) {
                           std::string name =
                               std::string(test.param.device) + "_" + test.param.fault;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace handway::test
