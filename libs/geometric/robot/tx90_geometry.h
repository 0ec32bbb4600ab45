#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/robot/robot_model.h"

#include <Eigen/Core>

#include <array>

namespace handway::geometric {

/// The lengths and directions of an arm built like the TX90, from its joint
/// axes with all joints at 0, however its file places the link frames:
/// axis 2 square to axis 1, axis 3 parallel to axis 2, axes 4, 5 and 6 meeting
/// in the wrist centre W, axis 5 square to axes 4 and 6.
///
/// Frame C has its origin on axis 1 at the height of axis 2, z along axis 1 and
/// y along axis 2. In it the arm moves in a plane y = const, turned about z.
struct Tx90Geometry {
  Pose X_BC = Pose::Identity();
  double shoulder_offset = 0.0;  ///< x of axis 2 in C, m (TX90: 0.05).
  double lateral_offset = 0.0;   ///< y of the wrist centre in C, m (TX90: 0.05).
  double upper_arm = 0.0;        ///< From axis 2 to axis 3, m (TX90: 0.425).
  double forearm = 0.0;          ///< From axis 3 to the wrist centre, m (TX90: 0.425).
  double upper_arm_angle = 0.0;  ///< Angle about y from z to the upper arm at zero, rad.
  double bend = 0.0;             ///< Angle about y from the upper arm to the forearm at zero.
  double elbow_sign = 1.0;       ///< -1 if axis 3 points against axis 2.
  /// Wrist frame at zero: z along axis 4, y along axis 5.
  Eigen::Matrix3d R_CF = Eigen::Matrix3d::Identity();
  double wrist_bend = 0.0;  ///< Angle about axis 5 from axis 4 to axis 6 at zero, rad.
  Eigen::Matrix3d R_CT = Eigen::Matrix3d::Identity();  ///< The tip's rotation at zero.
  Eigen::Vector3d p_TW = Eigen::Vector3d::Zero();      ///< The wrist centre in the tip's frame.
};

/// The six joints between root and tip, from the base on.
struct Tx90Chain {
  std::array<int, 6> links;      ///< The link that each joint carries.
  std::array<int, 6> variables;  ///< The model's variable of each joint.
};

/// @throws InputError if there are not exactly six revolute joints on the way
/// from the root to `tip_link`, all of them moving on their own.
[[nodiscard]] Tx90Chain tx90_chain(const RobotModel& model, int tip_link);

/// @throws InputError naming the joint that does not fit the structure above.
[[nodiscard]] Tx90Geometry tx90_geometry(const RobotModel& model, const Tx90Chain& chain,
                                         int tip_link);

}  // namespace handway::geometric
