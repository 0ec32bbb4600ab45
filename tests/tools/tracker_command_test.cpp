#include "background_process.h"
#include "command_line.h"
#include "handway_test/free_port.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>

namespace handway::test {
namespace {

using testing::HasSubstr;

struct Case {
  const char* name;
  std::vector<std::string> emulate;
  const char* live;
  bool udp = false;
};

class TrackerCommand : public testing::TestWithParam<Case> {};

TEST_P(TrackerCommand, EmulatesATrackerAndShowsItLive) {
  std::vector<std::string> arguments{"tracker", "emulate", "--sensors", "2", "--button"};
  arguments.insert(arguments.end(), GetParam().emulate.begin(), GetParam().emulate.end());
  if (GetParam().udp) {
    arguments.insert(arguments.end(), {"--to", free_udp_port()});
  }
  BackgroundProcess emulator(arguments);
  const std::string live =
      "tracker live --device " + emulator.read_line() + " --button " + GetParam().live;
  const CommandLine line;
  const Outcome text = line.run(live + " --samples 3");
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_EQ(lines_of(text.out).size(), 3U);
  EXPECT_THAT(text.err, HasSubstr("3 samples"));
  const Outcome json = line.run(live + " --samples 4 --json");
  ASSERT_EQ(json.exit_code, 0) << json.err;
  const auto lines = lines_of(json.out);
  ASSERT_EQ(lines.size(), 5U);
  const auto sample = nlohmann::json::parse(lines[0]);
  EXPECT_EQ(sample.at("position").size(), 3U);
  EXPECT_EQ(sample.at("quaternion").size(), 4U);
  EXPECT_NE(sample.at("sensor"), nlohmann::json::parse(lines[1]).at("sensor"));
  EXPECT_EQ(nlohmann::json::parse(lines[4]).at("statistics").at("samples"), 4);
  emulator.send(SIGINT);
  EXPECT_EQ(emulator.wait(), 0);
}

INSTANTIATE_TEST_SUITE_P(
    All, TrackerCommand,
    testing::Values(Case{"FastrakOnAPort", {}, "--protocol fastrak"},
                    Case{"FastrakText", {"--tcp", "0"}, "--ascii"},
                    Case{"Liberty", {"--protocol", "liberty", "--tcp", "0"}, "--protocol liberty"},
                    Case{"Udp", {"--protocol", "udp"}, "--protocol udp", true}),
    [](const auto& tested) { return tested.param.name; });

TEST(TrackerLive, ConnectsAgainWhenTheTrackerIsBack) {
  auto emulator = std::make_unique<BackgroundProcess>(
      std::vector<std::string>{"tracker", "emulate", "--tcp", "0"});
  const std::string address = emulator->read_line();
  BackgroundProcess live({"tracker", "live", "--device", address, "--json"});
  double last_time = nlohmann::json::parse(live.read_line()).at("time");
  emulator->send(SIGKILL);
  emulator->wait();
  emulator = std::make_unique<BackgroundProcess>(std::vector<std::string>{
      "tracker", "emulate", "--tcp", address.substr(address.find(':') + 1)});
  ASSERT_EQ(emulator->read_line(), address);
  // Samples sent before the emulator was killed may still arrive.
  bool gap = false;
  for (int k = 0; k < 2000 && !gap; ++k) {
    const double time = nlohmann::json::parse(live.read_line()).at("time");
    gap = time > last_time + 0.2;
    last_time = time;
  }
  EXPECT_TRUE(gap) << "there are samples behind the gap";
  live.send(SIGINT);
  std::string last = live.read_line();
  while (!last.empty() && !last.starts_with(R"({"statistics")")) {
    last = live.read_line();
  }
  EXPECT_EQ(live.wait(), 0);
  EXPECT_EQ(nlohmann::json::parse(last).at("statistics").at("reconnects"), 1);
}

TEST(TrackerLive, EndsWith3WhenThereIsNoTracker) {
  const CommandLine line;
  for (const std::string& device : std::vector<std::string>{
           "/dev/no-such-port", "localhost:1", "/tmp", free_udp_port() + " --protocol udp",
           "many --protocol udp", "/dev/null --protocol liberty --ascii"}) {
    const Outcome outcome = line.run("tracker live --device " + device);
    EXPECT_EQ(outcome.exit_code, 3) << device;
    EXPECT_THAT(outcome.err, HasSubstr("expected")) << device;
  }
  EXPECT_EQ(line.run("tracker live").exit_code, 2);
  EXPECT_EQ(line.run("tracker").exit_code, 2);
  EXPECT_EQ(line.run("tracker live --device x --protocol vicon").exit_code, 2);
}

TEST(TrackerEmulate, SaysWhatItCanNotBe) {
  const CommandLine line;
  const Outcome many = line.run("tracker emulate --sensors 5 --tcp 0");
  EXPECT_EQ(many.exit_code, 3);
  EXPECT_THAT(many.err, HasSubstr("1 to 4"));
  const Outcome nowhere = line.run("tracker emulate --protocol udp");
  EXPECT_EQ(nowhere.exit_code, 3);
  EXPECT_THAT(nowhere.err, HasSubstr("--to 5005"));
}

}  // namespace
}  // namespace handway::test
