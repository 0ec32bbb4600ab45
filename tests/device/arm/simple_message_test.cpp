#include "handway/device/arm/simple_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace handway::device {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The bytes in `hex`, and zeros up to `size`.
Bytes bytes(const std::string& hex, std::size_t size) {
  Bytes all;
  std::istringstream words(hex);
  for (std::string word; words >> word;) {
    all.push_back(static_cast<std::uint8_t>(std::stoi(word, nullptr, 16)));
  }
  all.resize(size);
  return all;
}

constexpr const char* kJoints = "CD CC CC 3D CD CC 4C BE 00 00 C0 3F 00 00 00 00 9A 99 99 3E";

SimpleMessage message(SimpleMessageType type, SimpleMessageKind kind) {
  SimpleMessage made;
  made.type = type;
  made.kind = kind;
  if (type != SimpleMessageType::kStatus) {
    made.joints = {0.1F, -0.2F, 1.5F, 0.0F, 0.3F};
  }
  return made;
}

SimpleMessage trajectory_point() {
  SimpleMessage point =
      message(SimpleMessageType::kJointTrajectoryPoint, SimpleMessageKind::kRequest);
  point.velocity = 0.1F;
  point.duration = 5.0F;
  return point;
}

SimpleMessage status() {
  SimpleMessage made = message(SimpleMessageType::kStatus, SimpleMessageKind::kTopic);
  made.status = {1, 0, 0, 0, 0, 2, 1};
  return made;
}

SimpleMessage parsed(const Bytes& all) {
  SimpleMessageParser parser;
  parser.add(all);
  return parser.next().value();
}

TEST(SimpleMessage, HasTheBytesOfTheProtocol) {
  EXPECT_EQ(
      encode(message(SimpleMessageType::kJointPosition, SimpleMessageKind::kTopic)),
      bytes("38 00 00 00 0A 00 00 00 01 00 00 00 00 00 00 00 00 00 00 00 " + std::string(kJoints),
            60));
  Bytes point = bytes(
      "40 00 00 00 0B 00 00 00 02 00 00 00 00 00 00 00 00 00 00 00 " + std::string(kJoints), 60);
  for (const int byte : {0xCD, 0xCC, 0xCC, 0x3D, 0x00, 0x00, 0xA0, 0x40}) {
    point.push_back(static_cast<std::uint8_t>(byte));
  }
  EXPECT_EQ(encode(trajectory_point()), point);
  EXPECT_EQ(encode(status()),
            bytes("28 00 00 00 0D 00 00 00 01 00 00 00 00 00 00 00 01 00 00 00 00 00 00 00 00 00 "
                  "00 00 00 00 00 00 00 00 00 00 02 00 00 00 01 00 00 00",
                  44));
  SimpleMessage stop;
  stop.type = SimpleMessageType::kJointTrajectoryPoint;
  stop.kind = SimpleMessageKind::kRequest;
  stop.sequence = kStopSequence;
  EXPECT_EQ(encode(stop), bytes("40 00 00 00 0B 00 00 00 02 00 00 00 00 00 00 00 FC FF FF FF", 68));
}

TEST(SimpleMessage, ReadsBackWhatItWrites) {
  SimpleMessage reply = trajectory_point();
  reply.kind = SimpleMessageKind::kReply;
  reply.reply = SimpleMessageReply::kFailure;
  for (const SimpleMessage& one : {status(), trajectory_point(), reply}) {
    EXPECT_EQ(parsed(encode(one)), one);
  }
}

TEST(SimpleMessageParser, TakesBytesInPiecesOfAnySize) {
  Bytes all = encode(status());
  const Bytes second = encode(trajectory_point());
  all.insert(all.end(), second.begin(), second.end());
  for (std::size_t size = 1; size <= all.size(); ++size) {
    SimpleMessageParser parser;
    std::vector<SimpleMessage> found;
    for (std::size_t at = 0; at < all.size(); at += size) {
      parser.add(std::span(all).subspan(at, std::min(size, all.size() - at)));
      while (const auto next = parser.next()) {
        found.push_back(*next);
      }
    }
    EXPECT_THAT(found, testing::ElementsAre(status(), trajectory_point())) << size;
  }
}

TEST(SimpleMessageParser, RefusesWhatIsNoMessage) {
  const auto refuses = [](std::size_t at, int value) {
    Bytes all = encode(trajectory_point());
    all[at] = static_cast<std::uint8_t>(value);
    SimpleMessageParser parser;
    parser.add(all);
    EXPECT_THROW(static_cast<void>(parser.next()), SimpleMessageError) << at;
  };
  refuses(0, 0x41);   // length
  refuses(3, 0xFF);   // a length below 0
  refuses(4, 0x63);   // type
  refuses(8, 0x00);   // kind
  refuses(12, 0x03);  // reply code
  SimpleMessage broken = trajectory_point();
  broken.joints[3] = std::numeric_limits<float>::quiet_NaN();
  SimpleMessageParser parser;
  parser.add(encode(broken));
  EXPECT_THROW(static_cast<void>(parser.next()), SimpleMessageError);
}

}  // namespace
}  // namespace handway::device
