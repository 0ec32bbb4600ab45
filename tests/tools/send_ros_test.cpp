/// `handway send` on emulated robots in ROS.
#include "background_process.h"
#include "command_line.h"
#include "sent_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace handway::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// An emulated robot at the scene's start, and a path of the scene.
class SendToRos : public testing::Test {
 protected:
  void SetUp() override { line_.write("path.csv", planned_path()); }

  void emulate(const std::vector<std::string>& options) {
    std::vector<std::string> words{"ros", "emulate", "--port", "0", "--scene", scene()};
    words.insert(words.end(), options.begin(), options.end());
    robot_ = std::make_unique<BackgroundProcess>(words);
    address_ = robot_->read_line();
  }

  [[nodiscard]] Outcome send(const std::string& to, const std::string& options) const {
    return line_.run("send path.csv --scene " + scene() + " --to " + to + " --log log.csv " +
                     options);
  }

  CommandLine line_;
  std::string address_;

 private:
  std::unique_ptr<BackgroundProcess> robot_;
};

TEST_F(SendToRos, RunsAWholePathOnOneController) {
  emulate({});
  const Outcome done = send(address_, "--yes --speed 0.2");
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("cleared"), HasSubstr("19 joints"), HasSubstr("joint_6"),
                              HasSubstr("ring_medial"), HasSubstr("done")));
  const double joint_4 = number_after(done.out, "joint_4 +");
  EXPECT_GT(joint_4, 1e-4) << "servos lag";
  EXPECT_LT(joint_4, 0.1);
  EXPECT_GT(lines_of(line_.read("log.csv")).size(), 50U * 2U) << "100 Hz";
}

TEST_F(SendToRos, RunsArmAndHandOnControllersOfTheirOwnInRos2) {
  emulate({});
  const std::string where = "ros2" + address_.substr(address_.find("://"));
  const Outcome done =
      send(where + "/arm_controller#arm," + where + "/hand_controller#hand", "--yes --speed 0.5");
  EXPECT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("6 joints"), HasSubstr("13 joints"), HasSubstr("done")));
}

TEST_F(SendToRos, RefusesTwoDevicesForAJointAndWrongAddresses) {
  const auto refusal = [&](const std::string& to) {
    const Outcome done = send(to, "--yes");
    EXPECT_EQ(done.exit_code, 3) << to;
    return done.err;
  };
  EXPECT_THAT(refusal("ros://localhost:1,arm://localhost:1"), HasSubstr("two devices for the arm"));
  EXPECT_THAT(refusal("ros://localhost:1#leg"), HasSubstr("#arm"));
  EXPECT_THAT(refusal("ros://"), HasSubstr("ros://HOST"));
  EXPECT_THAT(refusal("ros:///controller"), HasSubstr("ros://HOST"));
  EXPECT_THAT(refusal("ros://localhost:99999"), HasSubstr("65535"));
  EXPECT_THAT(refusal("ros://localhost:1"), HasSubstr("ros://localhost:1"));
}

struct RosFaultCase {
  const char* fault;
  const char* message;
};

class SendToFaultyRos : public SendToRos, public testing::WithParamInterface<RosFaultCase> {};

TEST_P(SendToFaultyRos, StopsAndKeepsTheLog) {
  emulate({"--fault", GetParam().fault, "--fault-after", "0.5"});
  const Outcome done = send(address_, "--yes --speed 0.2 --following-tolerance 0.05");
  EXPECT_EQ(done.exit_code, kMotionStopped) << done.out;
  EXPECT_THAT(done.err, AllOf(HasSubstr(GetParam().message), HasSubstr("ros://")));
  EXPECT_LT(number_after(done.out, "STOPPED at"), 2.1) << done.out;
  EXPECT_LT(number_after(done.out, "STOP sent to all devices within"), 100.0) << done.out;
  EXPECT_THAT(done.out, AllOf(HasSubstr("following error"), Not(HasSubstr("done"))));
  EXPECT_GT(lines_of(line_.read("log.csv")).size(), 30U);
}

INSTANTIATE_TEST_SUITE_P(Faults, SendToFaultyRos,
                         testing::Values(RosFaultCase{"late", "no joint positions"},
                                         RosFaultCase{"lost", "connection broke"},
                                         RosFaultCase{"refused", "the controller is not running"},
                                         RosFaultCase{"estop", "emergency stop"},
                                         RosFaultCase{"joint-limit", "error 2"},
                                         RosFaultCase{"slow", "does not follow"}),
                         [](const auto& test) {
                           std::string name = test.param.fault;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace handway::test
