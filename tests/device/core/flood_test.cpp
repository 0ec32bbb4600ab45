/// Devices that send without pause: every turn of reading is bounded in time and memory, and every
/// loop sees the stop.
#include "core/links.h"
#include "handway/device/arm/simple_message.h"
#include "handway/device/arm/val3_arm.h"
#include "handway/device/core/device_error.h"
#include "handway/device/emulators/arm_emulator.h"
#include "handway/device/emulators/glove_emulator.h"
#include "handway/device/emulators/glove_signals.h"
#include "handway/device/emulators/hand_emulator.h"
#include "handway/device/emulators/haptic_emulator.h"
#include "handway/device/emulators/ros_emulator.h"
#include "handway/device/emulators/tracker_signals.h"
#include "handway/device/emulators/tracker_units.h"
#include "handway/device/glove/cyberglove.h"
#include "handway/device/glove/glove.h"
#include "handway/device/hand/hand_protocol.h"
#include "handway/device/hand/network_hand.h"
#include "handway/device/haptic/haptic_device.h"
#include "handway/device/ros/ros_robot.h"
#include "handway/device/ros/rosbridge.h"
#include "handway/device/tracker/polhemus_tracker.h"
#include "handway/device/tracker/tracker.h"
#include "handway/device/tracker/udp_tracker.h"
#include "handway_test/flooding_proxy.h"
#include "handway_test/free_port.h"
#include "handway_test/resource_use.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace handway::device {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr std::size_t kMegabyte = std::size_t{1} << 20U;
/// Largest growth of this program's memory by a flood, proxy and emulators included.
constexpr std::size_t kMostMemory = (24 + test::kQuarantineMegabytes) * kMegabyte;
/// Least size of a flood.
constexpr std::uint64_t kFlood = kMegabyte;

/// Longest turn of a loop over devices, s of this thread: a loaded machine stretches any turn …
constexpr double kLongestTurn = 0.05;
/// … but not most of those that are taken in a second.
constexpr int kLeastTurns = 20;

double ms_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Requests a stop after so long, on a thread of its own.
class LateStop {
 public:
  explicit LateStop(milliseconds delay)
      : thread_([this, delay] {
          std::this_thread::sleep_for(delay);
          requested_ = Clock::now();
          source_.request_stop();
        }) {}
  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }
  /// Returns the time since the request; call it after the request.
  [[nodiscard]] double ms_ago() {
    thread_.join();
    return ms_since(requested_);
  }

 private:
  std::stop_source source_;
  Clock::time_point requested_;
  std::jthread thread_;
};

/// A WebSocket frame (RFC 6455) as a server sends it.
std::string text_frame(const std::string& text) {
  std::string frame = "\x81";
  if (text.size() < 126) {
    frame += static_cast<char>(text.size());
  } else {
    frame += static_cast<char>(126);
    frame += static_cast<char>(text.size() >> 8U);
    frame += static_cast<char>(text.size());
  }
  return frame + text;
}

/// A link on which there is always more, and nothing that a protocol knows.
class EndlessLink final : public ByteLink {
 public:
  EndlessLink() : ByteLink("endless") {}

 private:
  std::size_t do_read(std::span<std::uint8_t> bytes, milliseconds /*timeout*/) override {
    std::ranges::fill(bytes, std::uint8_t{'x'});
    return bytes.size();
  }
  void do_write(std::span<const std::uint8_t> /*bytes*/, milliseconds /*timeout*/) override {}
};

TEST(ReadTurn, EndsWithItsBudgetOfBytes) {
  EndlessLink link;
  std::size_t taken = 0;
  EXPECT_FALSE(read_turn(link, milliseconds(1),
                         [&](std::span<const std::uint8_t> bytes) { taken += bytes.size(); }));
  EXPECT_LE(taken, ReadBudget::kMostBytes);
}

TEST(ReadTurn, EndsWithItsBudgetOfTimeWhateverIsDoneWithTheBytes) {
  EndlessLink link;
  int reads = 0;
  EXPECT_FALSE(read_turn(link, milliseconds(1), [&](std::span<const std::uint8_t> /*bytes*/) {
    std::this_thread::sleep_for(milliseconds(2));
    ++reads;
  }));
  EXPECT_LE(reads, 12) << "25 ms";
}

