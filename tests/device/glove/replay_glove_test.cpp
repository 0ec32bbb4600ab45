#include "handway/device/glove/replay_glove.h"

#include "handway/device/emulators/glove_signals.h"
#include "handway/geometric/io/input_error.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <numeric>

namespace handway::device {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

// 22 sensors, `rows` frames at 100 Hz; all counts of row k are 10 + k.
Recording ramp(int rows) {
  Recording recording;
  recording.header.sensors.resize(kGloveSensors);
  std::iota(recording.header.sensors.begin(), recording.header.sensors.end(), 0);
  recording.times.resize(rows);
  recording.values.resize(rows, kGloveSensors);
  for (int row = 0; row < rows; ++row) {
    recording.times[row] = 5.0 + 0.01 * row;
    recording.values.row(row).setConstant(10 + row);
  }
  return recording;
}

std::vector<GloveFrame> play(ReplayGlove& glove, std::size_t at_most) {
  glove.connect();
  std::vector<GloveFrame> frames;
  while (frames.size() < at_most) {
    const GloveReading reading = glove.next(milliseconds(500));
    if (reading.event == SampleEvent::kEnd) {
      break;
    }
    if (reading.event == SampleEvent::kSample) {
      frames.push_back(reading.sample);
    }
  }
  return frames;
}

TEST(ReplayGlove, PlaysEveryFrameOnceAtTheTimeItWasRecorded) {
  ReplayGlove glove(ramp(21), "ramp");
  const auto begin = Clock::now();
  const auto frames = play(glove, 1000);
  const auto took = std::chrono::duration<double>(Clock::now() - begin).count();
  ASSERT_EQ(frames.size(), 21U);
  EXPECT_NEAR(frames.back().time - frames.front().time, 0.2, 1e-9);
  EXPECT_GE(took, 0.199);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    EXPECT_EQ(frames[k].counts[3], 10 + k);
  }
}

TEST(ReplayGlove, PlaysFaster) {
  ReplaySettings settings;
  settings.speed = 10.0;
  ReplayGlove glove(ramp(101), "ramp", settings);
  EXPECT_NEAR(glove.connect().rate, 1000.0, 1e-6);
  const auto frames = play(glove, 1000);
  ASSERT_EQ(frames.size(), 101U);
  EXPECT_NEAR(frames.back().time - frames.front().time, 0.1, 1e-9);
}

TEST(ReplayGlove, PlaysAsFastAsItIsRead) {
  ReplaySettings settings;
  settings.speed = std::numeric_limits<double>::infinity();
  ReplayGlove glove(ramp(200), "ramp", settings);
  const auto begin = Clock::now();
  EXPECT_EQ(play(glove, 1000).size(), 200U);
  EXPECT_LT(Clock::now() - begin, milliseconds(500));
}

TEST(ReplayGlove, BeginsAgainInALoopWithTimeGoingOn) {
  ReplaySettings settings;
  settings.loop = true;
  settings.speed = 10.0;
  ReplayGlove glove(ramp(5), "ramp", settings);
  const auto frames = play(glove, 12);
  ASSERT_EQ(frames.size(), 12U);
  EXPECT_EQ(frames[5].counts[0], 10);
  EXPECT_NEAR(frames[5].time - frames[4].time, 0.001, 1e-9);
}

TEST(ReplayGlove, HasAsManySensorsAsTheRecording) {
  Recording recording = ramp(3);
  recording.header.sensors.clear();
  for (int sensor = 0; sensor < kGloveSensors; ++sensor) {
    if (sensor != 6 && sensor != 9 && sensor != 13 && sensor != 17) {
      recording.header.sensors.push_back(sensor);
    }
  }
  recording.values.conservativeResize(Eigen::NoChange, 18);
  ReplayGlove glove(recording, "ramp");
  EXPECT_EQ(glove.connect().sensors, 18);
}

TEST(ReplayGlove, PlaysAnglesAsCountsOfTheEmulatedGlove) {
  Recording recording = ramp(2);
  recording.header.kind = RecordingKind::kAngles;
  recording.values.setZero();
  recording.values(0, 4) = 1.0;
  ReplayGlove glove(recording, "angles");
  const auto frames = play(glove, 2);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_GT(frames[0].counts[4], frames[1].counts[4]);
  EXPECT_EQ(frames[0].counts[5], frames[1].counts[5]);
}

TEST(ReplayGlove, RefusesWhatCanNotBePlayed) {
  EXPECT_THROW(ReplayGlove(Recording{}, "nothing"), geometric::InputError);
  ReplaySettings settings;
  settings.speed = 0.0;
  EXPECT_THROW(ReplayGlove(ramp(2), "ramp", settings), std::invalid_argument);
}

TEST(RecordedSignal, RepeatsTheRecordingExactly) {
  SensorFaults none;
  none.noise = 0.0;
  const GloveSignal signal = recorded_signal(ramp(10), 1, none);
  EXPECT_EQ(signal(0.0)[0], 10);
  EXPECT_EQ(signal(0.0351)[0], 13);
  EXPECT_EQ(signal(0.0999)[0], 19);
  EXPECT_EQ(signal(0.1251)[0], 12);
}

}  // namespace
}  // namespace handway::device
