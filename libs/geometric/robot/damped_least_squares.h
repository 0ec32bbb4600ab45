#pragma once

#include "handway/geometric/robot/numeric_inverse_kinematics.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace handway::geometric {

/// One descent of the numeric inverse kinematics, from a start to where the
/// pose error stops falling. Holds scratch memory: one per thread and call.
class DampedLeastSquares {
 public:
  DampedLeastSquares(const RobotModel& model, int tip_link, const std::vector<int>& variables,
                     const NumericIkOptions& options, const Pose& X_BT);

  /// How a configuration misses the target.
  struct Miss {
    Eigen::Matrix<double, 6, 1> error;  ///< m, weighted rotation in m; base frame.
    double position = 0.0;              ///< m
    double orientation = 0.0;           ///< rad; 0 if it does not count.
    double cost = 0.0;                  ///< Half the error's square, m².
  };

  /// Moves q downhill until it is within the tolerances, at a local minimum, out
  /// of iterations or `expired` says so.
  /// @param[in,out] q of the whole robot, the solved variables within limits.
  /// @param[in,out] iterations is counted up.
  [[nodiscard]] Miss descend(Configuration& q, int& iterations,
                             const std::function<bool()>& expired);

  [[nodiscard]] bool within_tolerance(const Miss& miss) const;

 private:
  [[nodiscard]] Miss miss(const Configuration& q);
  [[nodiscard]] Eigen::Matrix<double, 6, Eigen::Dynamic> error_jacobian() const;
  /// Marks the variables that are free to follow the gradient.
  void find_free(const Configuration& q, const Eigen::VectorXd& gradient);
  [[nodiscard]] Eigen::VectorXd step(const Eigen::MatrixXd& normal, const Eigen::VectorXd& gradient,
                                     double damping) const;

  const RobotModel& model_;
  int tip_link_;
  const std::vector<int>& variables_;
  const NumericIkOptions& options_;
  const Pose& X_BT_;
  std::vector<Pose> X_BL_;
  std::vector<Eigen::Index> free_;  ///< Places in variables_.
};

}  // namespace handway::geometric
