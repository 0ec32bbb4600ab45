#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/human_hand.h"

#include <Eigen/Core>

/// Kinematics of MANO, the hand of many data sets and trackers: J. Romero, D. Tzionas, M. J. Black,
/// "Embodied Hands: Modeling and Capturing Hands and Bodies Together", ACM Transactions on Graphics
/// 36(6), 2017.
///
/// All joints have the axes of the model. In its rest posture the fingers of a right hand point
/// along -x, its thumb and the thumb's side of its palm to +z, the back of the hand to +y. Fingers
/// thus bend about +z. A left hand is the mirror image in the plane x = 0: its fingers point along
/// +x and bend about -z.

namespace handway::device {

/// Number of joints without the wrist.
inline constexpr int kManoJoints = 15;

/// A posture: a rotation vector (axis times angle, rad) for each joint in the model's order, which
/// is index, middle, little and ring finger, then thumb, of each from the palm outwards. Each joint
/// rotates all that follows, in the frame of the bone before it.
using ManoPose = Eigen::Matrix<double, 3, kManoJoints>;

/// Positions of the joints at rest: the wrist, then as in ManoPose, m.
using ManoJoints = Eigen::Matrix<double, 3, kManoJoints + 1>;

/// Returns a hand of usual size at rest. The directions of its bones are those of the model's mean
/// hand, to a degree; lengths are those of typical_bones().
[[nodiscard]] HANDWAY_DEVICE_EXPORT ManoJoints usual_mano_joints(bool left);

/// Returns the landmarks of a posture, with the wrist as at rest. MANO has no joints at the
/// fingertips: outer bones go on as the ones before them at rest, in the ratio of typical_bones().
[[nodiscard]] HANDWAY_DEVICE_EXPORT HandLandmarks mano_landmarks(const ManoPose& pose,
                                                                 const ManoJoints& rest);

}  // namespace handway::device
