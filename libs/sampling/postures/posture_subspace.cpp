#include "handway/sampling/postures/posture_subspace.h"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace handway::sampling {

PostureSubspace::PostureSubspace(const PmdBasis& basis) {
  // Both are read off project() and the map back, so that there is one definition.
  const auto joints = basis.mean.size();
  centre_ = basis.mean;
  for (const FreeJoint& free : basis.free_joints) {
    centre_[free.joint] = free.centre;
  }
  across_ = Eigen::MatrixXd::Identity(joints, joints);
  for (Eigen::Index column = 0; column < joints; ++column) {
    const Eigen::VectorXd e = project(basis, centre_ + Eigen::VectorXd::Unit(joints, column));
    Eigen::Index axis = 0;
    for (const FreeJoint& free : basis.free_joints) {
      across_(free.joint, column) -= e[axis++];
    }
    for (const PrincipalDirection& direction : basis.directions) {
      across_.col(column) -= e[axis++] * direction.vector;
    }
  }
}

Eigen::VectorXd PostureSubspace::outside(const Eigen::VectorXd& posture) const {
  return across_ * (posture - centre_);
}

double PostureSubspace::distance(const Eigen::VectorXd& posture) const {
  return outside(posture).norm();
}

Eigen::VectorXd PostureSubspace::closest(const Eigen::VectorXd& posture) const {
  return (posture - outside(posture)).cwiseMax(0.0).cwiseMin(1.0);
}

Eigen::VectorXd principal_angles(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (a.rows() != b.rows() || a.cols() == 0 || b.cols() == 0) {
    throw std::invalid_argument("principal angles need two bases of the same space");
  }
  const Eigen::MatrixXd& wide = a.cols() >= b.cols() ? a : b;
  const Eigen::MatrixXd& narrow = a.cols() >= b.cols() ? b : a;
  const Eigen::JacobiSVD<Eigen::MatrixXd> shared(wide.transpose() * narrow);
  const Eigen::JacobiSVD<Eigen::MatrixXd> apart(narrow - wide * (wide.transpose() * narrow));
  const Eigen::Index count = narrow.cols();
  Eigen::VectorXd angles(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double cosine = std::clamp(shared.singularValues()[i], 0.0, 1.0);
    const Eigen::Index from_last = count - 1 - i;
    const double sine = from_last < apart.singularValues().size()
                            ? std::clamp(apart.singularValues()[from_last], 0.0, 1.0)
                            : 0.0;
    angles[i] = cosine * cosine < 0.5 ? std::acos(cosine) : std::asin(sine);
  }
  return angles;
}

}  // namespace handway::sampling
