#include "handway/sampling/regions/arm_corridor.h"

#include "handway/sampling/regions/corridor_steps.h"

#include <utility>

namespace handway::sampling {

ArmCorridor::ArmCorridor(Eigen::VectorXd start, Eigen::VectorXd goal)
    : start_(std::move(start)), goal_(std::move(goal)) {}

Eigen::VectorXd ArmCorridor::sample(double step, double rho, const Eigen::VectorXd& u) const {
  const Eigen::VectorXd centre = start_ + step * (goal_ - start_);
  return centre.array() + rho * (2.0 * u.array() - 1.0);
}

int ArmCorridor::steps(double rho) const { return corridor_steps(length(), rho); }

}  // namespace handway::sampling
