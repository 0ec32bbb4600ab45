#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/inverse_kinematics.h"

#include <memory>
#include <optional>
#include <string_view>

namespace handway::geometric {

/// Options of the analytic inverse kinematics of a TX90.
struct Tx90IkOptions {
  /// Leave out postures beyond the joint limits.
  bool respect_limits = true;
  /// List every posture that differs by full turns and is within the limits
  /// (TX90: joints 4 and 6 turn 1.5 times). Without it each joint takes the
  /// turn nearest to the reference.
  bool full_turn_alternates = false;
};

/// Closed-form inverse kinematics of the Staeubli TX90 and of arms built like
/// it, for any link fixed to the last axis. Lengths are read from the model.
///
/// All branches are found: two shoulders, two elbows, two wrists, so up to eight postures (R.
/// P. Paul, Robot Manipulators, 1981, chapter 3). If a pose leaves a joint free, the
/// reference decides. With axes 4 and 6 in line (within 1e-10 rad), joint 4 keeps its
/// reference and joint 6 does the rest, and there is one wrist branch. With the wrist centre
/// on axis 1, which is possible only for an arm without lateral offset, joint 1 keeps its
/// reference. Coinciding branches (arm stretched) appear once, as the first named in
/// ArmBranch.
class HANDWAY_GEOMETRIC_EXPORT SphericalWristInverseKinematics : public InverseKinematics {
 public:
  ~SphericalWristInverseKinematics() override;

  /// The branch of a configuration of the whole robot.
  /// @pre q has shape [model().variable_count()].
  [[nodiscard]] virtual ArmBranch branch_of(const Configuration& q) const = 0;

 protected:
  using InverseKinematics::InverseKinematics;
};

/// @throws InputError if the robot has no such link, or naming the reason why the chain has no
/// closed form: other than six joints, axes that are not perpendicular, parallel or concurrent
/// within 1e-6 rad or m.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::unique_ptr<SphericalWristInverseKinematics>
make_spherical_wrist_inverse_kinematics(std::shared_ptr<const RobotModel> model,
                                        std::string_view tip_link,
                                        const Tx90IkOptions& options = {});

}  // namespace handway::geometric
