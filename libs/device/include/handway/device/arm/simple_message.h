#pragma once

#include "handway/device/core/robot_status.h"
#include "handway/device/export.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

/// @file
/// The messages of ROS-Industrial's simple_message protocol that the VAL3 server for Staeubli CS8
/// and CS9 controllers uses: joint trajectory points to port 11000, joint positions and status from
/// port 11002.
///
/// On the wire: length (of the rest), type, communication, reply code, body; all int32 or float32,
/// little-endian. Joints are in rad, ten of them, unused ones 0. Source:
/// ros-industrial/industrial_core and staubli_val3_driver, message definitions.
namespace handway::device {

/// Number of joint values in every message; unused ones are 0.
inline constexpr std::size_t kSimpleMessageJoints = 10;

/// Kind of content of a message.
enum class SimpleMessageType : std::int32_t {
  kJointPosition = 10,         ///< Body: sequence, joints.
  kJointTrajectoryPoint = 11,  ///< Body: sequence, joints, velocity (0 to 1), duration (s).
  kStatus = 13,                ///< Body: RobotStatus.
};

/// Role of a message: published, or part of a service call.
enum class SimpleMessageKind : std::int32_t { kTopic = 1, kRequest = 2, kReply = 3 };

/// Outcome that a reply reports.
enum class SimpleMessageReply : std::int32_t { kNone = 0, kSuccess = 1, kFailure = 2 };

/// Sequence number of a trajectory point that means "stop at once and discard the rest".
inline constexpr std::int32_t kStopSequence = -4;

/// One message; its type decides which fields are valid.
struct SimpleMessage {
  SimpleMessageType type = SimpleMessageType::kJointPosition;
  SimpleMessageKind kind = SimpleMessageKind::kTopic;
  SimpleMessageReply reply = SimpleMessageReply::kNone;
  std::int32_t sequence = 0;
  std::array<float, kSimpleMessageJoints> joints{};
  float velocity = 0.0F;
  float duration = 0.0F;
  RobotStatus status;

  bool operator==(const SimpleMessage&) const = default;
};

/// Thrown for bytes that are not a message of this protocol.
class SimpleMessageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The message with its length in front: 44, 60 or 68 bytes.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::vector<std::uint8_t> encode(const SimpleMessage& message);

/// Takes bytes as they come from a connection, in pieces of any size, and returns messages.
/// Between two calls of add(), call next() until it returns nothing: then it stores less than one
/// message.
class HANDWAY_DEVICE_EXPORT SimpleMessageParser {
 public:
  void add(std::span<const std::uint8_t> bytes);

  /// The next complete message, if it has arrived.
  /// @throws SimpleMessageError if the next bytes are not a message: an unknown type, kind or reply
  /// code, a length that is not the type's, a number that is not finite. The next message can't be
  /// found then: close the connection.
  [[nodiscard]] std::optional<SimpleMessage> next();

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t begin_ = 0;  ///< Start of the bytes not returned by next() yet.
};

}  // namespace handway::device
