#include "butterworth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace handway::device {

Butterworth::Butterworth(double cutoff) {
  const double k = std::tan(std::numbers::pi * cutoff);
  const double scale = 1.0 / (1.0 + std::numbers::sqrt2 * k + k * k);
  gain_ = k * k * scale;
  first_ = 2.0 * (k * k - 1.0) * scale;
  second_ = (1.0 - std::numbers::sqrt2 * k + k * k) * scale;
  settling_ = static_cast<Eigen::Index>(std::ceil(2.0 / cutoff));
}

void Butterworth::run(Eigen::VectorXd& signal) const {
  if (signal.size() == 0) {
    return;
  }
  double in1 = signal[0];
  double in2 = in1;
  double out1 = in1;
  double out2 = in1;
  for (double& value : signal) {
    const double in = value;
    value = gain_ * (in + 2.0 * in1 + in2) - first_ * out1 - second_ * out2;
    in2 = in1;
    in1 = in;
    out2 = out1;
    out1 = value;
  }
}

Eigen::VectorXd Butterworth::both_ways(const Eigen::VectorXd& signal) const {
  const Eigen::Index count = signal.size();
  const Eigen::Index more = std::clamp<Eigen::Index>(count - 1, 0, settling_);
  Eigen::VectorXd longer(count + 2 * more);
  longer.segment(more, count) = signal;
  for (Eigen::Index i = 1; i <= more; ++i) {
    longer[more - i] = 2.0 * signal[0] - signal[i];
    longer[more + count - 1 + i] = 2.0 * signal[count - 1] - signal[count - 1 - i];
  }
  run(longer);
  longer.reverseInPlace();
  run(longer);
  longer.reverseInPlace();
  return longer.segment(more, count);
}

}  // namespace handway::device
