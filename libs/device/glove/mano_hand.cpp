#include "handway/device/glove/mano_hand.h"

#include "handway/geometric/math/units.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>

namespace handway::device {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kBones = 3;  // of a finger, between its joints and from the wrist

/// Direction of a bone at rest, degrees.
struct Direction {
  double fan;     ///< From -x towards the thumb's side.
  double dorsal;  ///< Out of the plane of the palm, towards the back of the hand.
};

/// A finger in the model's order.
struct ManoFinger {
  Finger finger;
  std::array<Direction, kBones> bones;  ///< From the wrist on.
};

constexpr std::array<ManoFinger, kFingers> kManoFingers{{
    {Finger::kIndex, {{{13.0, -3.0}, {4.0, 7.0}, {0.0, -3.0}}}},
    {Finger::kMiddle, {{{-2.0, -1.0}, {-10.0, 3.0}, {-10.0, -3.0}}}},
    {Finger::kLittle, {{{-32.0, -7.0}, {-36.0, 0.0}, {-33.0, -2.0}}}},
    {Finger::kRing, {{{-18.0, -3.0}, {-10.0, 4.0}, {-18.0, -4.0}}}},
    {Finger::kThumb, {{{47.0, -24.0}, {50.0, 2.0}, {33.0, -12.0}}}},
}};

Vector3d unit(const Direction& direction, bool left) {
  const double fan = geometric::radians(direction.fan);
  const double dorsal = geometric::radians(direction.dorsal);
  return {(left ? 1.0 : -1.0) * std::cos(dorsal) * std::cos(fan), std::sin(dorsal),
          std::cos(dorsal) * std::sin(fan)};
}

Matrix3d rotation(const Vector3d& vector) {
  const double angle = vector.norm();
  return angle > 0.0 ? Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix()
                     : Matrix3d::Identity();
}

}  // namespace

ManoJoints usual_mano_joints(bool left) {
  const HandBones lengths = typical_bones();
  ManoJoints joints = ManoJoints::Zero();
  Eigen::Index joint = 1;
  for (const ManoFinger& finger : kManoFingers) {
    Vector3d point = Vector3d::Zero();
    for (std::size_t bone = 0; bone < kBones; ++bone) {
      point += lengths.at(static_cast<std::size_t>(finger.finger)).at(bone) *
               unit(finger.bones.at(bone), left);
      joints.col(joint++) = point;
    }
  }
  return joints;
}

HandLandmarks mano_landmarks(const ManoPose& pose, const ManoJoints& rest) {
  const HandBones typical = typical_bones();
  HandLandmarks landmarks;
  landmarks.col(kWristLandmark) = rest.col(0);
  Eigen::Index joint = 0;
  for (const ManoFinger& finger : kManoFingers) {
    Matrix3d R = Matrix3d::Identity();
    Vector3d point = rest.col(0);
    Vector3d before = rest.col(0);
    int landmark = base_landmark(finger.finger);
    for (int bone = 0; bone < kBones; ++bone, ++joint) {
      point += R * (rest.col(joint + 1) - before);
      before = rest.col(joint + 1);
      R = R * rotation(pose.col(joint));
      landmarks.col(landmark++) = point;
    }
    const auto& lengths = typical.at(static_cast<std::size_t>(finger.finger));
    landmarks.col(landmark) =
        point + R * (lengths[3] / lengths[2] * (rest.col(joint) - rest.col(joint - 1)));
  }
  return landmarks;
}

}  // namespace handway::device