/// A device that is never read to the end of what it says.
class TalkativeDevice final : public TrajectoryClient {
 public:
  TalkativeDevice()
      : TrajectoryClient("talkative", {{"joint"},
                                       Eigen::VectorXd::Constant(1, -1.0),
                                       Eigen::VectorXd::Constant(1, 1.0),
                                       Eigen::VectorXd::Constant(1, 1.0)}) {}
  std::atomic<bool> all = true;
  int stops = 0;

 private:
  void do_connect(const std::stop_token& /*stop*/) override {}
  void do_upload(const JointTrajectory& /*trajectory*/, const std::stop_token& /*stop*/) override {}
  void do_start() override {}
  [[nodiscard]] double do_pause(double time) override { return time; }
  void do_resume() override {}
  void do_stop() override { ++stops; }
  [[nodiscard]] bool do_update(double /*time*/) override {
    std::this_thread::sleep_for(milliseconds(2));
    add_sample(Eigen::VectorXd::Zero(1));
    return all;
  }
};

TEST(Backlog, EndsAMotionWhenItHasLastedHalfASecond) {
  TalkativeDevice device;
  device.connect();
  device.upload({{0.0, 5.0}, Eigen::MatrixXd::Zero(2, 1)});
  device.start();
  device.all = false;
  const auto begin = Clock::now();
  int updates = 0;
  while (device.phase() == MotionPhase::kRunning) {
    device.update();
    ++updates;
  }
  EXPECT_GT(ms_since(begin), 450.0);
  EXPECT_LE(updates, 300) << "of 2 ms each";
  EXPECT_EQ(device.phase(), MotionPhase::kFailed);
  EXPECT_THAT(device.fault(), HasSubstr("more messages than can be read"));
  EXPECT_EQ(device.stops, 1);
}

TEST(Backlog, GetsNoMotionNorAConnection) {
  TalkativeDevice device;
  device.connect();
  device.all = false;
  EXPECT_THROW(device.upload({{0.0, 5.0}, Eigen::MatrixXd::Zero(2, 1)}), DeviceError);
  EXPECT_THROW(device.connect(), DeviceError);
}

TEST(Backlog, IsNoneOnceItHasBeenRead) {
  TalkativeDevice device;
  device.all = false;
  const std::jthread later([&] {
    std::this_thread::sleep_for(milliseconds(200));
    device.all = true;
  });
  device.connect();
  for (int k = 0; k < 400; ++k) {
    device.update();
  }
  EXPECT_EQ(device.fault(), "");
}

/// A connection to a moving device, through a proxy that can flood it.
struct FloodedLink {
  std::shared_ptr<void> emulator;
  std::vector<std::shared_ptr<test::FloodingProxy>> proxies;
  test::FloodingProxy* flooding = nullptr;  ///< The one that is to flood, …
  std::string message;                      ///< … with this.
  std::unique_ptr<TrajectoryClient> link;
};

FloodedLink hand_link() {
  HandControllerSettings settings;
  settings.joints = sah_joints();
  settings.position = settings.joints.upper.cwiseMin(-0.1);
  const auto emulator = std::make_shared<HandEmulator>(settings, 0);
  const auto proxy = std::make_shared<test::FloodingProxy>(test::port_of(emulator->address()));
  return {emulator,
          {proxy},
          proxy.get(),
          to_line({0.0, "idle", settings.position}),
          std::make_unique<NetworkHand>("hand", "localhost", proxy->port(), settings.joints)};
}

