#include "handway/sampling/postures/posture_subspace.h"

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

}  // namespace handway::sampling
