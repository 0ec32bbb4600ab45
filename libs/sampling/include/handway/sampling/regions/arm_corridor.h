#pragma once

#include "handway/sampling/export.h"

#include <Eigen/Core>

namespace handway::sampling {

/// The region that arm configurations are drawn from: hypercubes B^a(p) of side
/// 2ρ_a around points p of the segment from start to goal (paper, section 5.1,
/// Fig. 12). All in arm joints normalised to [0, 1].
class HANDWAY_SAMPLING_EXPORT ArmCorridor {
 public:
  /// @pre both have the same size.
  ArmCorridor(Eigen::VectorXd start, Eigen::VectorXd goal);

  [[nodiscard]] int dimension() const { return static_cast<int>(start_.size()); }
  [[nodiscard]] double length() const { return (goal_ - start_).norm(); }

  /// Algorithm 1's draw: start + step (goal - start) + ρ_a (2u - 1), which may be beyond limits.
  /// @param step in [0, 1]. @param u in [0,1]^dimension. @param rho half-side, ≥ 0.
  [[nodiscard]] Eigen::VectorXd sample(double step, double rho, const Eigen::VectorXd& u) const;

  /// corridor_steps() of length() and `rho`.
  [[nodiscard]] int steps(double rho) const;

 private:
  Eigen::VectorXd start_;
  Eigen::VectorXd goal_;
};

}  // namespace handway::sampling
