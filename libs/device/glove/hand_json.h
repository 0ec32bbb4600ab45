#pragma once

#include "handway/device/glove/hand_message.h"
#include "handway/device/glove/human_hand.h"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

/// Elements of messages of hands in JSON. All functions throw LineProtocolError with the name of
/// the element.

namespace handway::device {

using HandJson = nlohmann::ordered_json;

/// @throws LineProtocolError unless `text` is a JSON object.
[[nodiscard]] HandJson read_hand_json(std::string_view text);

/// Returns the value of a key that has to be there.
[[nodiscard]] const HandJson& member_of(const HandJson& object, const char* key);
/// Returns the value of "time", s, if there is one.
[[nodiscard]] std::optional<double> time_of_hand(const HandJson& object);

/// @param name for messages: "x of landmark 3".
[[nodiscard]] double finite_number(const HandJson& value, const std::string& name);
/// Reads [x, y, z] or {"x": …, "y": …, "z": …}. @param name for messages: "landmark 3".
[[nodiscard]] Eigen::Vector3d point_of_json(const HandJson& point, const std::string& name);
/// Reads [x, y, z, w] or {"x": …, "y": …, "z": …, "w": …}, of any length.
[[nodiscard]] Eigen::Vector4d quaternion_of_json(const HandJson& rotation, const std::string& name);
/// Returns the rotation of a quaternion x, y, z, w, which has to be of unit length within 1 %.
[[nodiscard]] Eigen::Quaterniond rotation_of(const Eigen::Vector4d& xyzw, const std::string& name);
/// Returns whether a value names the left hand; "right", "Right", "left" and "Left" are known.
[[nodiscard]] bool is_left_hand(const HandJson& hand);

/// Checks that landmarks are those of a hand in m.
void check_hand(const HandLandmarks& landmarks);

/// Reads a hand of landmarks: see landmark_line.h.
[[nodiscard]] HandObservation read_landmark_hand(const HandJson& object);
/// Reads a hand of OpenXR.
[[nodiscard]] HandObservation read_openxr_hand(const HandJson& object);
/// Reads the right and the left hand of a frame of Rokoko Studio.
[[nodiscard]] std::vector<HandObservation> read_rokoko_hands(const HandJson& frame);
/// Reads the hand of ManusGlove, a message of Manus Core's ROS 2 package.
[[nodiscard]] HandObservation read_manus_hand(const HandJson& message);
/// Reads 40 angles in degrees, separated by commas: 20 of the left and 20 of the right hand.
[[nodiscard]] std::vector<HandObservation> read_manus_numbers(std::string_view text);

/// Returns whether bytes begin as a frame of LZ4.
[[nodiscard]] bool is_lz4_frame(std::string_view bytes);
/// Decompresses frames of LZ4. @throws LineProtocolError if they are damaged, cut off, or larger
/// than kLongestHandJson.
[[nodiscard]] std::string decompressed_lz4_frame(std::string_view bytes);

}  // namespace handway::device
