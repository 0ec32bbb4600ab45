#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/math/pose.h"

#include <Eigen/Core>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace handway::device {

/// 21 points of a hand in the order of MediaPipe: the wrist; of the thumb the joint at the wrist
/// (CMC), the next two and the tip; of index, middle, ring and little finger the knuckle (MCP), the
/// next two and the tip. A column each, m.
using HandLandmarks = Eigen::Matrix<double, 3, 21>;

/// Index of a finger in HandLandmarks and in lists of fingers.
enum class Finger { kThumb, kIndex, kMiddle, kRing, kLittle };
/// "thumb", "index", "middle", "ring", "little".
[[nodiscard]] HANDWAY_DEVICE_EXPORT const std::string& name_of(Finger finger);

/// Index of the wrist's landmark.
inline constexpr int kWristLandmark = 0;
/// First landmark of a finger: the thumb's CMC joint, the others' knuckles.
[[nodiscard]] constexpr int base_landmark(Finger finger) {
  return 1 + 4 * static_cast<int>(finger);
}
/// Last landmark of a finger: its tip.
[[nodiscard]] constexpr int tip_landmark(Finger finger) { return base_landmark(finger) + 3; }

/// Length of an adult's hand from wrist to the tip of the middle finger, m.
inline constexpr double kTypicalHandLength = 0.19;

/// Typical bones of an adult's hand: shares by B. Buchholz, T. J. Armstrong, S. A. Goldstein,
/// "Anthropometric data for describing the kinematics of the human hand", Ergonomics 35(3), 1992.
[[nodiscard]] HANDWAY_DEVICE_EXPORT HandBones
typical_bones(double hand_length = kTypicalHandLength);
/// Returns the bones of one frame of landmarks, in any frame of reference.
[[nodiscard]] HANDWAY_DEVICE_EXPORT HandBones bones_of(const HandLandmarks& landmarks);
/// Median of each bone over several frames. @pre there is one.
[[nodiscard]] HANDWAY_DEVICE_EXPORT HandBones median_bones(std::span<const HandBones> frames);

/// Forward kinematics of a right hand from the angles of a glove, in the palm's frame: origin at
/// the wrist, x along the metacarpal of the middle finger, z out of the back of the hand, so that y
/// points to the thumb's side. Missing sensors (NaN) count as 0: fingers straight and side by side,
/// the thumb along the index finger. The wrist's sensors don't count. The direction from the wrist
/// to the base of a finger is the same for every hand.
[[nodiscard]] HANDWAY_DEVICE_EXPORT HandLandmarks
hand_landmarks(const GloveAngles& angles, const HandBones& bones = typical_bones());

/// The angles of a hand from its landmarks in the palm's frame, NaN where landmarks do not measure
/// them (the arch of the palm and the wrist): the inverse of hand_landmarks(), for any lengths. The
/// spread of a finger is 0 while its first phalanx is bent by some 80° and more.
[[nodiscard]] HANDWAY_DEVICE_EXPORT GloveAngles glove_angles(const HandLandmarks& landmarks);
/// The sensors for which glove_angles() has numbers.
[[nodiscard]] HANDWAY_DEVICE_EXPORT SensorIndices landmark_sensors();

/// Returns the palm's frame of landmarks in any frame, from wrist and knuckles: as that of
/// hand_landmarks(). For a left hand's landmarks z points into its palm.
/// @throws std::invalid_argument if wrist and knuckles lie in a line or are not finite.
[[nodiscard]] HANDWAY_DEVICE_EXPORT geometric::Pose palm_frame(const HandLandmarks& landmarks);

/// Landmarks as those of a right hand in its palm's frame. A left hand is mirrored.
/// @throws std::invalid_argument as palm_frame().
[[nodiscard]] HANDWAY_DEVICE_EXPORT HandLandmarks in_palm_frame(const HandLandmarks& landmarks,
                                                                bool left);

}  // namespace handway::device
