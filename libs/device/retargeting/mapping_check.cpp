#include "handway/device/retargeting/mapping_check.h"

#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/retargeting/robot_fingers.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/composed_robot.h"
#include "retargeting/finger_bend.h"

#include <Eigen/Core>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace handway::device {
namespace {

using Eigen::Vector3d;
using geometric::Configuration;
using geometric::kDegree;
using geometric::RobotModel;

constexpr int kFistSteps = 10;             // from flat to fist
constexpr double kStraight = 0.8;          // share of a finger's reach: less is bent
constexpr double kBends = 0.15;            // share of a finger's reach, towards the palm
constexpr double kBeyond = 2.0 * kDegree;  // beyond limits
constexpr double kMostClamped = 0.5;       // share of a motion, or of samples

/// A hand closed by a share.
GloveAngles closed_by(double share) {
  GloveAngles angles;
  angles.angles.fill(0.0);
  const auto set = [&](const std::string& sensor, double degrees) {
    angles.angles.at(static_cast<std::size_t>(find_sensor(sensor).value())) =
        share * degrees * kDegree;
  };
  for (const std::string finger : {"Index", "Middle", "Ring", "Pinkie"}) {
    set(finger + "MPJ", 70.0);
    set(finger + "PIJ", 90.0);
    set(finger + "DIJ", 50.0);
  }
  return angles;
}

/// A robot's hand in a posture of a mapping.
class PlayedHand {
 public:
  PlayedHand(const HandMapping& mapping, const RobotModel& model)
      : hand_(find_fingers(model)), palm_(model, hand_.palm), mapper_(mapping, model), q_(rest()) {
    for (const std::string& joint : mapper_.joints()) {
      variables_.push_back(geometric::find_variable_of_part(model, joint).value());
      beyond_.push_back(0);
    }
  }

  [[nodiscard]] const RobotFingers& hand() const { return hand_; }
  [[nodiscard]] int pose_count() const { return poses_; }

  void pose(const GloveAngles& angles) {
    ++poses_;
    const Eigen::VectorXd wanted = mapper_.unclamped(angles);
    for (std::size_t j = 0; j < variables_.size(); ++j) {
      const auto i = static_cast<Eigen::Index>(j);
      q_[variables_[j]] = std::clamp(wanted[i], mapper_.lower()[i], mapper_.upper()[i]);
      beyond_[j] +=
          wanted[i] < mapper_.lower()[i] - kBeyond || wanted[i] > mapper_.upper()[i] + kBeyond ? 1
                                                                                               : 0;
    }
  }

  /// Vector from the finger's base in the frame of a right hand's palm, in lengths of the finger.
  [[nodiscard]] Vector3d tip(const RobotFinger& finger) {
    const Vector3d p_H =
        hand_.R_PH.transpose() * (palm_.tip(finger, q_) - finger.p_PB) / finger.reach;
    return hand_.left ? Vector3d(p_H.x(), p_H.y(), -p_H.z()) : p_H;
  }

  /// Joints that were beyond their limits for most of the poses.
  [[nodiscard]] std::vector<std::string> clamped() const {
    std::vector<std::string> joints;
    for (std::size_t j = 0; j < beyond_.size(); ++j) {
      if (beyond_[j] > kMostClamped * poses_) {
        joints.push_back(mapper_.joints()[j]);
      }
    }
    return joints;
  }

 private:
  [[nodiscard]] Configuration rest() const {
    Configuration q = palm_.model().neutral();
    for (const RobotFinger& finger : hand_.fingers) {
      for (std::size_t k = 0; k < finger.variables.size(); ++k) {
        q[finger.variables[k]] = finger.straight[k];
      }
    }
    return q;
  }

  RobotFingers hand_;
  PalmKinematics palm_;
  HandMapper mapper_;
  Configuration q_;
  std::vector<int> variables_;
  std::vector<int> beyond_;
  int poses_ = 0;
};

}  // namespace

std::vector<std::string> mapping_doubts(const HandMapping& mapping, const RobotModel& model) {
  PlayedHand played(mapping, model);
  std::vector<std::string> doubts = played.hand().doubts;
  std::vector<Vector3d> open;
  std::vector<Vector3d> closed;
  for (int step = 0; step <= kFistSteps; ++step) {
    played.pose(closed_by(static_cast<double>(step) / kFistSteps));
    closed.clear();
    for (const RobotFinger& finger : played.hand().fingers) {
      closed.push_back(played.tip(finger));
    }
    open = step == 0 ? closed : open;
  }
  for (std::size_t f = 0; f < open.size(); ++f) {
    const RobotFinger& finger = played.hand().fingers[f];
    const bool bends = std::ranges::any_of(finger.flexion, [](double rate) { return rate != 0.0; });
    if (finger.finger == Finger::kThumb || !bends) {
      continue;
    }
    const std::string& name = name_of(finger.finger);
    if (open[f].x() < kStraight) {
      doubts.push_back(fmt::format("The {} finger is not straight when the hand is open.", name));
    }
    if (closed[f].z() > open[f].z() - kBends && closed[f].x() > 0.0) {
      doubts.push_back(
          fmt::format("The {} finger does not bend to the palm when the hand closes.", name));
    }
  }
  if (const std::vector<std::string> clamped = played.clamped(); !clamped.empty()) {
    doubts.push_back(fmt::format("Beyond {} limits for most of the motion from flat to fist: {}.",
                                 clamped.size() == 1 ? "its" : "their", fmt::join(clamped, ", ")));
  }
  return doubts;
}

std::string clamping_warning(const MappedPostures& mapped) {
  constexpr double kAtLimit = 1e-6;  // rad or m: no more than rounding
  const Eigen::Index samples = mapped.postures.rows();
  Eigen::Index most = 0;
  std::string worst;
  for (std::size_t j = 0; j < mapped.clamped.size(); ++j) {
    if (mapped.clamped[j] > most) {
      most = mapped.clamped[j];
      worst = mapped.joints[j];
    }
  }
  Eigen::Index any = 0;
  for (Eigen::Index row = 0; row < std::min(samples, mapped.unclamped.rows()); ++row) {
    const double beyond =
        (mapped.unclamped.row(row) - mapped.postures.row(row)).cwiseAbs().maxCoeff();
    any += beyond > kAtLimit ? 1 : 0;
  }
  if (static_cast<double>(std::max(any, most)) <= kMostClamped * static_cast<double>(samples)) {
    return "";
  }
  return fmt::format(
      "{:.0f} % of the samples are beyond limits of joints, most of all of {} ({:.0f} %): the hand "
      "does not do what the person did. Look at the mapping's signs and offsets, or fit it to a "
      "recording (handway glove map --fit).",
      100.0 * static_cast<double>(std::max(any, most)) / static_cast<double>(samples), worst,
      100.0 * static_cast<double>(most) / static_cast<double>(samples));
}

}  // namespace handway::device
