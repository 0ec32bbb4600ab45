#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/human_hand.h"
#include "handway/geometric/robot/robot_model.h"

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

namespace handway::device {

/// One finger of a robot's hand.
struct RobotFinger {
  Finger finger = Finger::kThumb;  ///< The corresponding human finger.
  int tip_link = -1;
  Eigen::Vector3d p_LT = Eigen::Vector3d::Zero();  ///< The fingertip in its link's frame, m.
  geometric::JointIndices variables;  ///< Moving joints from the palm to the tip, as variables.
  /// Values of the variables that align the phalanges with each other and the palm, rad: shape
  /// [variables].
  std::vector<double> straight;
  /// Flexion of the finger by a variable, rad per unit: negative if falling values close the
  /// finger, 0 if it does not bend it. Shape [variables].
  std::vector<double> flexion;
  /// Origin of its own first joint, in the palm's frame, m. For a finger that begins at a moving
  /// part of the palm, or follows another finger, it is the first joint beyond that part.
  Eigen::Vector3d p_PB = Eigen::Vector3d::Zero();
  double reach = 0.0;  ///< From there to the tip of the straight finger, m.
};

/// Structure of a robot hand, as far as retargeting needs it.
struct RobotFingers {
  int palm = 0;  ///< The link that all fingers start from.
  std::vector<RobotFinger> fingers;
  /// From the palm's frame of a right human hand (see hand_landmarks()) to that of the palm link.
  Eigen::Matrix3d R_PH = Eigen::Matrix3d::Identity();
  /// True for a left hand: a person's is mirrored for it.
  bool left = false;
  /// Doubts that the geometry leaves, as sentences: the side to which fingers close.
  std::vector<std::string> doubts;
};

/// Finds palm, fingers and fingertips from the kinematic tree alone: the fingertips are those of
/// geometric::propose_groups(), the palm is the last link that the chains to them have in common. A
/// fingertip is the frame of a link that is fixed to the last moving one, else the point of the
/// last link's shape that is farthest from its joint. Fingers are identified by names where these
/// are clear ("thumb", "th", "index", "ff", …), else by the fingers' bases: the thumb is beside the
/// line of the others, which are numbered from it. The orientation of the palm follows from the
/// directions of straight fingers and the sides to which they close: the side of the larger joint
/// ranges, and the side nearer to the thumb's workspace. Joints whose limits leave no room count as
/// fixed.
/// @param tips links of fingertips by finger, in place of the search's result.
/// @throws InputError for fewer than two fingers, or if `tips` has a link of no finger.
[[nodiscard]] HANDWAY_DEVICE_EXPORT RobotFingers
find_fingers(const geometric::RobotModel& model, const std::map<Finger, std::string>& tips = {});

}  // namespace handway::device
