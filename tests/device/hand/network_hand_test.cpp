/// The client of the hand protocol, on an emulated hand, through a real socket.
#include "handway/device/hand/network_hand.h"

#include "handway/device/core/device_error.h"
#include "handway/device/emulators/hand_emulator.h"
#include "support/motions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace handway::device {
namespace {

using testing::HasSubstr;

constexpr double kOpen = -0.1;

Eigen::VectorXd open_hand() { return sah_joints().upper.cwiseMin(kOpen); }

Eigen::VectorXd way() {
  Eigen::VectorXd way = Eigen::VectorXd::Zero(13);
  for (const Eigen::Index j : {2, 5, 8, 11}) {
    way[j] = -0.4;
    way[j + 1] = -0.5;
  }
  return way;
}

HandControllerSettings open_sah() {
  HandControllerSettings settings;
  settings.joints = sah_joints();
  settings.position = open_hand();
  return settings;
}

std::unique_ptr<NetworkHand> hand_at(const std::string& address,
                                     JointRanges joints = sah_joints()) {
  const auto port = static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1)));
  return std::make_unique<NetworkHand>(address, "localhost", port, std::move(joints));
}

/// A hand that is connected and knows its motion.
struct Cell {
  explicit Cell(const HandControllerSettings& settings = open_sah())
      : emulator(settings, 0), hand(hand_at(emulator.address())) {
    hand->connect();
    hand->upload(test::swing(open_hand(), way(), 1.0));
  }

  HandEmulator emulator;
  std::unique_ptr<NetworkHand> hand;
};

TEST(NetworkHand, ClosesInItsTime) {
  Cell cell;
  MotionTolerances tolerances;
  tolerances.following = 0.1;
  cell.hand->start(tolerances);
  test::run_to_end(*cell.hand);
  EXPECT_EQ(cell.hand->phase(), MotionPhase::kDone) << cell.hand->fault();
  EXPECT_LT((cell.emulator.position() - open_hand() - way()).norm(), 0.02);
}

TEST(NetworkHand, HoldsWhereItIsTold) {
  Cell cell;
  cell.hand->start();
  test::update_until(*cell.hand, [&] { return cell.emulator.moving(); });
  const double hold = cell.hand->pause(0.5);
  EXPECT_NEAR(hold, 0.5, 0.03);
  test::update_until(
      *cell.hand, [] { return false; }, 0.8);
  EXPECT_FALSE(cell.emulator.moving());
  EXPECT_TRUE(cell.emulator.position().isApprox(cell.hand->trajectory().at(hold), 0.01));
  cell.hand->resume();
  test::run_to_end(*cell.hand);
  EXPECT_EQ(cell.hand->phase(), MotionPhase::kDone) << cell.hand->fault();
}

TEST(NetworkHand, StopsTheHandAtOnce) {
  Cell cell;
  cell.hand->start();
  test::update_until(*cell.hand, [&] { return cell.emulator.position()[6] < kOpen - 0.1; });
  ASSERT_TRUE(cell.emulator.moving());
  cell.hand->stop();
  EXPECT_EQ(cell.hand->phase(), MotionPhase::kStopped);
  EXPECT_LT(test::wait_until([&] { return !cell.emulator.moving(); }), 0.25);
  EXPECT_GT(cell.emulator.position()[6], kOpen - 0.45);
}

TEST(NetworkHand, RefusesAHandOfOtherJoints) {
  const HandEmulator emulator(open_sah(), 0);
  JointRanges four = sah_joints();
  four.names.resize(4);
  four.lower.conservativeResize(4);
  four.upper.conservativeResize(4);
  four.velocity.conservativeResize(4);
  const auto hand = hand_at(emulator.address(), four);
  try {
    hand->connect();
    FAIL() << "it connected";
  } catch (const DeviceError& error) {
    EXPECT_THAT(error.what(), HasSubstr("4 joints"));
  }
}

TEST(NetworkHand, CanCloseAgainAfterAFault) {
  HandControllerSettings settings = open_sah();
  settings.fault = {FaultKind::kJointLimit, 0.3};
  Cell cell(settings);
  cell.hand->start();
  test::run_to_end(*cell.hand);
  ASSERT_EQ(cell.hand->phase(), MotionPhase::kFailed);
  EXPECT_LT(test::wait_until([&] { return !cell.emulator.moving(); }), 0.5);
  const auto again = hand_at(cell.emulator.address());
  again->connect();
  const Eigen::VectorXd from = cell.emulator.position();
  again->upload(test::swing(from, -0.1 * Eigen::VectorXd::Unit(13, 2), 0.5));
  again->start();
  test::run_to_end(*again);
  EXPECT_EQ(again->phase(), MotionPhase::kDone) << again->fault();
}

struct FaultCase {
  FaultKind kind;
  const char* name;
  const char* message;
};

class FaultyHand : public testing::TestWithParam<FaultCase> {};

TEST_P(FaultyHand, EndsTheMotionWithAMessage) {
  HandControllerSettings settings = open_sah();
  settings.fault = {GetParam().kind, 0.3};
  Cell cell(settings);
  MotionTolerances tolerances;
  tolerances.following = 0.1;
  cell.hand->start(tolerances);
  test::run_to_end(*cell.hand);
  EXPECT_EQ(cell.hand->phase(), MotionPhase::kFailed);
  EXPECT_THAT(cell.hand->fault(), HasSubstr(GetParam().message));
  EXPECT_LT(test::wait_until([&] { return !cell.emulator.moving(); }), 0.5);
  EXPECT_GT((cell.emulator.position() - open_hand() - way()).norm(), 0.05) << "stopped under way";
}

INSTANTIATE_TEST_SUITE_P(Faults, FaultyHand,
                         testing::Values(FaultCase{FaultKind::kLate, "Late", "no joint positions"},
                                         FaultCase{FaultKind::kLost, "Lost", "connection broke"},
                                         FaultCase{FaultKind::kRefused, "Refused", "refused"},
                                         FaultCase{FaultKind::kEstop, "Estop", "emergency stop"},
                                         FaultCase{FaultKind::kJointLimit, "JointLimit",
                                                   "at its limit"},
                                         FaultCase{FaultKind::kSlow, "Slow", "does not follow"}),
                         [](const auto& test) { return test.param.name; });

TEST(HandEmulator, StopsWhenItsHostIsGone) {
  Cell cell;
  cell.hand->start();
  test::update_until(*cell.hand, [&] { return cell.emulator.moving(); });
  cell.hand.reset();
  EXPECT_LT(test::wait_until([&] { return !cell.emulator.moving(); }), 0.3);
}

TEST(HandEmulator, StopsWhenItsHostSaysNothing) {
  Cell cell;
  cell.hand->start();
  test::update_until(*cell.hand, [&] { return cell.emulator.moving(); });
  EXPECT_LT(test::wait_until([&] { return !cell.emulator.moving(); }), 0.6);
  EXPECT_GT((cell.emulator.position() - open_hand() - way()).norm(), 0.05) << "stopped under way";
}

}  // namespace
}  // namespace handway::device
