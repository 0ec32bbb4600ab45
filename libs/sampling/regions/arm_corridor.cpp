#include "handway/sampling/regions/arm_corridor.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace handway::sampling {

int corridor_steps(double length, double rho) {
  constexpr int kMost = 1 << 20;
  int count = 1;
  while (count < kMost && length / count > rho) {
    count *= 2;
  }
  return count;
}

ArmCorridor::ArmCorridor(Eigen::VectorXd start, Eigen::VectorXd goal)
    : start_(std::move(start)), goal_(std::move(goal)) {}

Eigen::VectorXd ArmCorridor::sample(double step, double rho, const Eigen::VectorXd& u) const {
  const Eigen::VectorXd centre = start_ + step * (goal_ - start_);
  return centre.array() + rho * (2.0 * u.array() - 1.0);
}

int ArmCorridor::steps(double rho) const { return corridor_steps(length(), rho); }

CartesianCorridor::CartesianCorridor(const geometric::Pose& X_BS, const geometric::Pose& X_BG,
                                     CartesianScale scale)
    : p_BS_(X_BS.translation()),
      p_BG_(X_BG.translation()),
      q_BS_(X_BS.linear()),
      q_BG_(X_BG.linear()),
      scale_(scale) {
  if (!(scale_.position > 0.0 && scale_.orientation > 0.0)) {
    throw std::invalid_argument("the scales of a Cartesian corridor must be above 0");
  }
}

double CartesianCorridor::length() const {
  return std::max((p_BG_ - p_BS_).norm() / scale_.position,
                  q_BS_.angularDistance(q_BG_) / scale_.orientation);
}

int CartesianCorridor::steps(double rho) const { return corridor_steps(length(), rho); }

geometric::Pose CartesianCorridor::pose(double step, double rho, const Eigen::VectorXd& u) const {
  if (u.size() != kDimension) {
    throw std::invalid_argument("a Cartesian sample has 6 coordinates, found " +
                                std::to_string(u.size()));
  }
  const Eigen::Matrix<double, 6, 1> e = rho * (2.0 * u.array() - 1.0);
  const Eigen::Quaterniond q_BT =
      q_BS_.slerp(step, q_BG_) *
      Eigen::Quaterniond(geometric::turn_from_rotation_vector(scale_.orientation * e.tail<3>()));
  geometric::Pose X_BT = geometric::Pose::Identity();
  X_BT.linear() = q_BT.toRotationMatrix();
  X_BT.translation() = p_BS_ + step * (p_BG_ - p_BS_) + scale_.position * e.head<3>();
  return X_BT;
}

}  // namespace handway::sampling
