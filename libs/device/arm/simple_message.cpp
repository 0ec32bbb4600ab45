#include "handway/device/arm/simple_message.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

namespace handway::device {
namespace {

constexpr std::size_t kWord = 4;
constexpr std::size_t kHeader = 3 * kWord;

class Writer {
 public:
  void add(std::int32_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    for (unsigned shift = 0; shift < 32; shift += 8) {
      bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
    }
  }
  void add(float value) { add(std::bit_cast<std::int32_t>(value)); }

  std::vector<std::uint8_t> bytes;
};

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::int32_t integer() {
    std::uint32_t bits = 0;
    for (unsigned i = 0; i < kWord; ++i) {
      bits |= static_cast<std::uint32_t>(bytes_[i]) << (8 * i);
    }
    bytes_ = bytes_.subspan(kWord);
    return static_cast<std::int32_t>(bits);
  }

  float number() {
    const auto value = std::bit_cast<float>(integer());
    if (!std::isfinite(value)) {
      throw SimpleMessageError("a number that is not finite");
    }
    return value;
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

std::size_t body_length(std::int32_t type) {
  switch (static_cast<SimpleMessageType>(type)) {
    case SimpleMessageType::kJointPosition:
      return kWord * (1 + kSimpleMessageJoints);
    case SimpleMessageType::kJointTrajectoryPoint:
      return kWord * (3 + kSimpleMessageJoints);
    case SimpleMessageType::kStatus:
      return kWord * 7;
  }
  throw SimpleMessageError(fmt::format("a message of the unknown type {}", type));
}

}  // namespace

std::vector<std::uint8_t> encode(const SimpleMessage& message) {
  const auto type = static_cast<std::int32_t>(message.type);
  Writer out;
  out.add(static_cast<std::int32_t>(kHeader + body_length(type)));
  out.add(type);
  out.add(static_cast<std::int32_t>(message.kind));
  out.add(static_cast<std::int32_t>(message.reply));
  if (message.type == SimpleMessageType::kStatus) {
    const RobotStatus& status = message.status;
    for (const std::int32_t value :
         {status.drives_powered, status.emergency_stopped, status.error_code, status.in_error,
          status.in_motion, status.mode, status.motion_possible}) {
      out.add(value);
    }
    return out.bytes;
  }
  out.add(message.sequence);
  for (const float joint : message.joints) {
    out.add(joint);
  }
  if (message.type == SimpleMessageType::kJointTrajectoryPoint) {
    out.add(message.velocity);
    out.add(message.duration);
  }
  return out.bytes;
}

void SimpleMessageParser::add(std::span<const std::uint8_t> bytes) {
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(begin_));
  begin_ = 0;
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

std::optional<SimpleMessage> SimpleMessageParser::next() {
  const auto rest = std::span<const std::uint8_t>(bytes_).subspan(begin_);
  if (rest.size() < kWord + kHeader) {
    return std::nullopt;
  }
  Reader in(rest);
  const std::int32_t length = in.integer();
  const std::int32_t type = in.integer();
  const std::int32_t kind = in.integer();
  const std::int32_t reply = in.integer();
  const std::size_t expected = kHeader + body_length(type);
  if (length != static_cast<std::int32_t>(expected)) {
    throw SimpleMessageError(
        fmt::format("a message of type {} with length {}, not {}", type, length, expected));
  }
  if (kind < 1 || kind > 3 || reply < 0 || reply > 2) {
    throw SimpleMessageError(
        fmt::format("a message of the unknown kind {} with reply code {}", kind, reply));
  }
  if (rest.size() < kWord + expected) {
    return std::nullopt;
  }
  SimpleMessage message;
  message.type = static_cast<SimpleMessageType>(type);
  message.kind = static_cast<SimpleMessageKind>(kind);
  message.reply = static_cast<SimpleMessageReply>(reply);
  if (message.type == SimpleMessageType::kStatus) {
    RobotStatus& status = message.status;
    for (std::int32_t* value :
         {&status.drives_powered, &status.emergency_stopped, &status.error_code, &status.in_error,
          &status.in_motion, &status.mode, &status.motion_possible}) {
      *value = in.integer();
    }
  } else {
    message.sequence = in.integer();
    for (float& joint : message.joints) {
      joint = in.number();
    }
    if (message.type == SimpleMessageType::kJointTrajectoryPoint) {
      message.velocity = in.number();
      message.duration = in.number();
    }
  }
  begin_ += kWord + expected;
  return message;
}

}  // namespace handway::device
