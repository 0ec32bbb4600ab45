#include "background_process.h"
#include "command_line.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/landmark_line.h"
#include "handway/device/glove/recording.h"
#include "handway_test/free_port.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <thread>

namespace handway::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::StartsWith;

std::string port_of(const std::string& address) { return address.substr(address.find(':') + 1); }

Eigen::Index rows_of(const fs::path& file) {
  return fs::exists(file) ? device::read_recording(file).times.size() : 0;
}

// Until a recording that is being made has so many rows.
bool wait_for_rows(const fs::path& file, Eigen::Index rows) {
  for (int k = 0; k < 500; ++k) {
    try {
      if (rows_of(file) >= rows) {
        return true;
      }
    } catch (const std::exception&) {
      // The motion has not begun yet.
    }
    std::this_thread::sleep_for(milliseconds(20));
  }
  return false;
}

TEST(GloveEmulate, SaysFirstWhatToConnectTo) {
  BackgroundProcess tcp({"glove", "emulate", "--tcp", "0"});
  EXPECT_THAT(tcp.read_line(), StartsWith("localhost:"));
  BackgroundProcess pty({"glove", "emulate", "--pty"});
  EXPECT_THAT(pty.read_line(), StartsWith("/dev/pts/"));
  pty.send(SIGINT);
  EXPECT_EQ(pty.wait(), 0);
}

TEST(GloveEmulate, SaysWhenThePortIsTaken) {
  BackgroundProcess first({"glove", "emulate", "--tcp", "0"});
  const CommandLine line;
  const Outcome second = line.run("glove emulate --tcp " + port_of(first.read_line()));
  EXPECT_EQ(second.exit_code, 3);
  EXPECT_THAT(second.err, HasSubstr("free"));
}

TEST(GloveLive, ShowsFramesAsLinesAndAsJson) {
  for (const char* where : {"--tcp=0", "--pty"}) {
    BackgroundProcess emulator({"glove", "emulate", where});
    const std::string address = emulator.read_line();
    const CommandLine line;
    const Outcome text = line.run("glove live --device " + address + " --frames 3");
    EXPECT_EQ(text.exit_code, 0) << text.err;
    EXPECT_EQ(lines_of(text.out).size(), 3U);
    const Outcome json = line.run("glove live --device " + address + " --frames 2 --json");
    ASSERT_EQ(json.exit_code, 0) << json.err;
    const auto lines = lines_of(json.out);
    ASSERT_EQ(lines.size(), 3U);
    const auto frame = nlohmann::json::parse(lines[0]);
    EXPECT_EQ(frame.at("counts").size(), 22U);
    EXPECT_GE(frame.at("counts").at("IndexMPJ"), 1);
    EXPECT_TRUE(nlohmann::json::parse(lines[2]).at("statistics").contains("rate_hz"));
  }
}

TEST(GloveLive, ShowsHandLandmarksAsAngles) {
  BackgroundProcess emulator(
      {"glove", "emulate", "--protocol", "landmarks", "--tcp", "0", "--left", "--rate", "100"});
  const std::string address = emulator.read_line();
  EXPECT_THAT(address, StartsWith("landmarks://localhost:"));
  const CommandLine line;
  const Outcome json = line.run("glove live --device " + address + " --frames 2 --json");
  ASSERT_EQ(json.exit_code, 0) << json.err;
  EXPECT_THAT(json.err, HasSubstr("hand landmarks, 19 sensors, left hand"));
  const auto frame = nlohmann::json::parse(lines_of(json.out).front());
  EXPECT_EQ(frame.at("angles").size(), 19U);
  const Outcome text = line.run("glove live --device " + address + " --frames 1");
  EXPECT_EQ(text.exit_code, 0) << text.err;
}

