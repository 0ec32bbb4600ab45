#pragma once

#include "handway/device/glove/glove_layout.h"

#include <array>
#include <string>

/// Ergonomics of Manus Core: 20 angles of a hand in degrees, as its SDK names them and its ROS 2
/// package (message ManusGlove) publishes them. "Stretch" is flexion, positive bent. "Spread" of a
/// finger is taken as positive towards the thumb, that of the thumb as positive away from the palm.

namespace handway::device {

inline constexpr int kManusAngles = 20;

/// Angles by the order of manus_names(), deg.
using ManusAngles = std::array<double, kManusAngles>;

/// Names of the angles, four of each finger from the thumb on: "ThumbMCPSpread",
/// "ThumbMCPStretch", "ThumbPIPStretch", "ThumbDIPStretch", "IndexSpread", ….
[[nodiscard]] const std::array<std::string, kManusAngles>& manus_names();

/// Angles of a glove's sensors, rad; NaN for the arch of the palm and the wrist. The thumb's
/// abduction is its spread, its roll the stretch of its first joint.
[[nodiscard]] std::array<double, kGloveSensors> glove_angles_of_manus(const ManusAngles& degrees);
/// Inverse of glove_angles_of_manus() for a middle finger that is not spread.
[[nodiscard]] ManusAngles manus_angles_of_glove(const std::array<double, kGloveSensors>& angles);

}  // namespace handway::device
