#include "handway/device/tracker/tracker.h"

#include "handway/device/core/byte_link.h"
#include "handway/device/core/device_error.h"
#include "handway/device/emulators/device_emulator.h"
#include "handway/device/emulators/tracker_signals.h"
#include "handway/device/emulators/tracker_units.h"
#include "handway/device/tracker/polhemus_tracker.h"
#include "handway/device/tracker/udp_tracker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

namespace handway::device {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

// Each sensor at a place of its own, turned by 1 rad about z.
geometric::Pose still_pose(double /*time*/, int sensor) {
  return geometric::pose_from_rpy({0.1 * sensor, -0.2, 0.3}, 0.0, 0.0, 1.0);
}

/// A tracker together with what it reads.
struct Pair {
  std::unique_ptr<DeviceEmulator> emulator;
  std::unique_ptr<Tracker> tracker;
};

struct Kind {
  const char* name;
  PolhemusModel model;
  bool ascii;
  bool tcp;
};

class PolhemusTrackers : public testing::TestWithParam<Kind> {
 protected:
  static Pair make(TrackerUnitSettings unit = {}, DeviceEmulatorSettings line = {}) {
    const Kind& kind = GetParam();
    if (kind.tcp) {
      line.tcp_port = 0;
    }
    PolhemusSettings settings;
    settings.model = kind.model;
    settings.ascii = kind.ascii;
    settings.button = unit.button;
    settings.timeout = milliseconds(300);
    const bool fastrak = kind.model == PolhemusModel::kFastrak;
    auto emulator = std::make_unique<DeviceEmulator>(
        line, fastrak ? make_fastrak_unit(unit, still_pose) : make_liberty_unit(unit, still_pose));
    auto tracker = std::make_unique<PolhemusTracker>(emulator->address(), settings);
    return {std::move(emulator), std::move(tracker)};
  }
};

std::vector<TrackerSample> take(Tracker& tracker, std::size_t count) {
  std::vector<TrackerSample> samples;
  const auto end = std::chrono::steady_clock::now() + seconds(10);
  while (samples.size() < count && std::chrono::steady_clock::now() < end) {
    const TrackerReading reading = tracker.next(milliseconds(100));
    if (reading.event == SampleEvent::kSample) {
      samples.push_back(reading.sample);
    }
  }
  EXPECT_EQ(samples.size(), count);
  return samples;
}

void expect_still(const TrackerSample& sample, double tolerance = 2e-4) {
  EXPECT_TRUE(sample.X_ST.isApprox(still_pose(0.0, sample.sensor), tolerance));
}

TEST_P(PolhemusTrackers, ReadTheStream) {
  const Pair pair = make();
  EXPECT_THAT(pair.tracker->connect().model, HasSubstr("Polhemus"));
  double last = 0.0;
  for (const TrackerSample& sample : take(*pair.tracker, 50)) {
    EXPECT_EQ(sample.sensor, 1);
    EXPECT_FALSE(sample.button);
    expect_still(sample);
    EXPECT_GE(sample.time, last);
    last = sample.time;
  }
  EXPECT_EQ(pair.tracker->faults().resynchronisations, 0U);
}

TEST_P(PolhemusTrackers, TellTheSensorsApartAndReadTheButton) {
  TrackerUnitSettings unit;
  unit.sensors = 3;
  unit.button = true;
  const Pair pair = make(unit);
  pair.tracker->connect();
  std::array<int, 4> seen{};
  for (const TrackerSample& sample : take(*pair.tracker, 60)) {
    expect_still(sample);
    EXPECT_TRUE(sample.button);
    ++seen.at(static_cast<std::size_t>(sample.sensor));
  }
  EXPECT_THAT(seen, testing::ElementsAre(0, 20, 20, 20));
}

TEST_P(PolhemusTrackers, DropDamagedRecordsAndGoOn) {
  DeviceEmulatorSettings line;
  line.faults.dropout = 0.05;
  line.faults.garbage = 0.2;
  const Pair pair = make({}, line);
  pair.tracker->connect();
  int torn = 0;
  for (const TrackerSample& sample : take(*pair.tracker, 150)) {
    // A damaged byte may get through only if it keeps the form of the record.
    torn += sample.X_ST.isApprox(still_pose(0.0, 1), 2e-4) ? 0 : 1;
  }
  EXPECT_LE(torn, 6);
  EXPECT_GT(pair.tracker->faults().resynchronisations, 0U);
}

TEST_P(PolhemusTrackers, TellThatTheSensorIsUnpluggedAndGoOnWhenItIsBack) {
  const Pair pair = make();
  pair.tracker->connect();
  take(*pair.tracker, 5);
  pair.emulator->set_plugged(false);
  SampleEvent event = SampleEvent::kNothing;
  for (int k = 0; k < 50 && event != SampleEvent::kUnplugged; ++k) {
    event = pair.tracker->next(milliseconds(100)).event;
  }
  EXPECT_EQ(event, SampleEvent::kUnplugged);
  pair.emulator->set_plugged(true);
  take(*pair.tracker, 5);
}

TEST_P(PolhemusTrackers, NoticeThatTheOtherEndIsGone) {
  Pair pair = make();
  pair.tracker->connect();
  take(*pair.tracker, 3);
  pair.emulator.reset();
  const auto lost = [&] {
    for (int k = 0; k < 60; ++k) {
      pair.tracker->next(milliseconds(100));
    }
  };
  EXPECT_THROW(lost(), DeviceError);
}

TEST_P(PolhemusTrackers, SayWhenNobodyAnswers) {
  DeviceEmulatorSettings line;
  line.latency = 60.0;
  const Pair pair = make({}, line);
  try {
    pair.tracker->connect();
    FAIL() << "there is no answer";
  } catch (const DeviceError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("no answer"), HasSubstr("baud rate")));
  }
}

