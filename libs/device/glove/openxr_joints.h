#pragma once

#include "handway/device/glove/human_hand.h"

#include <array>
#include <string>

/// The joints of OpenXR's extension XR_EXT_hand_tracking, in the order of XrHandJointEXT: palm,
/// wrist, four of the thumb (metacarpal, proximal, distal, tip) and five of each finger
/// (metacarpal, proximal, intermediate, distal, tip), from index to little finger.

namespace handway::device {

inline constexpr int kOpenXrJoints = 26;
inline constexpr int kOpenXrPalm = 0;
inline constexpr int kOpenXrWrist = 1;

/// Joint of each landmark of a hand. The palm and the metacarpal joints of the four fingers have
/// none: 21 landmarks go from the wrist to the knuckles at once.
[[nodiscard]] constexpr std::array<int, 21> openxr_joints_of_landmarks() {
  std::array<int, 21> joints{kOpenXrWrist, 2, 3, 4, 5};
  std::size_t landmark = 5;
  for (int finger = 1; finger < kFingers; ++finger) {
    for (int joint = 0; joint < 4; ++joint) {
      joints.at(landmark++) = 5 * finger + 2 + joint;
    }
  }
  return joints;
}

/// Names of the joints: "palm", "wrist", "thumb_metacarpal", ….
[[nodiscard]] const std::array<std::string, kOpenXrJoints>& openxr_names();

/// Joint at the base of a finger's metacarpal bone. @param finger not the thumb.
[[nodiscard]] constexpr int openxr_metacarpal(Finger finger) {
  return 5 * static_cast<int>(finger) + 1;
}

}  // namespace handway::device
