#pragma once

namespace handway::planning {

/// In which space the arm's sampling region lies along the straight motion.
enum class CorridorForm {
  kJoint,      ///< Arm joints, as printed (paper, section 5.1): sampling::ArmCorridor.
  kCartesian,  ///< Poses of the arm's tool: sampling::CartesianCorridor.
};

}  // namespace handway::planning
