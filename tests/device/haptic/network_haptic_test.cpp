/// The haptic protocol, and its client on an emulated device through a real socket.
#include "handway/device/core/device_error.h"
#include "handway/device/emulators/haptic_emulator.h"
#include "handway/device/haptic/haptic_device.h"
#include "support/motions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>

namespace handway::device {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string without_end(std::string line) {
  line.pop_back();
  return line;
}

TEST(HapticProtocol, ReadsBackLinesToTheBit) {
  const HapticSample sample{1.0 / 3.0, {0.1, -0.2, 1e-9}, {0.3, 0.0, -7.0}, true};
  EXPECT_EQ(parse_haptic_state(without_end(state_line(sample))), sample);
  const Eigen::Vector3d force(0.1, -1.0 / 3.0, 2.0);
  EXPECT_EQ(parse_haptic_force(without_end(force_line(force))), force);
  const HapticAbilities abilities{3.3, {0.08, 0.06, 0.035}};
  EXPECT_EQ(parse_haptic_hello(without_end(hello_line(abilities))).workspace, abilities.workspace);
}

TEST(HapticProtocol, RefusesLinesThatMakeNoSense) {
  for (const char* line : {"", "hello", "hello 2 3 1 1 1", "hello 1 0 1 1 1", "hello 1 3 1 -1 1"}) {
    EXPECT_THROW(static_cast<void>(parse_haptic_hello(line)), LineProtocolError) << line;
  }
  for (const char* line : {"state", "state 0 0 0 0 0 0 0 2", "state 0 nan 0 0 0 0 0 1",
                           "state 0 0 0 0 0 0 0 1 0", "force 0 0 0"}) {
    EXPECT_THROW(static_cast<void>(parse_haptic_state(line)), LineProtocolError) << line;
  }
  EXPECT_THROW(static_cast<void>(parse_haptic_force("force 0 inf 0")), LineProtocolError);
}

TEST(EmulatedHaptic, LetsGoWhenItHearsNothing) {
  EmulatedHaptic device({});
  EXPECT_EQ(device.feedback(), "");
  EXPECT_THAT(device.receive("hello 1", 0.0), StartsWith("hello 1 "));
  EXPECT_THAT(device.feedback(), StartsWith("state 0 0 0 0 "));
  EXPECT_EQ(device.receive("force 0 1 0", 0.01), "");
  EXPECT_EQ(device.force(), Eigen::Vector3d(0.0, 1.0, 0.0));
  device.advance(0.055);
  EXPECT_EQ(device.force().y(), 1.0);
  device.advance(0.062);
  EXPECT_EQ(device.force(), Eigen::Vector3d::Zero());
  EXPECT_EQ(device.receive("force 0 100 0", 0.07), "");
  EXPECT_NEAR(device.force().norm(), 3.3, 1e-12) << "no more than it can";
  device.connection_lost();
  EXPECT_EQ(device.force(), Eigen::Vector3d::Zero());
  EXPECT_THAT(device.receive("nonsense", 0.08), StartsWith("fault"));
  EXPECT_THAT(device.receive("hello 9", 0.08), AllOf(StartsWith("fault"), HasSubstr("version 1")));
}

/// A device that is connected and gets a constant force.
struct Pushed {
  explicit Pushed(const EmulatedHapticSettings& settings = {})
      : emulator(settings, 0), device(make_haptic_device(emulator.address())) {
    device->connect();
  }

  /// Reads and pushes for so long, s. @returns what ended it; empty if nothing did.
  [[nodiscard]] std::string push(double seconds) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    try {
      while (std::chrono::steady_clock::now() < end) {
        if (device->read(milliseconds(5))) {
          device->apply({0.0, 0.5, 0.0});
        }
      }
    } catch (const DeviceError& error) {
      return error.what();
    }
    return "";
  }
  /// Pushes until the device does so too, at most 3 s. @returns its force then.
  [[nodiscard]] Eigen::Vector3d force_after(const Eigen::Vector3d& wanted) const {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    static_cast<void>(test::wait_until([&] {
      device->apply(wanted);
      force = emulator.force();
      return force != Eigen::Vector3d::Zero();
    }));
    return force;
  }
  [[nodiscard]] bool lets_go() const {
    return test::wait_until([&] { return emulator.force() == Eigen::Vector3d::Zero(); }) < 1.0;
  }

  HapticEmulator emulator;
  std::unique_ptr<HapticDevice> device;
};

TEST(NetworkHaptic, PushesTheHandAndLetsGo) {
  Pushed pushed;
  EXPECT_NEAR(pushed.device->abilities().force, 3.3, 1e-12);
  EXPECT_EQ(pushed.push(0.2), "");
  EXPECT_EQ(pushed.force_after({0.0, 0.5, 0.0}), Eigen::Vector3d(0.0, 0.5, 0.0));
  pushed.device->release();
  EXPECT_TRUE(pushed.lets_go());
}

TEST(NetworkHaptic, NeverAsksForMoreThanTheDeviceCan) {
  Pushed pushed;
  EXPECT_NEAR(pushed.force_after({0.0, 0.0, 1e9}).norm(), 3.3, 1e-9);
  pushed.device->apply({0.0, std::numeric_limits<double>::quiet_NaN(), 0.0});
  EXPECT_TRUE(pushed.lets_go());
}

TEST(NetworkHaptic, LetsGoWhenTheHostIsGone) {
  Pushed pushed;
  EXPECT_EQ(pushed.push(0.1), "");
  pushed.device.reset();
  EXPECT_TRUE(pushed.lets_go());
}

TEST(NetworkHaptic, SaysThatNobodyAnswersAndWhatAddressesAreLike) {
  EXPECT_THROW(make_haptic_device("haptic://localhost:1")->connect(), DeviceError);
  for (const char* address : {"", "localhost", "haptic://", "arm://localhost"}) {
    EXPECT_THROW(static_cast<void>(make_haptic_device(address)), geometric::InputError) << address;
  }
}

struct FaultCase {
  FaultKind kind;
  const char* name;
  const char* message;
};

class FaultyHaptic : public testing::TestWithParam<FaultCase> {};

TEST_P(FaultyHaptic, EndsWithAMessageAndWithoutForce) {
  EmulatedHapticSettings settings;
  settings.fault = {GetParam().kind, 0.2};
  const Pushed pushed(settings);
  EXPECT_THAT(pushed.push(3.0), AllOf(HasSubstr(GetParam().message), HasSubstr("haptic://")));
  EXPECT_TRUE(pushed.lets_go());
}

INSTANTIATE_TEST_SUITE_P(Faults, FaultyHaptic,
                         testing::Values(FaultCase{FaultKind::kLate, "Late", "no position"},
                                         FaultCase{FaultKind::kLost, "Lost", "connection broke"},
                                         FaultCase{FaultKind::kRefused, "Refused", "too warm"},
                                         FaultCase{FaultKind::kEstop, "Estop", "emergency stop"}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace handway::device
