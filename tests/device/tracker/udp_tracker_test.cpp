#include "handway/device/tracker/udp_tracker.h"

#include "handway/device/core/device_error.h"
#include "handway/device/emulators/device_emulator.h"
#include "handway/device/emulators/landmark_unit.h"
#include "handway/device/emulators/tracker_signals.h"
#include "handway/device/emulators/tracker_units.h"
#include "handway_test/free_port.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <random>
#include <thread>

namespace handway::device {
namespace {

using std::chrono::milliseconds;
using test::free_udp_port;
using testing::HasSubstr;

std::optional<TrackerSample> read(const std::string& text) {
  return read_pose_datagram({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::unique_ptr<DeviceEmulator> send_to(const std::string& port, TrackerUnitSettings unit = {},
                                        DeviceEmulatorSettings line = {}) {
  line.udp_receiver = port;
  return std::make_unique<DeviceEmulator>(line, make_datagram_unit(unit, wrist_motion_signal(1)));
}

TEST(PoseDatagram, ReadsPositionQuaternionTimeSensorAndButton) {
  const auto sample = read(R"({"sensor": 3, "time": 12.5, "position": [0.1, -0.2, 0.3],
      "quaternion": [0, 0, 0.7071068, 0.7071068], "button": true, "frame": 17})");
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->sensor, 3);
  EXPECT_EQ(sample->time, 12.5);
  EXPECT_EQ(sample->button, true);
  EXPECT_TRUE(sample->X_ST.isApprox(
      geometric::pose_from_rpy({0.1, -0.2, 0.3}, 0.0, 0.0, std::numbers::pi / 2), 1e-6));
}

TEST(PoseDatagram, ReadsWhatItWrites) {
  TrackerSample sample{3.25, 9, geometric::pose_from_rpy({1.0, 2.0, -3.0}, 0.4, -0.5, 2.6), false};
  const auto again = read(write_pose_datagram(sample));
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->X_ST.isApprox(sample.X_ST, 1e-12));
  EXPECT_EQ(again->time, 3.25);
  EXPECT_EQ(again->sensor, 9);
  EXPECT_EQ(again->button, false);
}

TEST(PoseDatagram, RefusesWhatIsNoPose) {
  const std::string good = R"({"time":1,"position":[0,0,0],"quaternion":[0,0,0,1]})";
  EXPECT_TRUE(read(good));
  for (const char* bad : {"", "{", "[]", "null", R"({"time":1,"position":[0,0,0]})",
                          R"({"position":[0,0,0],"quaternion":[0,0,0,1]})",
                          R"({"time":1,"position":[0,0],"quaternion":[0,0,0,1]})",
                          R"({"time":1,"position":[0,0,"0"],"quaternion":[0,0,0,1]})",
                          R"({"time":1,"position":[0,0,1e999],"quaternion":[0,0,0,1]})",
                          R"({"time":1,"position":[0,0,50],"quaternion":[0,0,0,1]})",
                          R"({"time":1,"position":[0,0,0],"quaternion":[0,0,0,0]})",
                          R"({"time":1,"position":[0,0,0],"quaternion":[0,0,0,2]})",
                          R"({"time":1,"position":[0,0,0],"quaternion":[0,0,0,1],"sensor":-1})",
                          R"({"time":1,"position":[0,0,0],"quaternion":[0,0,0,1],"sensor":1.5})",
                          R"({"time":1,"position":[0,0,0],"quaternion":[0,0,0,1],"button":1})"}) {
    EXPECT_FALSE(read(bad)) << bad;
  }
  EXPECT_FALSE(read(good + std::string(kLongestPoseDatagram, ' ')));
}

TEST(PoseDatagram, NeverGivesAnUnsoundPoseWhateverAMillionBytesSay) {
  std::mt19937_64 random(1);
  const std::string good =
      R"({"sensor":1,"time":1.5,"position":[0.1,0.2,0.3],"quaternion":[0,0,0.6,0.8]})";
  for (std::size_t sent = 0; sent < 1000000; sent += good.size()) {
    std::string damaged = good;
    for (std::uint64_t k = random() % 4; k < 4; ++k) {
      damaged[random() % damaged.size()] = static_cast<char>(random() % 128);
    }
    if (const auto sample = read(damaged)) {
      const Eigen::Matrix3d R = sample->X_ST.linear();
      ASSERT_TRUE((R * R.transpose()).isIdentity(1e-9)) << damaged;
      ASSERT_TRUE(sample->X_ST.translation().allFinite()) << damaged;
    }
  }
}

TEST(UdpTracker, ReadsTheSensorsOfASender) {
  const std::string port = free_udp_port();
  TrackerUnitSettings unit;
  unit.sensors = 2;
  unit.button = true;
  const auto emulator = send_to(port, unit);
  UdpTracker tracker(port);
  tracker.connect();
  double last = 0.0;
  std::array<int, 2> seen{};
  for (int k = 0; k < 40; ++k) {
    const TrackerReading reading = tracker.next(milliseconds(1000));
    ASSERT_EQ(reading.event, SampleEvent::kSample);
    EXPECT_GE(reading.sample.time, last);
    EXPECT_EQ(reading.sample.button.has_value(), reading.sample.sensor == 0);
    last = reading.sample.time;
    ++seen.at(static_cast<std::size_t>(reading.sample.sensor));
  }
  EXPECT_GT(seen[0], 15);
  EXPECT_GT(seen[1], 15);
}

std::unique_ptr<DeviceEmulator> send_hand_to(const std::string& port, HandWire wire, bool left) {
  DeviceEmulatorSettings line;
  line.udp_receiver = port;
  LandmarkUnitSettings unit;
  unit.wire = wire;
  unit.rate = 100.0;
  unit.left = left;
  return std::make_unique<DeviceEmulator>(line, make_landmark_unit(unit, [](double time) {
                                            GloveAngles angles{time, {}};
                                            angles.angles.fill(0.1);
                                            return angles;
                                          }));
}

TEST(UdpTracker, ReadsTheWristsOfHands) {
  for (const HandWire wire : {HandWire::kOpenXr, HandWire::kRokoko, HandWire::kRokokoLz4}) {
    for (const bool left : {false, true}) {
      const std::string port = free_udp_port();
      const auto sender = send_hand_to(port, wire, left);
      UdpTracker tracker(port);
      tracker.connect();
      for (int k = 0; k < 5; ++k) {
        const TrackerReading reading = tracker.next(milliseconds(1000));
        ASSERT_EQ(reading.event, SampleEvent::kSample) << name_of(wire);
        EXPECT_EQ(reading.sample.sensor, left ? 1 : 0);
        EXPECT_NEAR(reading.sample.X_ST.translation().z(), 0.5, 1e-6) << "before the camera";
      }
      EXPECT_EQ(tracker.faults().resynchronisations, 0U);
    }
  }
}

TEST(UdpTracker, TellsThatTheHandsHaveNoPose) {
  const std::string port = free_udp_port();
  const auto sender = send_hand_to(port, HandWire::kManus, false);
  UdpTracker tracker(port, {milliseconds(200)});
  try {
    tracker.connect();
    FAIL() << "ergonomics were taken for poses";
  } catch (const DeviceError& error) {
    EXPECT_THAT(error.what(), HasSubstr("Manus ergonomics without the pose of the wrist"));
  }
}

TEST(UdpTracker, CountsDamagedDatagramsAndNoticesThatTheSenderIsGone) {
  const std::string port = free_udp_port();
  DeviceEmulatorSettings line;
  line.faults.garbage = 0.5;
  auto emulator = send_to(port, {}, line);
  UdpTracker tracker(port, {milliseconds(300)});
  tracker.connect();
  for (int k = 0; k < 30; ++k) {
    ASSERT_EQ(tracker.next(milliseconds(1000)).event, SampleEvent::kSample);
  }
  EXPECT_GT(tracker.faults().resynchronisations, 0U);
  emulator.reset();
  const auto lost = [&] {
    for (int k = 0; k < 20; ++k) {
      tracker.next(milliseconds(100));
    }
  };
  EXPECT_THROW(lost(), DeviceError);
  emulator = send_to(port);
  tracker.connect();
  EXPECT_EQ(tracker.next(milliseconds(1000)).event, SampleEvent::kSample);
}

TEST(UdpTracker, SaysWhatIsWrongWithThePort) {
  const std::string port = free_udp_port();
  UdpTracker silent(port, {milliseconds(100)});
  try {
    silent.connect();
    FAIL() << "nobody sends";
  } catch (const DeviceError& error) {
    EXPECT_THAT(error.what(), HasSubstr("sender"));
  }
  EXPECT_THROW(UdpTracker("many"), geometric::InputError);
  EXPECT_THROW(UdpTracker(""), geometric::InputError);
  EXPECT_THROW(UdpTracker("localhost:99999"), geometric::InputError);
  const auto emulator = send_to(port);
  UdpTracker first(port);
  first.connect();
  UdpTracker second(port);
  EXPECT_THROW(second.connect(), DeviceError);
}

}  // namespace
}  // namespace handway::device