TEST(GloveRecord, RecordsHandLandmarksThatAreSentByUdp) {
  const std::string port = free_udp_port();
  BackgroundProcess emulator(
      {"glove", "emulate", "--protocol", "landmarks", "--to", port.c_str(), "--rate", "200"});
  const std::string address = emulator.read_line();
  EXPECT_EQ(address, "udp://" + port);
  const CommandLine line;
  const Outcome record = line.run("glove record --device " + address + " --frames 100 --out r.csv");
  ASSERT_EQ(record.exit_code, 0) << record.err;
  const device::Recording recording = device::read_recording(line.folder() / "r.csv");
  EXPECT_EQ(recording.header.kind, device::RecordingKind::kAngles);
  EXPECT_EQ(recording.values.rows(), 100);
  EXPECT_EQ(recording.values.cols(), 19);
  EXPECT_EQ(line.run("pca r.csv").exit_code, 0);
}

TEST(GloveLive, ShowsTheHandsOfOtherPrograms) {
  for (const char* protocol : {"openxr", "rokoko", "rokoko-lz4", "manus"}) {
    const std::string port = free_udp_port();
    BackgroundProcess emulator(
        {"glove", "emulate", "--protocol", protocol, "--to", port.c_str(), "--rate", "200"});
    const std::string address = emulator.read_line();
    const CommandLine line;
    const Outcome json = line.run("glove live --device " + address + " --frames 2 --json");
    ASSERT_EQ(json.exit_code, 0) << json.err;
    const auto frame = nlohmann::json::parse(lines_of(json.out).front());
    EXPECT_EQ(frame.at("angles").size(), 19U) << protocol;
    EXPECT_EQ(frame.contains("wrist"), std::string(protocol) != "manus");
  }
}

TEST(GloveLive, ReadsHandsFromAPipeUntilItEnds) {
  const CommandLine line;
  device::GloveAngles angles;
  angles.angles.fill(0.1);
  std::string text;
  for (int row = 0; row < 3; ++row) {
    text += device::write_landmark_line({0.03 * row, false, device::hand_landmarks(angles)}) + "\n";
  }
  line.write("hand.jsonl", text);
  const Outcome live = line.run("glove live --device - < hand.jsonl");
  EXPECT_EQ(live.exit_code, 0) << live.err;
  EXPECT_EQ(lines_of(live.out).size(), 3U);
  line.write("empty.jsonl", "");
  const Outcome empty = line.run("glove live --device - < empty.jsonl");
  EXPECT_EQ(empty.exit_code, 3);
  EXPECT_THAT(empty.err, HasSubstr("the end of the input"));
}

TEST(GloveEmulate, AsksWhereToSendLandmarks) {
  const CommandLine line;
  const Outcome outcome = line.run("glove emulate --protocol landmarks");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("--to"));
}

TEST(GloveLive, EndsWith3WhenThereIsNoGlove) {
  const CommandLine line;
  for (const char* device : {"/dev/no-such-port", "localhost:1", "/tmp"}) {
    const Outcome outcome = line.run("glove live --device " + std::string(device));
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("expected"));
  }
  EXPECT_EQ(line.run("glove live").exit_code, 2);
  EXPECT_EQ(line.run("glove").exit_code, 2);
}

