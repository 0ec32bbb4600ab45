#include "handway/device/retargeting/workspace_overlap.h"

#include "core/random_moves.h"
#include "handway/device/glove/angle_ranges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

namespace handway::device {
namespace {

using Voxel = std::array<int, 3>;
using Voxels = std::vector<Voxel>;  ///< Sorted, each once.

constexpr double kCoupling = 2.0 / 3.0;  // Rijpkema and Girard 1991

/// Collects the voxels of one fingertip.
class VoxelSet {
 public:
  explicit VoxelSet(double edge) : edge_(edge) {}

  void add(const Eigen::Vector3d& point) {
    const Eigen::Vector3d place = point / edge_;
    voxels_.push_back({static_cast<int>(std::floor(place.x())),
                       static_cast<int>(std::floor(place.y())),
                       static_cast<int>(std::floor(place.z()))});
  }

  [[nodiscard]] Voxels take() {
    std::ranges::sort(voxels_);
    voxels_.erase(std::unique(voxels_.begin(), voxels_.end()), voxels_.end());
    return std::move(voxels_);
  }

 private:
  double edge_;
  Voxels voxels_;
};

GloveAngles human_posture(SeededRandom& draws) {
  GloveAngles posture;
  const AngleRanges& ranges = typical_angle_ranges();
  for (std::size_t sensor = 0; sensor < ranges.size(); ++sensor) {
    posture.angles[sensor] = draws.uniform(ranges[sensor].first, ranges[sensor].second);
  }
  const auto angle = [&](const std::string& sensor) -> double& {
    return posture.angles[static_cast<std::size_t>(find_sensor(sensor).value())];
  };
  for (const char* finger : {"Index", "Middle", "Ring", "Pinkie"}) {
    angle(std::string(finger) + "DIJ") = kCoupling * angle(std::string(finger) + "PIJ");
  }
  angle("PalmArch") = 0.0;
  return posture;
}

Eigen::VectorXd robot_posture(const FingertipRetargeter& hand, SeededRandom& draws) {
  Eigen::VectorXd posture(hand.lower().size());
  for (Eigen::Index joint = 0; joint < posture.size(); ++joint) {
    posture[joint] = draws.uniform(hand.lower()[joint], hand.upper()[joint]);
  }
  return posture;
}

// Returns the vector from the base of a human finger to its tip.
Eigen::Vector3d tip_from_base(const HandLandmarks& landmarks, Finger finger) {
  return landmarks.col(tip_landmark(finger)) - landmarks.col(base_landmark(finger));
}

/// Human fingertips as those of the robot's fingers: from the base of each, in its length.
class HumanTips {
 public:
  explicit HumanTips(const FingertipRetargeter& hand) : hand_(hand) {
    GloveAngles flat;
    flat.angles.fill(0.0);
    const HandLandmarks landmarks = hand.landmarks(flat);
    for (const RobotFinger& finger : hand.fingers().fingers) {
      scales_.push_back(finger.reach / tip_from_base(landmarks, finger.finger).norm());
    }
  }

  // A column for each finger, in the frame of the robot's palm.
  [[nodiscard]] Eigen::Matrix3Xd at(const GloveAngles& posture) const {
    const RobotFingers& robot = hand_.fingers();
    const HandLandmarks landmarks = hand_.landmarks(posture);
    Eigen::Matrix3Xd tips(3, static_cast<Eigen::Index>(scales_.size()));
    for (std::size_t i = 0; i < scales_.size(); ++i) {
      Eigen::Vector3d v_H = tip_from_base(landmarks, robot.fingers[i].finger);
      v_H.z() = robot.left ? -v_H.z() : v_H.z();
      tips.col(static_cast<Eigen::Index>(i)) =
          robot.fingers[i].p_PB + scales_[i] * (robot.R_PH * v_H);
    }
    return tips;
  }

 private:
  const FingertipRetargeter& hand_;
  std::vector<double> scales_;  ///< From a human finger to the robot's.
};

// Adds the tips of all fingers, a column each, to the fingers' sets.
void add_tips(const Eigen::Matrix3Xd& tips, std::vector<VoxelSet>& sets) {
  for (std::size_t finger = 0; finger < sets.size(); ++finger) {
    sets[finger].add(tips.col(static_cast<Eigen::Index>(finger)));
  }
}

}  // namespace

double WorkspaceOverlap::coverage() const {
  double sum = 0.0;
  for (const FingertipOverlap& finger : fingers) {
    sum += finger.coverage();
  }
  return sum / kFingers;
}

WorkspaceOverlap workspace_overlap(const FingertipRetargeter& hand,
                                   const WorkspaceOverlapSettings& settings) {
  if (settings.postures < 1 || !(settings.voxel > 0.0)) {
    throw std::invalid_argument("workspaces need at least one posture and voxels above 0");
  }
  std::vector<VoxelSet> human_sets;
  for (const RobotFinger& finger : hand.fingers().fingers) {
    human_sets.emplace_back(settings.voxel * finger.reach);
  }
  std::vector<VoxelSet> robot_sets = human_sets;
  const HumanTips human_tips(hand);
  SeededRandom draws(settings.seed);
  for (int i = 0; i < settings.postures; ++i) {
    add_tips(human_tips.at(human_posture(draws)), human_sets);
    add_tips(hand.fingertips(robot_posture(hand, draws)), robot_sets);
  }
  WorkspaceOverlap overlap;
  for (std::size_t i = 0; i < human_sets.size(); ++i) {
    const RobotFinger& finger = hand.fingers().fingers[i];
    const double volume = std::pow(settings.voxel * finger.reach, 3);
    const Voxels human = human_sets[i].take();
    const Voxels robot = robot_sets[i].take();
    Voxels shared;
    std::ranges::set_intersection(human, robot, std::back_inserter(shared));
    overlap.fingers.push_back({finger.finger, volume * static_cast<double>(human.size()),
                               volume * static_cast<double>(robot.size()),
                               volume * static_cast<double>(shared.size())});
  }
  return overlap;
}

}  // namespace handway::device
