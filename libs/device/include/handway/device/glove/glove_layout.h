#pragma once

#include "handway/device/export.h"
#include "handway/geometric/math/pose.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace handway::device {

/// Number of sensors in every frame: those of cyberglove_sensors().
inline constexpr int kGloveSensors = 22;

/// Sensors of a glove, by their indices in cyberglove_sensors().
using SensorIndices = std::vector<int>;

/// Number of fingers of the human hand, the thumb included.
inline constexpr int kFingers = 5;

/// Lengths of a person's bones by finger, thumb to little finger, m: from the wrist to the
/// finger's base (the thumb's CMC joint, the others' knuckles), then from joint to joint to the
/// tip.
using HandBones = std::array<std::array<double, 4>, kFingers>;

/// Measurement of a glove at one time. Sensors that the glove lacks stay at 0, which no real sensor
/// ever reads.
struct GloveFrame {
  double time = 0.0;  ///< s since the stream began, on a steady clock.
  std::array<std::uint16_t, kGloveSensors> counts{};  ///< Raw, 1 … 255.
  /// Angles of a source that measures angles itself, rad, flexion positive, NaN without a
  /// measurement: no calibration applies, and the counts are those of a typical glove.
  std::optional<std::array<double, kGloveSensors>> angles = std::nullopt;
  /// Bones, from a source that measures them.
  std::optional<HandBones> bones = std::nullopt;
  /// Pose of the wrist in the frame of the source, m, from a source that measures it. The axes are
  /// those of the source.
  std::optional<geometric::Pose> X_SH = std::nullopt;
  /// Numbers as the source sent them: see GloveInfo::raw.
  std::vector<double> raw = {};
};

/// The angles of one frame after calibration.
struct GloveAngles {
  double time = 0.0;  ///< s, as in the frame.
  std::array<double, kGloveSensors>
      angles{};  ///< rad, flexion positive; NaN where a sensor is missing.
};

/// One bend sensor of a glove.
struct GloveSensor {
  std::string_view name;   ///< Name used by its makers and the ROS drivers: "ThumbRotate".
  std::string_view label;  ///< Display name: "Thumb roll".
  char letter;             ///< Letter in the paper's Fig. 3: a to v.
  int slot;                ///< Place in the 24 angles of the VirtualHand order.
  /// Measured joint and positive direction: "Knuckle of the index finger, positive bent".
  std::string_view measures;
};

/// The 22 sensors of a CyberGlove, in the order of its records (paper, section 3 and Fig. 3;
/// the 18-sensor glove leaves out the four sensors of the distal finger joints).
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::span<const GloveSensor> cyberglove_sensors();

/// Index in cyberglove_sensors() of every sensor of a glove with that number of sensors, in the
/// order of its records.
/// @param sensors 18 or 22.
/// @throws std::invalid_argument for another number.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::span<const int> cyberglove_wired(int sensors);

/// Index of the sensor with that name, or with that one letter.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::optional<int> find_sensor(std::string_view name);

}  // namespace handway::device