FloodedLink arm_link(bool state_port) {
  Val3ControllerSettings settings;
  settings.joints = tx90_joints();
  settings.position = Eigen::VectorXd::Zero(6);
  const auto emulator = std::make_shared<ArmEmulator>(settings, 0);
  test::FloodingArmProxy both(test::port_of(emulator->address()));
  const std::uint16_t port = both.motion->port();
  SimpleMessage message;
  message.type =
      state_port ? SimpleMessageType::kJointPosition : SimpleMessageType::kJointTrajectoryPoint;
  message.kind = state_port ? SimpleMessageKind::kTopic : SimpleMessageKind::kReply;
  const std::vector<std::uint8_t> bytes = encode(message);
  test::FloodingProxy* const flooding = state_port ? both.state.get() : both.motion.get();
  return {emulator,
          {std::move(both.motion), std::move(both.state)},
          flooding,
          {bytes.begin(), bytes.end()},
          std::make_unique<Val3Arm>("arm", "localhost", port, settings.joints)};
}

FloodedLink ros_link() {
  RosControllerSettings settings;
  settings.joints = tx90_joints();
  settings.position = Eigen::VectorXd::Zero(6);
  const auto emulator = std::make_shared<RosEmulator>(settings, 0);
  const auto proxy = std::make_shared<test::FloodingProxy>(test::port_of(emulator->address()));
  RosAddress address;
  address.host = "localhost";
  address.port = proxy->port();
  address.trajectory_topic = trajectory_topic("/arm_controller", address.version);
  return {emulator,
          {proxy},
          proxy.get(),
          text_frame(
              publish(kJointStatesTopic, RosJointState{settings.joints.names, settings.position})),
          std::make_unique<RosRobot>("robot", address, settings.joints)};
}

struct LinkCase {
  const char* name;
  std::function<FloodedLink()> make;
};

class Flood : public testing::TestWithParam<LinkCase> {};

TEST_P(Flood, TakesNoTurnLongAndNoMemory) {
  FloodedLink flooded = GetParam().make();
  flooded.link->connect();
  const std::size_t before = test::peak_memory();
  flooded.flooding->flood(flooded.message);
  const auto begin = Clock::now();
  double longest = 0.0;
  int turns = 0;
  // The link may end with a fault: that the flood can't be read.
  while (flooded.link->fault().empty() && ms_since(begin) < 1000.0) {
    const double turn = test::cpu_seconds();
    flooded.link->update();
    longest = std::max(longest, test::cpu_seconds() - turn);
    ++turns;
  }
  EXPECT_LT(longest, kLongestTurn);
  EXPECT_TRUE(turns >= kLeastTurns || !flooded.link->fault().empty()) << turns;
  EXPECT_GE(flooded.flooding->flooded(), kFlood);
  EXPECT_LT(test::peak_memory() - before, kMostMemory);
}

TEST_P(Flood, IsNoReasonToWaitOnceAStopIsRequested) {
  FloodedLink flooded = GetParam().make();
  flooded.flooding->flood(flooded.message);
  LateStop stop(milliseconds(100));
  try {
    flooded.link->connect(stop.token());
  } catch (const DeviceError&) {
    // If positions come at once, the device may be connected instead.
  }
  EXPECT_LT(stop.ms_ago(), 100.0);
}

TEST_P(Flood, EndsAnUploadInTime) {
  FloodedLink flooded = GetParam().make();
  flooded.link->connect();
  flooded.flooding->flood(flooded.message);
  std::this_thread::sleep_for(milliseconds(50));
  const Eigen::VectorXd here = flooded.link->measured().position;
  JointTrajectory still{{0.0, 1.0}, Eigen::MatrixXd(2, here.size())};
  still.positions.row(0) = here;
  still.positions.row(1) = here;
  const auto begin = Clock::now();
  try {
    flooded.link->upload(still);
  } catch (const DeviceError&) {
    // The device does not answer, or sends more than can be read.
  }
  EXPECT_LT(ms_since(begin), 1500.0) << "ms";
}

INSTANTIATE_TEST_SUITE_P(Links, Flood,
                         testing::Values(LinkCase{"Hand", hand_link},
                                         LinkCase{"ArmState", [] { return arm_link(true); }},
                                         LinkCase{"ArmReplies", [] { return arm_link(false); }},
                                         LinkCase{"Ros", ros_link}),
                         [](const auto& test) { return test.param.name; });

