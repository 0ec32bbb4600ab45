#include "glove/openxr_joints.h"

#include "glove/hand_json.h"
#include "handway/device/core/line_protocol.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace handway::device {
namespace {

constexpr std::uint64_t kPositionValid = 2;     // XR_SPACE_LOCATION_POSITION_VALID_BIT
constexpr std::uint64_t kOrientationValid = 1;  // XR_SPACE_LOCATION_ORIENTATION_VALID_BIT
constexpr std::size_t kPositionNumbers = 3;
constexpr std::size_t kPoseNumbers = 7;

/// A joint; parts that are not valid are missing.
struct OpenXrJoint {
  std::optional<Eigen::Vector3d> position;
  std::optional<Eigen::Vector4d> orientation;  ///< x, y, z, w
};

std::uint64_t flags_of(const HandJson& joint, const std::string& name) {
  const auto flags = joint.find("flags");
  if (flags == joint.end()) {
    return kPositionValid | kOrientationValid;
  }
  if (!flags->is_number_unsigned()) {
    throw LineProtocolError(fmt::format("flags of {} are no whole number", name));
  }
  return flags->get<std::uint64_t>();
}

OpenXrJoint joint_of_object(const HandJson& object, const std::string& name) {
  OpenXrJoint joint;
  const std::uint64_t flags = flags_of(object, name);
  if ((flags & kPositionValid) != 0) {
    joint.position = point_of_json(member_of(object, "position"), name);
  }
  if ((flags & kOrientationValid) != 0 && object.contains("orientation")) {
    joint.orientation = quaternion_of_json(object.at("orientation"), name);
  }
  return joint;
}

OpenXrJoint joint_of_json(const HandJson& value, int index) {
  const std::string name = fmt::format("joint {}", index);
  if (value.is_null()) {
    return {};
  }
  if (value.is_object()) {
    return joint_of_object(value, name);
  }
  if (!value.is_array() || (value.size() != kPositionNumbers && value.size() != kPoseNumbers)) {
    throw LineProtocolError(name + " is neither a point nor a pose of 7 numbers");
  }
  OpenXrJoint joint;
  const auto from = [&](std::size_t begin, std::size_t end) {
    HandJson part = HandJson::array();
    for (std::size_t i = begin; i < end; ++i) {
      part.push_back(value.at(i));
    }
    return part;
  };
  joint.position = point_of_json(from(0, kPositionNumbers), name);
  if (value.size() == kPoseNumbers) {
    joint.orientation = quaternion_of_json(from(kPositionNumbers, kPoseNumbers), name);
  }
  return joint;
}

std::optional<geometric::Pose> pose_of(const OpenXrJoint& joint) {
  if (!joint.position || !joint.orientation) {
    return std::nullopt;
  }
  geometric::Pose X = geometric::Pose::Identity();
  X.linear() = rotation_of(*joint.orientation, "the wrist").toRotationMatrix();
  X.translation() = *joint.position;
  return X;
}

/// Appends position and quaternion (x, y, z, w).
void append_raw(const OpenXrJoint& joint, std::vector<double>& raw) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector3d p = joint.position.value_or(Eigen::Vector3d::Constant(kNone));
  const Eigen::Vector4d q = joint.orientation.value_or(Eigen::Vector4d::Constant(kNone));
  raw.insert(raw.end(), p.begin(), p.end());
  raw.insert(raw.end(), q.begin(), q.end());
}

bool is_active(const HandJson& object) {
  const auto active = object.find("isActive");
  if (active != object.end() && !active->is_boolean() && !active->is_number_unsigned()) {
    throw LineProtocolError("isActive is neither true nor false");
  }
  return active == object.end() || *active == true || *active == 1U;
}

}  // namespace

const std::array<std::string, kOpenXrJoints>& openxr_names() {
  static const std::array<std::string, kOpenXrJoints> kNames = [] {
    std::array<std::string, kOpenXrJoints> names{
        "palm", "wrist", "thumb_metacarpal", "thumb_proximal", "thumb_distal", "thumb_tip"};
    std::size_t i = 6;
    for (const char* finger : {"index", "middle", "ring", "little"}) {
      for (const char* joint : {"metacarpal", "proximal", "intermediate", "distal", "tip"}) {
        names.at(i++) = fmt::format("{}_{}", finger, joint);
      }
    }
    return names;
  }();
  return kNames;
}

HandObservation read_openxr_hand(const HandJson& object) {
  HandObservation hand;
  hand.time = time_of_hand(object);
  if (const auto side = object.find("hand"); side != object.end()) {
    hand.left = is_left_hand(*side);
  }
  const HandJson& joints = member_of(object, "joints");
  if (joints.empty() || !is_active(object)) {
    return hand;
  }
  if (!joints.is_array() || joints.size() != static_cast<std::size_t>(kOpenXrJoints)) {
    throw LineProtocolError(
        fmt::format("{} joints of a hand, expected {}", joints.size(), kOpenXrJoints));
  }
  std::array<OpenXrJoint, kOpenXrJoints> read;
  for (std::size_t i = 0; i < read.size(); ++i) {
    read.at(i) = joint_of_json(joints.at(i), static_cast<int>(i));
  }
  HandLandmarks landmarks;
  Eigen::Index landmark = 0;
  for (const int index : openxr_joints_of_landmarks()) {
    const OpenXrJoint& joint = read.at(static_cast<std::size_t>(index));
    if (!joint.position) {
      return hand;
    }
    landmarks.col(landmark++) = *joint.position;
  }
  check_hand(landmarks);
  hand.landmarks = landmarks;
  hand.X_SH = pose_of(read.at(kOpenXrWrist));
  for (const OpenXrJoint& joint : read) {
    append_raw(joint, hand.raw);
  }
  return hand;
}

}  // namespace handway::device
