#include "handway/device/glove/posture_source.h"

#include <utility>

namespace handway::device {

MappedPostures PostureSource::within_limits(Eigen::MatrixXd unclamped) const {
  MappedPostures mapped{
      joints_, Eigen::MatrixXd(unclamped.rows(), unclamped.cols()), std::move(unclamped), {}};
  for (Eigen::Index j = 0; j < mapped.unclamped.cols(); ++j) {
    const auto all = mapped.unclamped.col(j).array();
    mapped.postures.col(j) = all.max(lower_[j]).min(upper_[j]);
    mapped.clamped.push_back((all < lower_[j] || all > upper_[j]).count());
  }
  return mapped;
}

}  // namespace handway::device
