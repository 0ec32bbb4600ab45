#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/inverse_kinematics.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace handway::geometric {

struct NumericIkOptions {
  /// The frame T that is brought to the target, in the tip link's frame L.
  Pose X_LT = Pose::Identity();
  /// Leaves the orientation open; only T's origin counts.
  bool position_only = false;
  double position_tolerance = 1e-6;     ///< m
  double orientation_tolerance = 1e-6;  ///< rad
  /// How many metres one radian counts as when both are weighed, m/rad.
  double orientation_weight = 0.3;
  int max_iterations = 100;  ///< Of each start; ≥ 1.
  int max_restarts = 100;    ///< Random starts after the reference; ≥ 0.
  /// Wall clock over all starts. A finite limit makes failures depend on the
  /// machine's speed; without one the result has the same bits on every run.
  double time_limit_s = std::numeric_limits<double>::infinity();
  std::uint64_t seed = 1;  ///< Of the random starts.
};

/// The best posture found, whether it reaches the pose or not.
struct NumericIkResult {
  Configuration q;         ///< Of the whole robot, shape [variable_count], within limits.
  bool converged = false;  ///< Both residuals are within the tolerances.
  double position_residual = std::numeric_limits<double>::infinity();     ///< m
  double orientation_residual = std::numeric_limits<double>::infinity();  ///< rad
  int iterations = 0;                                                     ///< Over all starts.
  int restarts = 0;    ///< Random starts that were needed.
  std::string reason;  ///< Why not converged; empty otherwise.
};

/// Damped least squares for any chain: Levenberg-Marquardt steps on the pose
/// error, variables at a limit that would leave it being held (projection),
/// random restarts where a start ends in a local minimum.
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
  /// @throws InputError as solve().
  [[nodiscard]] NumericIkResult find(const Pose& X_BT, const Configuration& reference) const;

 private:
  [[nodiscard]] IkResult do_solve(const Pose& X_BT, const Configuration& reference) const override;

  NumericIkOptions options_;
};

}  // namespace handway::geometric
