#include "handway/sampling/postures/incremental_components.h"

#include "handway/geometric/io/input_error.h"
#include "joint_selection.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <stdexcept>

namespace handway::sampling {

IncrementalComponents::IncrementalComponents(int joints) {
  if (joints < 1) {
    throw std::invalid_argument("principal components need a joint");
  }
  mean_ = Eigen::VectorXd::Zero(joints);
  scatter_ = Eigen::MatrixXd::Zero(joints, joints);
}

void IncrementalComponents::add(const Eigen::VectorXd& posture) {
  if (posture.size() != mean_.size() || !posture.allFinite()) {
    throw std::invalid_argument("a posture needs a finite value for every joint");
  }
  ++count_;
  const Eigen::VectorXd before = posture - mean_;
  mean_ += before / static_cast<double>(count_);
  scatter_ += before * (posture - mean_).transpose();
}

void IncrementalComponents::merge(const IncrementalComponents& other) {
  if (other.mean_.size() != mean_.size()) {
    throw std::invalid_argument("postures of different hands can't be merged");
  }
  if (other.count_ == 0) {
    return;
  }
  const auto mine = static_cast<double>(count_);
  const auto theirs = static_cast<double>(other.count_);
  const Eigen::VectorXd apart = other.mean_ - mean_;
  scatter_ += other.scatter_ + apart * apart.transpose() * (mine * theirs / (mine + theirs));
  mean_ += apart * (theirs / (mine + theirs));
  count_ += other.count_;
}

PrincipalComponents IncrementalComponents::components(const std::vector<int>& left_out) const {
  if (count_ < 2) {
    throw geometric::InputError({"postures", "", std::to_string(count_) + " samples", "at least 2",
                                 "Record more postures"});
  }
  const std::vector<int> taken = joints_taken(mean_.size(), left_out);
  const Eigen::MatrixXd scatter = scatter_(taken, taken);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 *
                                                              (scatter + scatter.transpose()));
  const Eigen::Index size = std::min(count_, solver.eigenvalues().size());
  PrincipalComponents result;
  result.mean = mean_;
  result.variances =
      solver.eigenvalues().reverse().head(size).cwiseMax(0.0) / static_cast<double>(count_ - 1);
  result.shares = shares_of(result.variances);
  result.directions = Eigen::MatrixXd::Zero(mean_.size(), size);
  for (Eigen::Index k = 0; k < size; ++k) {
    const Eigen::Index column = solver.eigenvectors().cols() - 1 - k;
    result.directions(taken, k) = with_fixed_sign(solver.eigenvectors().col(column));
  }
  return result;
}

}  // namespace handway::sampling
