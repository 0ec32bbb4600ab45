#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/sampling/export.h"

#include <Eigen/Core>

namespace handway::sampling {

/// STEPS of section 5.3: the smallest power of two n such that n + 1 evenly spaced
/// points of a segment of this length are no farther apart than `rho`; capped at
/// 2^20. Powers of two, so that sweep_position() visits each point once.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT int corridor_steps(double length, double rho);

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

/// How far ρ_a, which is in normalised joints, reaches in Cartesian space.
struct CartesianScale {
  double position = 1.0;     ///< m per unit of ρ_a. > 0.
  double orientation = 3.0;  ///< rad per unit of ρ_a. > 0.
};

/// The arm's sampling region in Cartesian form: the tool moves straight from its
/// pose at the start to its pose at the goal while it turns evenly about one
/// axis; a pose on the way is perturbed. The arm configuration of a pose is for
/// the caller's inverse kinematics to find. A second reading of section 5.1, beside ArmCorridor.
class HANDWAY_SAMPLING_EXPORT CartesianCorridor {
 public:
  /// Coordinates of a sample: three of position, three of orientation.
  static constexpr int kDimension = 6;

  /// @param X_BS, X_BG tool poses at start and goal in the arm's base.
  /// @throws std::invalid_argument if a scale isn't above 0.
  CartesianCorridor(const geometric::Pose& X_BS, const geometric::Pose& X_BG,
                    CartesianScale scale = {});

  /// In units of ρ_a: the tool's way or turn, each divided by its scale,
  /// whichever is more.
  [[nodiscard]] double length() const;

  /// corridor_steps() of length() and `rho`: successive poses are no farther
  /// apart than `rho` in position and in orientation.
  [[nodiscard]] int steps(double rho) const;

  /// The perturbed tool pose X_BT. Its origin lies in the cube of half side
  /// rho · scale.position around the interpolated one, along the base's axes; its
  /// orientation is the interpolated one turned by a rotation vector, in the
  /// tool's frame, from the cube of half side rho · scale.orientation.
  /// @param step in [0, 1]. @param rho ≥ 0. @param u in [0,1]^6: position, then orientation.
  /// @throws std::invalid_argument if u has not six entries.
  [[nodiscard]] geometric::Pose pose(double step, double rho, const Eigen::VectorXd& u) const;

 private:
  Eigen::Vector3d p_BS_;
  Eigen::Vector3d p_BG_;
  Eigen::Quaterniond q_BS_;
  Eigen::Quaterniond q_BG_;
  CartesianScale scale_;
};

}  // namespace handway::sampling
