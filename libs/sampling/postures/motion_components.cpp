#include "handway/sampling/postures/motion_components.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace handway::sampling {
namespace {

constexpr double kVarianceHeld = 0.95;
constexpr Eigen::Index kFolds = 10;
constexpr double kUnmoved = 1e-6;  // normalised joints

/// Mean and axes of motions that are stacked to vectors.
struct StackedComponents {
  Eigen::VectorXd mean;
  Eigen::MatrixXd axes;
};

// The first of the rising eigenvalues such that it and those after it have kVarianceHeld.
Eigen::Index first_axis(const Eigen::VectorXd& rising) {
  const double wanted = kVarianceHeld * rising.sum();
  double held = 0.0;
  Eigen::Index first = rising.size();
  while (first > 0 && held < wanted) {
    held += rising[--first];
  }
  return first;
}

// Components by the scalar products of the motions, of which there are fewer than entries.
// @param stacked one motion a column.
StackedComponents stacked_components(const Eigen::MatrixXd& stacked) {
  StackedComponents result{stacked.rowwise().mean(), {}};
  const Eigen::MatrixXd centred = stacked.colwise() - result.mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(centred.transpose() * centred);
  const Eigen::VectorXd squares = solver.eigenvalues().cwiseMax(0.0);
  const Eigen::Index first = first_axis(squares);
  const Eigen::Index count = squares.size() - first;
  result.axes = centred * solver.eigenvectors().rightCols(count);
  result.axes.colwise().normalize();
  return result;
}

// RMS over time of what the components can't represent, for each joint.
Eigen::VectorXd errors_of(const Eigen::VectorXd& stacked, const Eigen::VectorXd& mean,
                          const Eigen::MatrixXd& axes) {
  const Eigen::VectorXd centred = stacked - mean;
  const Eigen::VectorXd rest = centred - axes * (axes.transpose() * centred);
  const auto by_joint = rest.reshaped(kMotionPoints, rest.size() / kMotionPoints);
  return by_joint.colwise().norm().transpose() / std::sqrt(static_cast<double>(kMotionPoints));
}

bool moves(const std::vector<HandMotion>& motions, Eigen::Index joint) {
  const double first = motions.front().joints(0, joint);
  return std::ranges::any_of(motions, [&](const HandMotion& motion) {
    return (motion.joints.col(joint).array() - first).abs().maxCoeff() > kUnmoved;
  });
}

void check_motions(const std::vector<HandMotion>& motions, const HandJointIndices& left_out) {
  if (motions.size() < MotionComponents::kFewestMotions) {
    throw std::invalid_argument("too few motions for components");
  }
  const Eigen::Index columns = motions.front().joints.cols();
  for (const HandMotion& motion : motions) {
    if (motion.joints.rows() != kMotionPoints || motion.joints.cols() != columns) {
      throw std::invalid_argument("components need motions of the same joints and points");
    }
  }
  if (std::ranges::any_of(left_out, [&](int joint) { return joint < 0 || joint >= columns; })) {
    throw std::invalid_argument("a joint to leave out is unknown");
  }
}

HandJointIndices counting_joints(const std::vector<HandMotion>& motions,
                                 const HandJointIndices& left_out) {
  HandJointIndices joints;
  for (int joint = 0; joint < motions.front().joints.cols(); ++joint) {
    if (std::ranges::count(left_out, joint) == 0 && moves(motions, joint)) {
      joints.push_back(joint);
    }
  }
  if (joints.empty()) {
    throw std::invalid_argument("no joint moves in the motions");
  }
  return joints;
}

Eigen::VectorXd stack(const Eigen::MatrixXd& motion, const HandJointIndices& joints) {
  return motion(Eigen::all, joints).reshaped();
}

// The columns but for `count` from `first` on.
Eigen::MatrixXd without_columns(const Eigen::MatrixXd& stacked, Eigen::Index first,
                                Eigen::Index count) {
  Eigen::MatrixXd rest(stacked.rows(), stacked.cols() - count);
  rest << stacked.leftCols(first), stacked.rightCols(stacked.cols() - first - count);
  return rest;
}

Eigen::MatrixXd held_out_errors_of(const Eigen::MatrixXd& stacked) {
  Eigen::MatrixXd errors(stacked.cols(), stacked.rows() / kMotionPoints);
  for (Eigen::Index fold = 0; fold < kFolds; ++fold) {
    const Eigen::Index first = fold * stacked.cols() / kFolds;
    const Eigen::Index end = (fold + 1) * stacked.cols() / kFolds;
    const StackedComponents others =
        stacked_components(without_columns(stacked, first, end - first));
    for (Eigen::Index motion = first; motion < end; ++motion) {
      errors.row(motion) = errors_of(stacked.col(motion), others.mean, others.axes).transpose();
    }
  }
  return errors;
}

}  // namespace

MotionComponents::MotionComponents(const std::vector<HandMotion>& motions,
                                   const HandJointIndices& left_out) {
  check_motions(motions, left_out);
  motions_ = motions.size();
  columns_ = motions.front().joints.cols();
  joints_ = counting_joints(motions, left_out);
  Eigen::MatrixXd stacked(kMotionPoints * std::ssize(joints_), std::ssize(motions));
  for (Eigen::Index motion = 0; motion < stacked.cols(); ++motion) {
    stacked.col(motion) = stack(motions[static_cast<std::size_t>(motion)].joints, joints_);
  }
  StackedComponents components = stacked_components(stacked);
  mean_ = std::move(components.mean);
  axes_ = std::move(components.axes);
  held_out_ = held_out_errors_of(stacked);
}

Eigen::VectorXd MotionComponents::errors(const Eigen::MatrixXd& motion) const {
  if (motion.rows() != kMotionPoints || motion.cols() != columns_) {
    throw std::invalid_argument("a motion needs the points and joints of the components' motions");
  }
  return errors_of(stack(motion, joints_), mean_, axes_);
}

}  // namespace handway::sampling
