#include "handway/device/glove/cyberglove.h"

#include "counting_signal.h"
#include "handway/device/core/byte_link.h"
#include "handway/device/core/device_error.h"
#include "handway/device/emulators/glove_emulator.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <thread>

namespace handway::device {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test::counting_signal;
using test::on_tcp;
using testing::HasSubstr;

std::vector<GloveFrame> take(Glove& glove, std::size_t count) {
  std::vector<GloveFrame> frames;
  const auto end = std::chrono::steady_clock::now() + seconds(10);
  while (frames.size() < count && std::chrono::steady_clock::now() < end) {
    const GloveReading reading = glove.next(milliseconds(100));
    if (reading.event == SampleEvent::kSample) {
      frames.push_back(reading.sample);
    }
  }
  EXPECT_EQ(frames.size(), count);
  return frames;
}

void expect_consecutive(const std::vector<GloveFrame>& frames) {
  for (std::size_t k = 1; k < frames.size(); ++k) {
    EXPECT_EQ(frames[k].counts[0], frames[k - 1].counts[0] % 255 + 1);
    EXPECT_EQ(frames[k].counts[0], frames[k].counts[21]);
    EXPECT_GE(frames[k].time, frames[k - 1].time);
  }
}

std::string error_of(Glove& glove) {
  try {
    glove.connect();
  } catch (const DeviceError& error) {
    return error.what();
  }
  return "no error";
}

TEST(CyberGlove, StreamsFromAPseudoTerminal) {
  const GloveEmulator emulator({}, counting_signal());
  CyberGlove glove(emulator.address());
  const GloveInfo info = glove.connect();
  EXPECT_EQ(info.sensors, 22);
  EXPECT_TRUE(info.right_hand);
  EXPECT_THAT(info.model, HasSubstr("CyberGlove"));
  EXPECT_GT(info.round_trip, 0.0);
  expect_consecutive(take(glove, 50));
  EXPECT_EQ(glove.faults().resynchronisations, 0U);
}

TEST(CyberGlove, StreamsOverTcpAtTheRateAskedFor) {
  const GloveEmulator emulator(on_tcp(), counting_signal());
  CyberGloveSettings settings;
  settings.rate = 200.0;
  CyberGlove glove(emulator.address(), settings);
  glove.connect();
  const auto frames = take(glove, 101);
  expect_consecutive(frames);
  EXPECT_NEAR(frames.back().time - frames.front().time, 0.5, 0.2);
}

TEST(CyberGlove, ReadsA18SensorLeftHandGlove) {
  GloveEmulatorSettings settings;
  settings.unit.sensors = 18;
  settings.unit.right_hand = false;
  const GloveEmulator emulator(settings, counting_signal());
  CyberGlove glove(emulator.address());
  const GloveInfo info = glove.connect();
  EXPECT_EQ(info.sensors, 18);
  EXPECT_FALSE(info.right_hand);
  const auto frames = take(glove, 5);
  EXPECT_EQ(frames[0].counts[6], 0);
  EXPECT_GT(frames[0].counts[7], 0);
}

TEST(CyberGlove, PollsWhenAskedTo) {
  const GloveEmulator emulator(on_tcp(), counting_signal());
  CyberGloveSettings settings;
  settings.polled = true;
  CyberGlove glove(emulator.address(), settings);
  glove.connect();
  const auto frames = take(glove, 20);
  expect_consecutive(frames);
  EXPECT_GT(frames.back().time - frames.front().time, 0.15);
  EXPECT_EQ(emulator.records(), 0U) << "it was not to stream";
}

TEST(CyberGlove, TakesOverAStreamThatAnotherProgramLeftRunning) {
  const GloveEmulator emulator({}, counting_signal());
  {
    const auto link = open_link(emulator.address(), 115200);
    const std::vector<std::uint8_t> left{'D', 1, 'U', 1, 'S'};
    link->write(left);
    std::this_thread::sleep_for(milliseconds(50));
  }
  CyberGlove glove(emulator.address());
  glove.connect();
  expect_consecutive(take(glove, 5));
}

TEST(CyberGlove, DropsDamagedRecordsAndGoesOn) {
  GloveEmulatorSettings settings = on_tcp();
  settings.faults.garbage = 0.2;
  settings.faults.dropout = 0.05;
  const GloveEmulator emulator(settings, counting_signal());
  CyberGloveSettings fast;
  fast.rate = 400.0;
  CyberGlove glove(emulator.address(), fast);
  glove.connect();
  std::size_t torn = 0;
  for (const GloveFrame& frame : take(glove, 200)) {
    // A damaged byte may get through only if it keeps the form of the record.
    torn += std::count(frame.counts.begin(), frame.counts.end(), frame.counts[0]) < 21 ? 1 : 0;
  }
  EXPECT_LE(torn, 4U);
  EXPECT_GT(glove.faults().resynchronisations, 0U);
}

TEST(CyberGlove, TellsThatTheGloveWasUnpluggedAndStartsAgainWhenItIsBack) {
  GloveEmulator emulator(on_tcp(), counting_signal());
  CyberGlove glove(emulator.address());
  glove.connect();
  take(glove, 5);
  emulator.set_plugged(false);
  GloveReading reading;
  for (int k = 0; k < 100 && reading.event != SampleEvent::kUnplugged; ++k) {
    reading = glove.next(milliseconds(50));
  }
  ASSERT_EQ(reading.event, SampleEvent::kUnplugged);
  EXPECT_EQ(glove.next(milliseconds(50)).event, SampleEvent::kUnplugged);
  emulator.set_plugged(true);
  take(glove, 5);
}

TEST(CyberGlove, SaysWhenThereIsNoGloveOnTheUnit) {
  GloveEmulator emulator(on_tcp(), counting_signal());
  emulator.set_plugged(false);
  std::this_thread::sleep_for(milliseconds(50));
  CyberGlove glove(emulator.address());
  EXPECT_THAT(error_of(glove), HasSubstr("Plug the glove into the interface unit"));
}

TEST(CyberGlove, SaysWhenNobodyAnswers) {
  GloveEmulatorSettings deaf = on_tcp();
  deaf.latency = 60.0;
  const GloveEmulator emulator(deaf, counting_signal());
  CyberGloveSettings settings;
  settings.timeout = milliseconds(150);
  CyberGlove glove(emulator.address(), settings);
  EXPECT_THAT(error_of(glove), testing::AllOf(HasSubstr("no answer"), HasSubstr("baud rate")));
}

TEST(CyberGlove, SaysWhenTheDeviceIsMissingOrIsNone) {
  CyberGlove missing("/dev/no-such-device");
  EXPECT_THAT(error_of(missing),
              testing::AllOf(HasSubstr("/dev/no-such-device"), HasSubstr("Plug the device in")));
  const test::ScratchFolder folder;
  const auto file = folder.path() / "file.txt";
  std::ofstream(file) << "text";
  CyberGlove text(file.string());
  EXPECT_THAT(error_of(text), HasSubstr("no device"));
  CyberGlove closed("localhost:1");
  EXPECT_THAT(error_of(closed), HasSubstr("host and port"));
}

TEST(CyberGlove, NoticesThatTheOtherEndIsGone) {
  for (const bool tcp : {true, false}) {
    auto emulator = std::make_unique<GloveEmulator>(tcp ? on_tcp() : GloveEmulatorSettings{},
                                                    counting_signal());
    CyberGlove glove(emulator->address());
    glove.connect();
    take(glove, 3);
    emulator.reset();
    const auto lost = [&] {
      for (int k = 0; k < 100; ++k) {
        glove.next(milliseconds(100));
      }
    };
    EXPECT_THROW(lost(), DeviceError);
  }
}

TEST(CyberGlove, StopsWaitingWhenAsked) {
  GloveEmulatorSettings slow = on_tcp();
  const GloveEmulator emulator(slow, counting_signal());
  CyberGloveSettings settings;
  settings.rate = 0.5;
  CyberGlove glove(emulator.address(), settings);
  glove.connect();
  std::stop_source stop;
  const std::jthread stopper([&] {
    std::this_thread::sleep_for(milliseconds(50));
    stop.request_stop();
  });
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(glove.next(seconds(10), stop.get_token()).event, SampleEvent::kNothing);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(1));
}

TEST(CyberGlove, RefusesRatesThatNoGloveHas) {
  CyberGloveSettings settings;
  settings.rate = 5000.0;
  EXPECT_THROW(CyberGlove("/dev/ttyUSB0", settings), std::invalid_argument);
}

}  // namespace
}  // namespace handway::device
