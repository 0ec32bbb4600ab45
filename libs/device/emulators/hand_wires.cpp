#include "emulators/hand_wires.h"

#include "glove/hand_json.h"
#include "glove/manus_ergonomics.h"
#include "glove/openxr_joints.h"
#include "glove/rokoko_frame.h"
#include "handway/device/glove/landmark_line.h"
#include "handway/geometric/math/pose.h"

#include <lz4frame.h>

#include <cstddef>
#include <stdexcept>

namespace handway::device {
namespace {

/// Pose of a hand with the axes of OpenXR: x to the right of a hand whose palm is down, y out of
/// its back, z from the fingers to the wrist.
geometric::Pose openxr_pose(const HandLandmarks& landmarks, bool left) {
  const geometric::Pose X_SP = palm_frame(landmarks);
  const double side = left ? -1.0 : 1.0;  // palm_frame() points out of the palm of a left hand
  Eigen::Matrix3d R;
  R.col(1) = side * X_SP.linear().col(2);
  R.col(2) = -X_SP.linear().col(0);
  R.col(0) = R.col(1).cross(R.col(2));
  geometric::Pose X = geometric::Pose::Identity();
  X.linear() = R;
  X.translation() = landmarks.col(kWristLandmark);
  return X;
}

/// All joints of OpenXR. The metacarpal bones begin at a quarter of the way to the knuckle.
std::array<Eigen::Vector3d, kOpenXrJoints> openxr_positions(const HandLandmarks& landmarks) {
  constexpr double kMetacarpalBase = 0.25;
  std::array<Eigen::Vector3d, kOpenXrJoints> positions;
  Eigen::Index landmark = 0;
  for (const int joint : openxr_joints_of_landmarks()) {
    positions.at(static_cast<std::size_t>(joint)) = landmarks.col(landmark++);
  }
  const Eigen::Vector3d wrist = landmarks.col(kWristLandmark);
  for (const Finger finger : {Finger::kIndex, Finger::kMiddle, Finger::kRing, Finger::kLittle}) {
    const Eigen::Vector3d knuckle = landmarks.col(base_landmark(finger));
    positions.at(static_cast<std::size_t>(openxr_metacarpal(finger))) =
        wrist + kMetacarpalBase * (knuckle - wrist);
  }
  positions.at(kOpenXrPalm) = 0.5 * (wrist + landmarks.col(base_landmark(Finger::kMiddle)));
  return positions;
}

std::string openxr_line(const EmulatedHand& hand) {
  HandJson object{{"time", hand.time}, {"hand", hand.left ? "left" : "right"}};
  HandJson& joints = object["joints"] = HandJson::array();
  if (hand.landmarks) {
    // All joints have the orientation of the hand, as only the wrist's is used.
    const Eigen::Quaterniond q(openxr_pose(*hand.landmarks, hand.left).linear());
    for (const Eigen::Vector3d& p : openxr_positions(*hand.landmarks)) {
      joints.push_back({p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()});
    }
  }
  return object.dump() + '\n';
}

HandJson rokoko_bone(const Eigen::Vector3d& p, const Eigen::Quaterniond& q) {
  return {{"position", {{"x", p.x()}, {"y", p.y()}, {"z", p.z()}}},
          {"rotation", {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}}}};
}

/// The bones of both hands; those of the hand without a glove are at the origin.
std::string rokoko_frame(const EmulatedHand& hand) {
  HandJson body;
  for (const bool left : {true, false}) {
    const bool measured = hand.landmarks && left == hand.left;
    const Eigen::Quaterniond q = measured ? mirrored_rotation(Eigen::Quaterniond(
                                                openxr_pose(*hand.landmarks, hand.left).linear()))
                                          : Eigen::Quaterniond::Identity();
    Eigen::Index landmark = 0;
    for (const std::string& bone : rokoko_bones()) {
      const Eigen::Vector3d p =
          measured ? mirrored_point(hand.landmarks->col(landmark)) : Eigen::Vector3d::Zero();
      body[(left ? "left" : "right") + bone] = rokoko_bone(p, q);
      ++landmark;
    }
  }
  const bool has_glove = hand.landmarks.has_value();
  const HandJson meta{{"hasGloves", has_glove},
                      {"hasLeftGlove", has_glove && hand.left},
                      {"hasRightGlove", has_glove && !hand.left},
                      {"hasBody", false},
                      {"hasFace", false}};
  HandJson actor{{"name", "Emulated"}, {"meta", meta}, {"body", body}};
  HandJson scene{{"timestamp", hand.time}};
  scene["actors"] = HandJson::array({actor});
  return HandJson{{"version", "3,0"}, {"fps", 30}, {"scene", scene}}.dump() + '\n';
}

std::string in_lz4_frame(const std::string& text) {
  std::string frame(LZ4F_compressFrameBound(text.size(), nullptr), '\0');
  const std::size_t size =
      LZ4F_compressFrame(frame.data(), frame.size(), text.data(), text.size(), nullptr);
  if (LZ4F_isError(size) != 0) {
    throw std::runtime_error("LZ4 could not compress a frame");
  }
  frame.resize(size);
  return frame;
}

/// A message of Manus Core's ROS 2 package, with the time, which that package does not have. A
/// glove that is not there has angles of zero.
std::string manus_line(const EmulatedHand& hand) {
  const ManusAngles degrees = hand.angles ? manus_angles_of_glove(*hand.angles) : ManusAngles{};
  HandJson message{{"glove_id", 1}, {"side", hand.left ? "Left" : "Right"}, {"time", hand.time}};
  HandJson& ergonomics = message["ergonomics"] = HandJson::array();
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    ergonomics.push_back(HandJson{{"type", manus_names().at(i)}, {"value", degrees.at(i)}});
  }
  return message.dump() + '\n';
}

}  // namespace

std::string encoded_hand(HandWire wire, const EmulatedHand& hand) {
  switch (wire) {
    case HandWire::kOpenXr:
      return openxr_line(hand);
    case HandWire::kRokoko:
      return rokoko_frame(hand);
    case HandWire::kRokokoLz4:
      return in_lz4_frame(rokoko_frame(hand));
    case HandWire::kManus:
      return manus_line(hand);
    case HandWire::kLandmarks:
      break;
  }
  return write_landmark_line({hand.time, hand.left, hand.landmarks}) + '\n';
}

}  // namespace handway::device