TEST(FloodOfOneLine, EndsTheLinkWithAMessage) {
  FloodedLink flooded = hand_link();
  flooded.link->connect();
  flooded.flooding->flood("\x1b[2J no end");
  const auto begin = Clock::now();
  while (flooded.link->fault().empty() && ms_since(begin) < 1000.0) {
    flooded.link->update();
  }
  EXPECT_THAT(flooded.link->fault(), HasSubstr("more than 4096 characters"));
}

TEST(FloodOfOneMessage, EndsTheLinkWithAMessage) {
  FloodedLink flooded = ros_link();
  flooded.link->connect();
  const std::size_t before = test::peak_memory();
  // A text frame of 2⁶⁰ bytes.
  flooded.flooding->flood(std::string("\x81\x7f\x10\0\0\0\0\0\0\0", 10) + std::string(100000, 'x'));
  const auto begin = Clock::now();
  while (flooded.link->fault().empty() && ms_since(begin) < 1000.0) {
    flooded.link->update();
  }
  EXPECT_THAT(flooded.link->fault(), HasSubstr("more than 256 KiB"));
  EXPECT_LT(test::peak_memory() - before, kMostMemory);
}

/// A haptic device behind a proxy.
struct FloodedHaptic {
  FloodedHaptic()
      : emulator({}, 0),
        proxy(test::port_of(emulator.address())),
        device(make_haptic_device("haptic://localhost:" + std::to_string(proxy.port()))) {}

  HapticEmulator emulator;
  test::FloodingProxy proxy;
  std::unique_ptr<HapticDevice> device;
};

TEST(FloodedHapticDevice, IsReadInShortTurns) {
  FloodedHaptic haptic;
  haptic.device->connect();
  const std::size_t before = test::peak_memory();
  haptic.proxy.flood(state_line({0.0, {0.01, 0.0, 0.0}, Eigen::Vector3d::Zero(), false}));
  const auto begin = Clock::now();
  double longest = 0.0;
  int turns = 0;
  try {
    while (ms_since(begin) < 1000.0) {
      const double turn = test::cpu_seconds();
      static_cast<void>(haptic.device->read(milliseconds(5)));
      haptic.device->apply({0.0, 0.5, 0.0});
      longest = std::max(longest, test::cpu_seconds() - turn);
      ++turns;
    }
    EXPECT_GE(turns, kLeastTurns);
  } catch (const DeviceError& error) {
    EXPECT_THAT(error.what(), HasSubstr("more messages than can be read"));
  }
  EXPECT_LT(longest, kLongestTurn);
  EXPECT_GE(haptic.proxy.flooded(), kFlood);
  EXPECT_LT(test::peak_memory() - before, kMostMemory);
}

TEST(FloodedHapticDevice, IsNotWaitedForOnceAStopIsRequested) {
  FloodedHaptic haptic;
  haptic.proxy.flood("\n");
  LateStop stop(milliseconds(100));
  EXPECT_THROW(haptic.device->connect(stop.token()), DeviceError);
  EXPECT_LT(stop.ms_ago(), 100.0);
}

/// Streams whatever happens for a while, then stops. @returns how long that took, ms.
template <typename Stream>
double ms_to_stop(Stream& stream, const test::FloodingProxy& proxy) {
  const auto begin = Clock::now();
  while (proxy.flooded() < kFlood && ms_since(begin) < 5000.0) {
    std::this_thread::sleep_for(milliseconds(5));
  }
  EXPECT_GE(proxy.flooded(), kFlood);
  const auto stopped = Clock::now();
  stream.request_stop();
  EXPECT_TRUE(stream.wait(milliseconds(5000)));
  return ms_since(stopped);
}

constexpr milliseconds kFirstSample{3000};

template <typename Stream>
void wait_for_samples(const Stream& stream) {
  const auto begin = Clock::now();
  while (stream.statistics().frames < 5 && ms_since(begin) < kFirstSample.count()) {
    std::this_thread::sleep_for(milliseconds(5));
  }
  ASSERT_GE(stream.statistics().frames, 5U) << stream.error();
}