TEST_P(PolhemusTrackers, TakeOverFromAProgramThatLeftTheUnitStreaming) {
  const Pair pair = make();
  {
    const auto link = open_link(pair.emulator->address(), 115200);
    const std::string left = "U1\rC\rO1";
    link->write({reinterpret_cast<const std::uint8_t*>(left.data()), left.size()});
    std::this_thread::sleep_for(milliseconds(50));
  }
  pair.tracker->connect();
  expect_still(take(*pair.tracker, 5).back());
}

INSTANTIATE_TEST_SUITE_P(All, PolhemusTrackers,
                         testing::Values(Kind{"FastrakText", PolhemusModel::kFastrak, true, false},
                                         Kind{"FastrakBinary", PolhemusModel::kFastrak, false,
                                              true},
                                         Kind{"Liberty", PolhemusModel::kLiberty, false, false},
                                         Kind{"LibertyTcp", PolhemusModel::kLiberty, false, true}),
                         [](const auto& tested) { return tested.param.name; });

TEST(PolhemusTracker, StopsWaitingWhenAsked) {
  const DeviceEmulator emulator({}, make_fastrak_unit({1, 0.1, false}, still_pose));
  PolhemusTracker tracker(emulator.address());
  tracker.connect();
  std::stop_source stop;
  const std::jthread stopper([&] {
    std::this_thread::sleep_for(milliseconds(50));
    stop.request_stop();
  });
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(tracker.next(seconds(10), stop.get_token()).event, SampleEvent::kNothing);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(1));
}

TEST(PolhemusTracker, RefusesALibertyInText) {
  PolhemusSettings settings;
  settings.model = PolhemusModel::kLiberty;
  settings.ascii = true;
  EXPECT_THROW(PolhemusTracker("/dev/ttyUSB0", settings), std::invalid_argument);
}

TEST(TrackerUnits, RefuseSettingsThatNoTrackerHas) {
  EXPECT_THROW(make_fastrak_unit({5, 120.0, false}, still_pose), std::invalid_argument);
  EXPECT_THROW(make_liberty_unit({17, 240.0, false}, still_pose), std::invalid_argument);
  EXPECT_THROW(make_datagram_unit({1, 0.0, false}, still_pose), std::invalid_argument);
}

TEST(WristMotion, IsTheSameForTheSameSeedAndMovesSmoothly) {
  const TrackerSignal a = wrist_motion_signal(7, {0.0, 0.0});
  const TrackerSignal b = wrist_motion_signal(7, {0.0, 0.0});
  geometric::Pose last = a(0.0, 1);
  EXPECT_TRUE(b(0.0, 1).isApprox(last));
  for (int k = 1; k < 3000; ++k) {
    const geometric::Pose X_ST = a(k * 0.01, 1);
    EXPECT_EQ(b(k * 0.01, 1).matrix(), X_ST.matrix());
    EXPECT_LT((X_ST.translation() - last.translation()).norm(), 0.02);
    last = X_ST;
  }
  EXPECT_NE(a(30.0, 1).matrix(), a(30.0, 2).matrix()) << "each sensor has its own motion";
}

}  // namespace
}  // namespace handway::device
