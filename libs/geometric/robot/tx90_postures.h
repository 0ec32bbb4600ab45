#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/robot/arm_branch.h"
#include "robot/tx90_geometry.h"

#include <array>
#include <string>

namespace handway::geometric {

/// Values of the arm's six joints from the base on, rad.
using Tx90Joints = std::array<double, 6>;

/// One posture that reaches a pose. Joints are up to full turns and without
/// regard to limits.
struct Tx90Posture {
  Tx90Joints q;
  ArmBranch branch;
};

struct Tx90Postures {
  std::array<Tx90Posture, 8> list;  ///< The first `count` are filled.
  int count = 0;
  std::string reason;  ///< Why there is none.
};

/// All postures that bring the tip to X_BT (in the base frame).
/// @param reference keeps the joints that the pose leaves free.
[[nodiscard]] Tx90Postures tx90_postures(const Tx90Geometry& geometry, const Pose& X_BT,
                                         const Tx90Joints& reference);

[[nodiscard]] ArmBranch tx90_branch(const Tx90Geometry& geometry, const Tx90Joints& q);

}  // namespace handway::geometric
