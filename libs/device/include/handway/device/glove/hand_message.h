#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/raw_columns.h"
#include "handway/geometric/math/pose.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Messages by which hand trackers and gloves of different makers send a hand: a line of text or a
/// datagram. The contents, not the sender, decide the format:
///
///   - 21 landmarks as JSON: see landmark_line.h;
///   - the 26 joints of XR_EXT_hand_tracking as JSON: {"time": s, "hand": "right" or "left",
///     "joints": […]} in the order of XrHandJointEXT (palm, wrist, thumb_metacarpal, …). A joint is
///     [x, y, z], [x, y, z, qx, qy, qz, qw] or {"position": …, "orientation": …, "flags": bits of
///     XrSpaceLocationFlags}. An empty list, "isActive": false or an invalid position means that no
///     hand is seen;
///   - a frame of Rokoko Studio, JSON of version 3 or 4, plain or as a frame of LZ4: the hands of
///     the first actor with a glove, in Unity's left-handed frame, m;
///   - ergonomics of Manus Core in degrees, as JSON of its ROS 2 message ManusGlove, alone or as
///     "msg" of a message of rosbridge; or 40 numbers separated by commas, of the left hand first.

namespace handway::device {

/// Format of a hand's messages.
enum class HandWire { kLandmarks, kOpenXr, kRokoko, kRokokoLz4, kManus };

/// "hand landmarks", "OpenXR hand joints", "Rokoko Studio", "Rokoko Studio, LZ4", "Manus
/// ergonomics".
[[nodiscard]] HANDWAY_DEVICE_EXPORT const std::string& name_of(HandWire wire);

/// Returns the names and units of HandObservation::raw. @param left of Rokoko's bones.
[[nodiscard]] HANDWAY_DEVICE_EXPORT RawColumns raw_columns_of(HandWire wire, bool left);

/// A hand in a message. It has landmarks or angles, or neither if it is not seen.
struct HandObservation {
  std::optional<double> time = std::nullopt;  ///< s, on the sender's clock.
  bool left = false;                          ///< A left hand's.
  /// m, in a right-handed frame of the source.
  std::optional<HandLandmarks> landmarks = std::nullopt;
  /// rad, by sensor, flexion positive; NaN without a measurement. From sources of angles.
  std::optional<std::array<double, kGloveSensors>> angles = std::nullopt;
  /// Pose of the wrist in the same frame as the landmarks, m, if the source has it. The axes of the
  /// wrist are those of the source.
  std::optional<geometric::Pose> X_SH = std::nullopt;
  /// Numbers of a hand that is seen as they were sent: see raw_columns_of().
  std::vector<double> raw = {};

  [[nodiscard]] bool is_seen() const { return landmarks.has_value() || angles.has_value(); }
};

/// The hands of one message.
struct HandMessage {
  HandWire wire = HandWire::kLandmarks;
  std::vector<HandObservation> hands;  ///< The right one first; hands that are not seen, too.
};

/// Longest message, bytes.
inline constexpr std::size_t kLongestHandMessage = std::size_t{64} * 1024;
/// Longest JSON in a frame of LZ4, bytes.
inline constexpr std::size_t kLongestHandJson = std::size_t{1024} * 1024;

/// @param message without its end of line.
/// @throws LineProtocolError with the value found and the expected one, for any other message, or
/// for landmarks of no hand: see read_landmark_line().
[[nodiscard]] HANDWAY_DEVICE_EXPORT HandMessage read_hand_message(std::string_view message);

}  // namespace handway::device