TEST(GloveRecord, RecordsAGloveForAsLongAsAsked) {
  BackgroundProcess emulator({"glove", "emulate", "--tcp", "0"});
  const CommandLine line;
  const Outcome outcome =
      line.run("glove record --device " + emulator.read_line() + " --out hand.csv --duration 1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const device::Recording recording = device::read_recording(line.folder() / "hand.csv");
  EXPECT_EQ(recording.header.sensors.size(), 22U);
  EXPECT_NEAR(static_cast<double>(recording.times.size()), 100.0, 10.0);
  EXPECT_EQ(recording.times[0], 0.0);
}

TEST(GloveRecord, WritesNoFileWithoutAGlove) {
  const CommandLine line;
  line.write("hand.csv", "precious");
  EXPECT_EQ(line.run("glove record --device /dev/no-such-port --out hand.csv").exit_code, 3);
  EXPECT_EQ(line.read("hand.csv"), "precious");
}

TEST(GloveRecord, SaysWhenItCanNotWrite) {
  BackgroundProcess emulator({"glove", "emulate", "--tcp", "0"});
  const CommandLine line;
  const Outcome outcome =
      line.run("glove record --device " + emulator.read_line() + " --out no/such/folder/hand.csv");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no/such/folder"));
}

TEST(GloveRecord, EndsCleanlyOnCtrlC) {
  BackgroundProcess emulator({"glove", "emulate", "--tcp", "0"});
  const CommandLine line;
  const fs::path file = line.folder() / "hand.csv";
  BackgroundProcess recorder(
      {"glove", "record", "--device", emulator.read_line(), "--out", file.string()});
  ASSERT_TRUE(wait_for_rows(file, 20));
  recorder.send(SIGINT);
  const std::string summary = recorder.read_line();
  EXPECT_EQ(recorder.wait(), 0);
  EXPECT_THAT(summary, StartsWith(std::to_string(rows_of(file)) + " frames"));
  EXPECT_TRUE(device::read_recording(file).warnings.empty());
}

TEST(GloveRecord, LosesNoRowWhenTheEmulatorIsKilledAndConnectsAgain) {
  auto emulator = std::make_unique<BackgroundProcess>(
      std::vector<std::string>{"glove", "emulate", "--tcp", "0"});
  const std::string address = emulator->read_line();
  const CommandLine line;
  const fs::path file = line.folder() / "hand.csv";
  BackgroundProcess recorder({"glove", "record", "--device", address, "--out", file.string()});
  ASSERT_TRUE(wait_for_rows(file, 50));
  emulator->send(SIGKILL);
  emulator->wait();
  std::this_thread::sleep_for(milliseconds(200));
  const device::Recording before = device::read_recording(file);
  emulator = std::make_unique<BackgroundProcess>(
      std::vector<std::string>{"glove", "emulate", "--tcp", port_of(address)});
  ASSERT_EQ(emulator->read_line(), address);
  ASSERT_TRUE(wait_for_rows(file, before.times.size() + 50));
  recorder.send(SIGINT);
  const std::string summary = recorder.read_line();
  const std::string statistics = recorder.read_line();
  EXPECT_EQ(recorder.wait(), 0);
  EXPECT_THAT(statistics, HasSubstr("1 reconnects"));
  const device::Recording after = device::read_recording(file);
  EXPECT_TRUE(after.warnings.empty());
  EXPECT_THAT(summary, StartsWith(std::to_string(after.times.size()) + " frames"));
  EXPECT_EQ(after.times.head(before.times.size()), before.times);
  EXPECT_EQ(after.values.topRows(before.values.rows()), before.values);
}

TEST(GloveRecord, LosesNoRowWhenItIsKilledItself) {
  BackgroundProcess emulator({"glove", "emulate", "--tcp", "0"});
  const CommandLine line;
  const fs::path file = line.folder() / "hand.csv";
  BackgroundProcess recorder(
      {"glove", "record", "--device", emulator.read_line(), "--out", file.string()});
  ASSERT_TRUE(wait_for_rows(file, 50));
  recorder.send(SIGKILL);
  recorder.wait();
  EXPECT_GE(rows_of(file), 50);
}

TEST(GloveReplay, PlaysARecordingAndStreamsItAsAGlove) {
  BackgroundProcess emulator({"glove", "emulate", "--tcp", "0", "--noise", "0"});
  const CommandLine line;
  const fs::path file = line.folder() / "hand.csv";
  ASSERT_EQ(
      line.run("glove record --device " + emulator.read_line() + " --out hand.csv --frames 50")
          .exit_code,
      0);
  const Outcome shown = line.run("glove replay hand.csv --speed 10");
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_EQ(lines_of(shown.out).size(), 50U);
  BackgroundProcess served({"glove", "replay", file.string(), "--tcp", "0"});
  const Outcome again =
      line.run("glove record --device " + served.read_line() + " --out again.csv --frames 60");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const device::Recording first = device::read_recording(file);
  const device::Recording second = device::read_recording(line.folder() / "again.csv");
  EXPECT_LE((second.values.colwise().minCoeff() - first.values.colwise().minCoeff())
                .cwiseAbs()
                .maxCoeff(),
            1.0);
}

TEST(GloveReplay, NamesTheLineOfABrokenRecording) {
  const CommandLine line;
  line.write("bad.csv", "time,IndexMPJ\n0,100\n0.01,many\n");
  const Outcome outcome = line.run("glove replay bad.csv");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("bad.csv:3"));
}

}  // namespace
}  // namespace handway::test
