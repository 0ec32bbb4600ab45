#pragma once

#include "handway/device/export.h"
#include "handway/device/retargeting/fingertip_retargeter.h"

#include <cstdint>
#include <vector>

namespace handway::device {

/// Workspaces of corresponding fingertips of a human and of a robot's hand, m³.
struct HANDWAY_DEVICE_EXPORT FingertipOverlap {
  Finger finger = Finger::kThumb;
  double human = 0.0;  ///< Volume of the human one, scaled to the robot's finger.
  double robot = 0.0;
  double shared = 0.0;  ///< Volume of their intersection.

  /// Share of the human workspace that the robot's fingertip reaches, in [0, 1].
  [[nodiscard]] double coverage() const { return human > 0.0 ? shared / human : 0.0; }
  /// Share of the robot's workspace that the human one has, too, in [0, 1].
  [[nodiscard]] double human_share() const { return robot > 0.0 ? shared / robot : 0.0; }
};

/// Settings of workspace_overlap().
struct WorkspaceOverlapSettings {
  int postures = 40000;  ///< Number of random postures of each hand; ≥ 1.
  /// Edges of the voxels that are counted, as a share of a finger's length; > 0.
  double voxel = 0.08;
  std::uint64_t seed = 1;
};

/// Anthropomorphism of a hand's kinematics.
struct HANDWAY_DEVICE_EXPORT WorkspaceOverlap {
  std::vector<FingertipOverlap> fingers;  ///< The robot's, in the order of its fingers.

  /// Mean coverage of the five human fingers, in [0, 1]; 0 for those that the robot lacks.
  [[nodiscard]] double coverage() const;
};

/// Compares where the fingertips of a robot's hand can go with where those of a human hand can: how
/// anthropomorphic the hand is, whatever it does. 1 is human.
///
/// Both hands take random postures: the human one (of the settings' bones in `hand`) within
/// typical_angle_ranges(), outer joints bent 2/3 as far as middle ones, the robot's within its
/// limits. Palms are aligned as find_fingers() finds them. Each human finger is put on the base of
/// the robot's and scaled to its length. Workspaces are the voxels that fingertips come to.
/// Self-collision is ignored, and so is the palm's motion.
///
/// Source: in the manner of M. V. Liarokapis, P. K. Artemiadis, K. J. Kyriakopoulos, "Quantifying
/// anthropomorphism of robot hands", ICRA 2013, who compare workspaces of phalanges and of the
/// fingers' bases by convex hulls. Here only fingertips count, and voxels in place of hulls, as
/// workspaces are hollow.
/// @throws std::invalid_argument for settings out of range.
[[nodiscard]] HANDWAY_DEVICE_EXPORT WorkspaceOverlap
workspace_overlap(const FingertipRetargeter& hand, const WorkspaceOverlapSettings& settings = {});

}  // namespace handway::device
