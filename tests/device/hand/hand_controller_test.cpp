/// The protocol of hands, and the emulated hand without wires.
#include "handway/device/emulators/hand_emulator.h"
#include "handway/device/hand/hand_protocol.h"
#include "handway/device/hand/network_hand.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::device {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

HandControllerSettings settings() {
  HandControllerSettings made;
  made.joints = sah_joints();
  made.position = made.joints.upper;
  return made;
}

TEST(HandProtocol, ReadsBackStatesToTheBit) {
  const HandState state{0.125, "running", Eigen::VectorXd::LinSpaced(13, -1.0 / 3.0, 0.1)};
  std::string line = to_line(state);
  EXPECT_THAT(line, StartsWith("state 0.125 running -0.3333"));
  line.pop_back();
  EXPECT_EQ(parse_hand_state(line, 13), state);
  EXPECT_THROW(static_cast<void>(parse_hand_state(line, 12)), LineProtocolError);
  EXPECT_THROW(static_cast<void>(parse_hand_state("state 0 idle nan", 1)), LineProtocolError);
  EXPECT_THROW(static_cast<void>(parse_hand_state("state x idle 0", 1)), LineProtocolError);
}

TEST(HandProtocol, CutsBytesIntoLines) {
  LineBuffer lines;
  const std::string text = "ok start\r\nok st";
  lines.add({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  EXPECT_EQ(lines.next(), "ok start");
  EXPECT_EQ(lines.next(), std::nullopt);
  const std::vector<std::uint8_t> endless(5000, 'x');
  lines.add(endless);
  EXPECT_THROW(static_cast<void>(lines.next()), LineProtocolError);
}

TEST(HandController, TellsNothingBeforeHello) {
  HandController hand(settings());
  EXPECT_EQ(hand.feedback(), "");
  EXPECT_EQ(hand.receive("hello 1", 0.0), "hello 1 13\n");
  EXPECT_THAT(hand.feedback(), StartsWith("state 0 idle "));
}

TEST(HandController, RefusesWhatMakesNoSense) {
  HandController hand(settings());
  EXPECT_THAT(hand.receive("hello 2", 0.0), HasSubstr("version 1"));
  EXPECT_THAT(hand.receive("start", 0.0), HasSubstr("not ready"));
  EXPECT_THAT(hand.receive("dance", 0.0), HasSubstr("dance"));
  EXPECT_THAT(hand.receive("", 0.0), StartsWith("error"));
  EXPECT_THAT(hand.receive("point 0 1", 0.0), StartsWith("error"));
  EXPECT_THAT(hand.receive("trajectory 1", 0.0), StartsWith("error"));
  EXPECT_THAT(hand.receive("trajectory 1e30", 0.0), StartsWith("error"));
  EXPECT_EQ(hand.receive("trajectory 2", 0.0), "");
  EXPECT_EQ(hand.receive("point 0 0 0 0 -0.1 0 0 -0.1 0 0 -0.1 0 0 -0.1", 0.0), "");
  EXPECT_THAT(hand.receive("point 1 9 0 0 -0.1 0 0 -0.1 0 0 -0.1 0 0 -0.1", 0.0),
              HasSubstr("thumb_base"));
  EXPECT_THAT(hand.receive("start", 0.0), HasSubstr("not ready"));
}

}  // namespace
}  // namespace handway::device
