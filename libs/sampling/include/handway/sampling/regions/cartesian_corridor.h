#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/sampling/export.h"

#include <Eigen/Core>

namespace handway::sampling {

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
