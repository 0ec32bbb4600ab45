#include "handway/device/tracker/tracker.h"

#include <cmath>
#include <stdexcept>

namespace handway::device {

namespace {

// Far above what rounding leaves of a unit quaternion.
constexpr double kRigidTolerance = 1e-9;

bool is_rigid(const geometric::Pose& X) {
  const Eigen::Matrix3d R = X.linear();
  return X.translation().allFinite() && R.allFinite() && R.determinant() > 0.0 &&
         (R * R.transpose()).isIdentity(kRigidTolerance);
}

}  // namespace

TrackerInfo Tracker::connect(const std::stop_token& stop) {
  disconnect();
  clock_.start();
  TrackerInfo info = do_connect(stop);
  connected_ = true;
  return info;
}

TrackerReading Tracker::next(std::chrono::milliseconds timeout, const std::stop_token& stop) {
  if (!connected_) {
    throw std::logic_error("a tracker has to be connected before it is read");
  }
  TrackerReading reading = do_next(timeout, stop);
  if (reading.event != TrackerEvent::kSample) {
    return reading;
  }
  if (!is_rigid(reading.sample.X_ST)) {
    throw std::logic_error("a tracker's poses have to be finite and rigid");
  }
  reading.sample.time = clock_.not_before_last(reading.sample.time);
  return reading;
}

void Tracker::disconnect() noexcept {
  if (connected_) {
    connected_ = false;
    do_disconnect();
  }
}

}  // namespace handway::device
