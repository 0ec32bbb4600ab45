#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/human_hand.h"

#include <optional>
#include <string>
#include <string_view>

/// A hand's landmarks as a line of JSON, in files and streams: a program for a camera, a headset or
/// a Leap Motion needs ten lines to send it.
///
///     {"time": 0.033, "hand": "right", "landmarks": [[x, y, z], …]}
///
/// `landmarks` are 21 points in m in the order of HandLandmarks, in any right-handed frame; a point
/// may be {"x": …, "y": …, "z": …} too; an empty list, or null, means that no hand is seen. `time`
/// is in s on the sender's clock and may be left out of a stream; `hand` is "right" (default) or
/// "left". Other keys are ignored.

namespace handway::device {

/// One line of a stream of hand landmarks.
struct LandmarkLine {
  std::optional<double> time;              ///< s, on the sender's clock.
  bool left = false;                       ///< A left hand's.
  std::optional<HandLandmarks> landmarks;  ///< m; none: no hand was seen.
};

/// @param text without its end, bounded by the caller.
/// @throws LineProtocolError with the value found and the expected one, for any other text or for
/// points of no hand: points in a line, or a reach from the wrist that is not from 4 cm to 50 cm.
[[nodiscard]] HANDWAY_DEVICE_EXPORT LandmarkLine read_landmark_line(std::string_view text);

/// Text without an end of line. @pre numbers are finite.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string write_landmark_line(const LandmarkLine& line);

}  // namespace handway::device
