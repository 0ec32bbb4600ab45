#include "handway/device/tracker/tracker.h"

#include <stdexcept>

namespace handway::device {

namespace {

// Far above the rounding error of a unit quaternion.
constexpr double kRigidTolerance = 1e-9;

bool is_rigid(const geometric::Pose& X) {
  const Eigen::Matrix3d R = X.linear();
  return X.translation().allFinite() && R.allFinite() && R.determinant() > 0.0 &&
         (R * R.transpose()).isIdentity(kRigidTolerance);
}

}  // namespace

void Tracker::check_sample(const TrackerSample& sample) const {
  if (!is_rigid(sample.X_ST)) {
    throw std::logic_error("a tracker's poses have to be finite and rigid");
  }
}

}  // namespace handway::device
