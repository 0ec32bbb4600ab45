#include "handway/device/emulators/device_emulator.h"
#include "handway/device/emulators/tracker_signals.h"
#include "handway/device/emulators/tracker_units.h"
#include "handway/device/tracker/polhemus_tracker.h"
#include "handway/device/tracker/tracker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>
#include <thread>

namespace handway::device {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

constexpr seconds kPatience{10};

/// Records the events of a stream.
class TrackerListener {
 public:
  TrackerStreamHandlers handlers() {
    TrackerStreamHandlers all;
    all.on_sample = [this](const TrackerSample& sample) {
      const std::lock_guard lock(mutex_);
      samples_.push_back(sample);
    };
    all.on_state = [this](StreamState state) {
      const std::lock_guard lock(mutex_);
      states_.push_back(state);
    };
    return all;
  }

  [[nodiscard]] std::vector<TrackerSample> samples() const {
    const std::lock_guard lock(mutex_);
    return samples_;
  }
  [[nodiscard]] std::vector<StreamState> states() const {
    const std::lock_guard lock(mutex_);
    return states_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<TrackerSample> samples_;
  std::vector<StreamState> states_;
};

template <typename Condition>
bool waits_for(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition() && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(milliseconds(5));
  }
  return condition();
}

std::unique_ptr<DeviceEmulator> fastrak(std::uint16_t port = 0) {
  DeviceEmulatorSettings line;
  line.tcp_port = port;
  TrackerUnitSettings unit;
  unit.sensors = 2;
  return std::make_unique<DeviceEmulator>(line, make_fastrak_unit(unit, wrist_motion_signal(1)));
}

std::unique_ptr<Tracker> driver(const std::string& address) {
  PolhemusSettings settings;
  settings.timeout = milliseconds(200);
  return std::make_unique<PolhemusTracker>(address, settings);
}

TEST(TrackerStream, HandsOverTheSamplesOfAllSensors) {
  const auto emulator = fastrak();
  TrackerListener listener;
  TrackerStream stream(driver(emulator->address()), {}, listener.handlers());
  ASSERT_TRUE(waits_for([&] { return listener.samples().size() >= 20; }));
  EXPECT_THAT(stream.info().model, HasSubstr("Fastrak"));
  EXPECT_GT(stream.statistics().rate, 0.0);
  EXPECT_GE(stream.statistics().frames, 20U);
  stream.request_stop();
  ASSERT_TRUE(stream.wait(kPatience));
  EXPECT_EQ(stream.state(), StreamState::kStopped);
  const auto samples = listener.samples();
  for (std::size_t k = 1; k < samples.size(); ++k) {
    ASSERT_EQ(samples[k].sensor, 3 - samples[k - 1].sensor);
    ASSERT_GE(samples[k].time, samples[k - 1].time);
  }
}

TEST(TrackerStream, ConnectsAgainWhenTheTrackerComesBack) {
  auto emulator = fastrak();
  const std::string address = emulator->address();
  TrackerListener listener;
  const TrackerStream stream(driver(address), {}, listener.handlers());
  ASSERT_TRUE(waits_for([&] { return listener.samples().size() >= 5; }));
  emulator.reset();
  ASSERT_TRUE(waits_for([&] { return stream.state() == StreamState::kLost; }));
  EXPECT_THAT(stream.error(), HasSubstr(address));
  const std::size_t before = listener.samples().size();
  emulator = fastrak(static_cast<std::uint16_t>(std::stoi(address.substr(address.find(':') + 1))));
  ASSERT_TRUE(waits_for([&] { return listener.samples().size() >= before + 5; }));
  EXPECT_EQ(stream.statistics().reconnects, 1U);
  const auto samples = listener.samples();
  EXPECT_GE(samples.back().time, samples[before - 1].time) << "time goes on";
}

TEST(TrackerStream, TellsThatTheSensorsAreUnplugged) {
  const auto emulator = fastrak();
  TrackerListener listener;
  TrackerStream stream(driver(emulator->address()), {}, listener.handlers());
  ASSERT_TRUE(waits_for([&] { return listener.samples().size() >= 5; }));
  emulator->set_plugged(false);
  ASSERT_TRUE(waits_for([&] { return stream.state() == StreamState::kUnplugged; }));
  emulator->set_plugged(true);
  ASSERT_TRUE(waits_for([&] { return stream.state() == StreamState::kStreaming; }));
  stream.request_stop();
  ASSERT_TRUE(stream.wait(kPatience));
  using enum StreamState;
  EXPECT_THAT(listener.states(),
              testing::ElementsAre(kStreaming, kUnplugged, kStreaming, kStopped));
}

TEST(TrackerStream, FailsWithTheReasonWhenThereIsNoTracker) {
  const TrackerStream stream(driver("/dev/no-such-tracker"), {}, {});
  ASSERT_TRUE(stream.wait(kPatience));
  EXPECT_EQ(stream.state(), StreamState::kFailed);
  EXPECT_THAT(stream.error(), HasSubstr("/dev/no-such-tracker"));
}

}  // namespace
}  // namespace handway::device
