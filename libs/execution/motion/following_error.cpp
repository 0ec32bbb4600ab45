#include "handway/execution/motion/following_error.h"

#include <algorithm>

namespace handway::execution {

void FollowingError::add(const Eigen::VectorXd& error) {
  max_ = max_.cwiseMax(error.cwiseAbs());
  squares_ += error.cwiseAbs2();
  ++samples_;
}

Eigen::VectorXd FollowingError::rms() const {
  return (squares_ / std::max(samples_, 1)).cwiseSqrt();
}

}  // namespace handway::execution
