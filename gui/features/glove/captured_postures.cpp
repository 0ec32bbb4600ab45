#include "features/glove/captured_postures.h"

#include "handway/sampling/postures/pmd_basis.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace handway::gui {
namespace {

constexpr std::size_t kMostSamples = 4000;
constexpr double kCompareEvery = 1.0;  // s
constexpr double kEnoughShare = 0.75;
constexpr Eigen::Index kMostDirections = 4;
constexpr double kLeastVariance = 1e-12;

// Returns the number of directions that explain three quarters of the variance.
Eigen::Index main_directions(const sampling::PrincipalComponents& components) {
  double share = 0.0;
  for (Eigen::Index k = 0; k < components.shares.size(); ++k) {
    share += components.shares[k];
    if (share >= kEnoughShare || k + 1 == kMostDirections) {
      return k + 1;
    }
  }
  return 0;
}

}  // namespace

CapturedPostures::CapturedPostures(std::vector<std::string> joints, std::vector<int> left_out)
    : joints_(std::move(joints)), left_out_(std::move(left_out)) {
  if (!joints_.empty()) {
    components_.emplace(static_cast<int>(joints_.size()));
  }
}

void CapturedPostures::add(double time, const Eigen::VectorXd& posture) {
  if (!components_) {
    return;
  }
  if (count_ == 0) {
    first_time_ = time;
  }
  last_time_ = time;
  components_->add(posture);
  if (count_ % stride_ == 0) {
    keep(posture);
  }
  ++count_;
  if (count_ > 1 && (subspaces_.empty() || time >= subspaces_.back().time + kCompareEvery)) {
    compare(time);
  }
}

void CapturedPostures::keep(const Eigen::VectorXd& posture) {
  if (samples_.size() == kMostSamples) {
    for (std::size_t i = 0; 2 * i < samples_.size(); ++i) {
      samples_[i] = samples_[2 * i];
    }
    samples_.resize(kMostSamples / 2);
    stride_ *= 2;
  }
  samples_.push_back(posture);
}

void CapturedPostures::compare(double time) {
  const sampling::PrincipalComponents now = components();
  subspaces_.push_back({time, now.directions});
  while (subspaces_.size() > 1 && subspaces_[1].time <= time - kWindow) {
    subspaces_.pop_front();
  }
  const Eigen::Index count = main_directions(now);
  const Subspace& before = subspaces_.front();
  if (before.time <= time - kWindow && count > 0 && before.directions.cols() >= count) {
    turn_ = sampling::principal_angles(before.directions.leftCols(count),
                                       now.directions.leftCols(count))
                .maxCoeff();
  }
}

Eigen::MatrixXd CapturedPostures::table() const {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(samples_.size()),
                       static_cast<Eigen::Index>(joints_.size()));
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = samples_[i].transpose();
  }
  return rows;
}

sampling::PrincipalComponents CapturedPostures::components(const std::vector<int>& left_out) const {
  return components_ ? components_->components(left_out)
                     : sampling::principal_components(Eigen::MatrixXd());
}

Eigen::MatrixXd CapturedPostures::correlations() const {
  const sampling::PrincipalComponents all = components_ ? components_->components() : components();
  const Eigen::MatrixXd covariance =
      all.directions * all.variances.asDiagonal() * all.directions.transpose();
  const Eigen::VectorXd variances = covariance.diagonal();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(covariance.rows(), covariance.cols());
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    for (Eigen::Index j = 0; j < result.cols(); ++j) {
      if (variances[i] > kLeastVariance && variances[j] > kLeastVariance) {
        result(i, j) =
            std::clamp(covariance(i, j) / std::sqrt(variances[i] * variances[j]), -1.0, 1.0);
      }
    }
  }
  return result;
}

bool CapturedPostures::has_settled() const {
  return turn_ && *turn_ < kSettledAngle && duration() >= kLeastTime;
}

}  // namespace handway::gui