struct StreamCase {
  const char* name;
  std::string message;
};

std::string glove_record() {
  std::string record = "S" + std::string(22, '\x40');
  record += '\0';
  return record;
}

class FloodedGlove : public testing::TestWithParam<StreamCase> {};

TEST_P(FloodedGlove, StopsWithinATenthOfASecond) {
  GloveEmulatorSettings settings;
  settings.tcp_port = 0;
  GloveEmulator emulator(settings, [](double) {
    std::array<std::uint16_t, kGloveSensors> counts{};
    counts.fill(64);
    return counts;
  });
  test::FloodingProxy proxy(test::port_of(emulator.address()));
  GloveStream stream(
      std::make_unique<CyberGlove>("tcp://localhost:" + std::to_string(proxy.port())), {}, {});
  wait_for_samples(stream);
  const std::size_t before = test::peak_memory();
  proxy.flood(GetParam().message);
  EXPECT_LT(ms_to_stop(stream, proxy), 100.0);
  EXPECT_LT(test::peak_memory() - before, kMostMemory);
}

INSTANTIATE_TEST_SUITE_P(Messages, FloodedGlove,
                         testing::Values(StreamCase{"Frames", glove_record()},
                                         StreamCase{"Nothing", std::string(100, 'x')}),
                         [](const auto& test) { return test.param.name; });

class FloodedTracker : public testing::TestWithParam<StreamCase> {};

TEST_P(FloodedTracker, StopsWithinATenthOfASecond) {
  DeviceEmulatorSettings settings;
  settings.tcp_port = 0;
  DeviceEmulator emulator(settings, make_fastrak_unit({}, wrist_motion_signal(1)));
  test::FloodingProxy proxy(test::port_of(emulator.address()));
  TrackerStream stream(
      std::make_unique<PolhemusTracker>("tcp://localhost:" + std::to_string(proxy.port())), {}, {});
  wait_for_samples(stream);
  const std::size_t before = test::peak_memory();
  proxy.flood(GetParam().message);
  EXPECT_LT(ms_to_stop(stream, proxy), 100.0);
  EXPECT_LT(test::peak_memory() - before, kMostMemory);
}

/// A binary pose of a Fastrak's first station, at the origin.
std::string fastrak_record() {
  std::string record = "01 ";
  record += std::string(12, '\0');
  record += std::string("\0\0\x80\x3f", 4);
  record += std::string(12, '\0');
  return record + " ";
}

INSTANTIATE_TEST_SUITE_P(Messages, FloodedTracker,
                         testing::Values(StreamCase{"Poses", fastrak_record()},
                                         StreamCase{"Nothing", std::string(100, 'x')}),
                         [](const auto& test) { return test.param.name; });

TEST(FloodedUdpTracker, KeepsToItsTimeout) {
  const std::string port = test::free_udp_port();
  DeviceEmulatorSettings settings;
  settings.udp_receiver = "localhost:" + port;
  DeviceEmulator emulator(settings, make_datagram_unit({}, wrist_motion_signal(1)));
  UdpTracker tracker(port);
  static_cast<void>(tracker.connect({}));
  const std::jthread flood([&](const std::stop_token& stop) {
    const int fd = ::socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(port)));
    const std::string garbage(200, '{');
    while (!stop.stop_requested()) {
      ::sendto(fd, garbage.data(), garbage.size(), 0, reinterpret_cast<const sockaddr*>(&to),
               sizeof(to));
    }
    ::close(fd);
  });
  std::this_thread::sleep_for(milliseconds(50));
  const auto all = Clock::now();
  for (int calls = 1; calls <= 20; ++calls) {
    const double begin = test::cpu_seconds();
    try {
      static_cast<void>(tracker.next(milliseconds(20), {}));
    } catch (const DeviceError&) {
      break;  // Poses are lost among the rest, which is an answer, too.
    }
    EXPECT_LT(test::cpu_seconds() - begin, 0.06);
    EXPECT_LT(ms_since(all), 60.0 * calls);
  }
}

}  // namespace
}  // namespace handway::device
