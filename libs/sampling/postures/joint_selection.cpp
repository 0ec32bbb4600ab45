#include "joint_selection.h"

#include <stdexcept>
#include <string>

namespace handway::sampling {

std::vector<int> joints_taken(Eigen::Index joints, const std::vector<int>& left_out) {
  std::vector<bool> taken(static_cast<std::size_t>(joints), true);
  for (const int joint : left_out) {
    if (joint < 0 || joint >= joints || !taken[static_cast<std::size_t>(joint)]) {
      throw std::invalid_argument("joint " + std::to_string(joint) +
                                  " to leave out is unknown or named twice");
    }
    taken[static_cast<std::size_t>(joint)] = false;
  }
  std::vector<int> columns;
  for (int i = 0; i < joints; ++i) {
    if (taken[static_cast<std::size_t>(i)]) {
      columns.push_back(i);
    }
  }
  if (columns.empty()) {
    throw std::invalid_argument("every joint is left out of the principal component analysis");
  }
  return columns;
}

Eigen::VectorXd with_fixed_sign(const Eigen::VectorXd& direction) {
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  return direction[largest] < 0.0 ? Eigen::VectorXd(-direction) : direction;
}

Eigen::VectorXd shares_of(const Eigen::VectorXd& variances) {
  const double total = variances.sum();
  if (!(total > 0.0)) {
    return Eigen::VectorXd::Zero(variances.size());
  }
  return variances / total;
}

}  // namespace handway::sampling
