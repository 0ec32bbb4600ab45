#include "handway/sampling/postures/pmd_basis.h"

#include <Eigen/QR>

#include <stdexcept>
#include <utility>

namespace handway::sampling {
namespace {

// Columns: the axes of SC^h, free joints first.
Eigen::MatrixXd axes(const PmdBasis& basis) {
  Eigen::MatrixXd E = Eigen::MatrixXd::Zero(basis.mean.size(), basis.dimension());
  Eigen::Index column = 0;
  for (const FreeJoint& free : basis.free_joints) {
    E(free.joint, column++) = 1.0;
  }
  for (const PrincipalDirection& direction : basis.directions) {
    E.col(column++) = direction.vector;
  }
  return E;
}

// b with the free joints at their own centres.
Eigen::VectorXd centre(const PmdBasis& basis) {
  Eigen::VectorXd b = basis.mean;
  for (const FreeJoint& free : basis.free_joints) {
    b[free.joint] = free.centre;
  }
  return b;
}

}  // namespace

Eigen::VectorXd map_to_posture(const PmdBasis& basis, const Eigen::VectorXd& u) {
  if (u.size() > basis.dimension()) {
    throw std::invalid_argument("sample has " + std::to_string(u.size()) +
                                " coordinates, the basis " + std::to_string(basis.dimension()) +
                                " axes");
  }
  Eigen::VectorXd posture = centre(basis);
  const auto free_count = static_cast<Eigen::Index>(basis.free_joints.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const double e = 2.0 * u[i] - 1.0;  // in units of the half-side
    if (i < free_count) {
      const FreeJoint& free = basis.free_joints[static_cast<std::size_t>(i)];
      posture[free.joint] += e * free.half_side;
    } else {
      const PrincipalDirection& direction =
          basis.directions[static_cast<std::size_t>(i - free_count)];
      posture += e * direction.half_side * direction.vector;
    }
  }
  return posture.cwiseMax(0.0).cwiseMin(1.0);
}

Eigen::MatrixXd box_axes(const PmdBasis& basis) {
  Eigen::MatrixXd scaled = axes(basis);
  Eigen::Index column = 0;
  for (const FreeJoint& free : basis.free_joints) {
    scaled.col(column++) *= free.half_side;
  }
  for (const PrincipalDirection& direction : basis.directions) {
    scaled.col(column++) *= direction.half_side;
  }
  return scaled;
}

Eigen::VectorXd project(const PmdBasis& basis, const Eigen::VectorXd& posture) {
  return axes(basis).colPivHouseholderQr().solve(posture - centre(basis));
}

double distance_to_subspace(const PmdBasis& basis, const Eigen::VectorXd& posture) {
  return (axes(basis) * project(basis, posture) + centre(basis) - posture).norm();
}

PmdBasis full_joint_basis(std::string hand, std::vector<std::string> joints) {
  PmdBasis basis;
  basis.hand = std::move(hand);
  basis.source = "every joint over its whole range";
  basis.joints = std::move(joints);
  const auto count = static_cast<Eigen::Index>(basis.joints.size());
  basis.mean = Eigen::VectorXd::Constant(count, 0.5);
  for (int i = 0; i < static_cast<int>(count); ++i) {
    basis.free_joints.push_back({i, 0.5, 0.5});
  }
  return basis;
}

}  // namespace handway::sampling
