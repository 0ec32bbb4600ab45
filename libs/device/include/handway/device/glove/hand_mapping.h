#pragma once

#include "handway/device/export.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// Mapping from a glove's sensors to the joints of a robot hand (paper, section 4.1 and Table 1),
/// as YAML:
///
///     hand: sah_right               # in the library, or a file as seen from this one
///     source: "where the correspondence comes from"
///     joints:
///       - {joint: thumb_base, sensor: ThumbRotate, gain: -1, offset: 0}
///       - {joint: index_medial, sensor: h, curve: [[0, -0.07], [0.8, -0.9], [1.7, -1.3]]}
///       - {joint: middle_abduction, fixed: middle}
///       - {joint: WRJ1, arm: true}

namespace handway::device {

/// One point of a curve, rad.
struct CurvePoint {
  double angle;  ///< Angle of the sensor.
  double joint;
};

/// Mapping from a glove sensor, or a fixed value, to one joint of the hand.
struct JointMapping {
  std::string joint;
  int sensor = -1;      ///< Index into cyberglove_sensors(); -1: the joint is fixed.
  double gain = 1.0;    ///< joint = gain · angle + offset, without a curve.
  double offset = 0.0;  ///< rad
  /// Replaces gain and offset: linear between points of rising angle, constant beyond both ends.
  std::vector<CurvePoint> curve;
  std::optional<double> fixed;  ///< rad, of a joint without sensor; none: middle of its range.
  /// True for a joint of the arm, such as a wrist's: the hand does not move it.
  bool left_to_arm = false;
};

/// The joint mappings of a whole hand.
struct HandMapping {
  std::string hand;    ///< Robot that the joints belong to, a file as seen from the mapping's.
  std::string source;  ///< May be empty.
  std::vector<JointMapping> joints;
};

/// The paper's Table 1 for the SAH hand (`sah_right`): 13 joints by 11 of the 22 sensors.
/// Thumb roll drives both joints of the thumb's base over their whole ranges; the middle
/// finger's base stays in the middle; relative abductions (positive when the fingers spread)
/// drive index and ring finger away from it; distal joints, little finger, palm and wrist are
/// ignored. Fingers of the hand bend in the negative direction.
/// Ships as resources/mappings/table1_sah.yaml.
[[nodiscard]] HANDWAY_DEVICE_EXPORT HandMapping table1_mapping();

/// @throws geometric::InputError with file, line and key for an invalid mapping: an unknown sensor,
/// a joint twice, both or neither of sensor and fixed, a curve of fewer than two points or whose
/// angles don't rise.
[[nodiscard]] HANDWAY_DEVICE_EXPORT HandMapping read_mapping(const std::filesystem::path& file);

/// Replaces the file whole; the same mapping gives the same bytes.
/// @throws geometric::InputError if the file can't be written.
HANDWAY_DEVICE_EXPORT void write_mapping(const HandMapping& mapping,
                                         const std::filesystem::path& file);

}  // namespace handway::device
