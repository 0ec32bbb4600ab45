#pragma once

#include "handway/geometric/math/pose.h"

#include <array>
#include <string>

/// Frames of Rokoko Studio's custom stream, JSON of version 3 and 4, as its plugin for Unity
/// (Rokoko/rokoko-studio-live-unity, JsonLiveSerializerV3.cs) reads them:
///
///     {"version": "3,0", "fps": 30, "scene": {"timestamp": s, "actors": [{"name": …,
///      "meta": {"hasLeftGlove": true, …}, "body": {"leftHand": {"position": {"x", "y", "z"},
///      "rotation": {"x", "y", "z", "w"}}, "leftIndexProximal": …}}]}}
///
/// Positions (m) and rotations are in the world of Unity, whose frame is left-handed: x to the
/// right, y up, z forward.

namespace handway::device {

/// Bones of a hand in the order of its landmarks, without their side: "Hand", "ThumbProximal", ….
[[nodiscard]] const std::array<std::string, 21>& rokoko_bones();

/// Returns a point of Unity's left-handed frame in the right-handed frame whose x axis is reversed,
/// and vice versa.
[[nodiscard]] inline Eigen::Vector3d mirrored_point(const Eigen::Vector3d& p) {
  return {-p.x(), p.y(), p.z()};
}
/// Returns a rotation of Unity's left-handed frame in that right-handed frame, and vice versa.
[[nodiscard]] inline Eigen::Quaterniond mirrored_rotation(const Eigen::Quaterniond& q) {
  return {q.w(), q.x(), -q.y(), -q.z()};
}

}  // namespace handway::device
