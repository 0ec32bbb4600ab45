#include "recordings/frame_statistics.h"

#include <cmath>

namespace handway::device {

FrameStatistics::FrameStatistics(const Eigen::MatrixXd& rows)
    : count_(rows.rows()),
      least_(rows.colwise().minCoeff()),
      most_(rows.colwise().maxCoeff()),
      mean_(rows.colwise().mean()),
      squares_((rows.rowwise() - mean_).colwise().squaredNorm()) {}

void FrameStatistics::merge(const FrameStatistics& other) {
  if (count_ == 0) {
    *this = other;
    return;
  }
  const auto before = static_cast<double>(count_);
  const auto added = static_cast<double>(other.count_);
  const Eigen::RowVectorXd shift = other.mean_ - mean_;
  squares_ += other.squares_ + shift.cwiseAbs2() * (before * added / (before + added));
  mean_ += shift * (added / (before + added));
  least_ = least_.cwiseMin(other.least_);
  most_ = most_.cwiseMax(other.most_);
  count_ += other.count_;
}

Eigen::RowVectorXd FrameStatistics::deviation() const {
  return (squares_ / static_cast<double>(count_)).cwiseSqrt();
}

}  // namespace handway::device
