#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/inverse_kinematics.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace handway::geometric {

/// Options of numeric inverse kinematics.
struct NumericIkOptions {
  /// The frame T to bring to the target, in the tip link's frame L.
  Pose X_LT = Pose::Identity();
  /// Leaves the orientation open; only T's origin counts.
  bool position_only = false;
  /// Allowed distance of T from the target along each of the target's axes, m: errors within count
  /// as none. Each ≥ 0.
  Eigen::Vector3d position_slack = Eigen::Vector3d::Zero();
  /// Allowed size of each component of the rotation vector from the target to T, rad; π: that axis
  /// is free. Each ≥ 0.
  Eigen::Vector3d rotation_slack = Eigen::Vector3d::Zero();
  double position_tolerance = 1e-6;     ///< m, beyond the slack
  double orientation_tolerance = 1e-6;  ///< rad, beyond the slack
  /// Weight of orientation errors against position errors, m/rad.
  double orientation_weight = 0.3;
  int max_iterations = 100;  ///< Limit of each start; ≥ 1.
  int max_restarts = 100;    ///< Random starts after the reference; ≥ 0.
  /// Wall clock over all starts. A finite limit makes failures depend on the machine's speed;
  /// without one the result is bitwise the same on every run.
  double time_limit_s = std::numeric_limits<double>::infinity();
  std::uint64_t seed = 1;  ///< Seed of the random starts.
  /// Moves a solution in the chain's null space, and within the slack, nearer to the reference.
  /// Without it a redundant arm stays in the arbitrary posture that the iterations reach.
  bool stay_near = false;
};

/// Predicate on a configuration of the whole robot, shape [variable_count]: true if acceptable, for
/// example free of collision.
using ConfigurationPredicate = std::function<bool(const Configuration&)>;

/// The best posture found, whether it reaches the pose or not.
struct NumericIkResult {
  Configuration q;         ///< Whole robot's values, shape [variable_count], within limits.
  bool converged = false;  ///< Both residuals are within the tolerances.
  double position_residual = std::numeric_limits<double>::infinity();     ///< m, beyond the slack
  double orientation_residual = std::numeric_limits<double>::infinity();  ///< rad, the same
  int iterations = 0;                                                     ///< Over all starts.
  int restarts = 0;    ///< Random starts that were needed.
  int refused = 0;     ///< Postures that reached the pose and did not pass the predicate.
  std::string reason;  ///< Reason of a failure; empty on success.
};

/// Damped least squares for any chain: Levenberg-Marquardt steps on the pose error, holding
/// variables at a limit that they would leave (projection), with random restarts after a local
/// minimum or a refused posture.
///
/// Source: C. W. Wampler, "Manipulator inverse kinematic solutions based on
/// vector formulations and damped least-squares methods", IEEE Trans. SMC 16(1),
/// 1986; D. W. Marquardt's rule for the damping, 1963.
class HANDWAY_GEOMETRIC_EXPORT NumericInverseKinematics : public InverseKinematics {
 public:
  /// @param joints the joints to solve for, by name; empty for all that move the tip.
  /// @throws InputError if a link or joint is unknown, a joint doesn't move the
  /// tip, or an option is out of its range.
  NumericInverseKinematics(const std::shared_ptr<const RobotModel>& model,
                           std::string_view tip_link, const std::vector<std::string>& joints = {},
                           const NumericIkOptions& options = {});

  [[nodiscard]] const NumericIkOptions& options() const { return options_; }

  /// @param X_BT where T shall be, in the robot's base frame.
  /// @param reference the first start and the other variables' values.
  /// @param accept predicate that ends the starts with a posture that reaches the pose; or empty.
  /// @returns the first that does, or else the best posture: `converged` if it reaches the pose.
  /// @throws InputError as solve().
  [[nodiscard]] NumericIkResult find(const Pose& X_BT, const Configuration& reference,
                                     const ConfigurationPredicate& accept = {}) const;

  /// Several postures that reach the pose, from all starts.
  /// @param most stops when there are that many; ≥ 1.
  /// @param accept as in find().
  /// @returns whole configurations, the nearest to the reference first; of postures that differ by
  /// less than 0.1 rad (or m), but for whole turns, the nearest.
  /// @throws InputError as solve().
  [[nodiscard]] std::vector<Configuration> find_several(
      const Pose& X_BT, const Configuration& reference, int most,
      const ConfigurationPredicate& accept = {}) const;

 private:
  /// Calls `take` with the outcome of each start, the reference first, until it returns true, or
  /// until starts or time are spent. @returns whether the time was.
  bool search(const Pose& X_BT, const Configuration& reference,
              const std::function<bool(const NumericIkResult&)>& take) const;
  [[nodiscard]] IkResult do_solve(const Pose& X_BT, const Configuration& reference) const override;

  NumericIkOptions options_;
  JointIndices turning_;  ///< Variables that may move by whole turns.
};

}  // namespace handway::geometric
