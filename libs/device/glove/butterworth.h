#pragma once

#include <Eigen/Core>

namespace handway::device {

/// A digital low-pass filter after Butterworth, of second order (bilinear transform with the
/// cutoff prewarped).
class Butterworth {
 public:
  /// @param cutoff frequency of the -3 dB point over the sampling rate, in (0, 0.5).
  explicit Butterworth(double cutoff);

  /// Forwards and backwards: no delay, twice the attenuation.
  [[nodiscard]] Eigen::VectorXd both_ways(const Eigen::VectorXd& signal) const;

 private:
  /// In place, beginning as if the first value had lasted for ever.
  void run(Eigen::VectorXd& signal) const;

  double gain_ = 1.0;                  ///< b0 = b2; b1 = 2 b0.
  double first_ = 0.0, second_ = 0.0;  ///< a1, a2.
  Eigen::Index settling_ = 0;          ///< Samples to continue both ends by.
};

}  // namespace handway::device
