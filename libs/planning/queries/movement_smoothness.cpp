#include "handway/planning/queries/movement_smoothness.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace handway::planning {
namespace {

constexpr Eigen::Index kFewestSamples = 5;
constexpr double kHighestFrequency = 10.0;  // Hz
constexpr double kLeastAmplitude = 0.05;    // of the largest
constexpr std::size_t kPadding = 16;        // times the samples, rounded up to a power of two
constexpr double kEndWeight = 1.5;          // of the second differences beside the ends

// The integral of the squared second derivative of the speed. The first and the last second
// difference stand for the half step beyond them, too.
double squared_jerk(const SpeedProfile& profile) {
  const Eigen::VectorXd& v = profile.speed;
  const Eigen::Index inner = v.size() - 2;
  const Eigen::VectorXd squares =
      (v.head(inner) - 2.0 * v.segment(1, inner) + v.tail(inner)).cwiseAbs2();
  const double sum =
      squares.sum() + (kEndWeight - 1.0) * (squares[0] + squares[squares.size() - 1]);
  return sum / (profile.period * profile.period * profile.period);
}

double log_dimensionless_jerk(const SpeedProfile& profile) {
  const double duration = profile.period * static_cast<double>(profile.speed.size() - 1);
  const double peak = profile.speed.maxCoeff();
  return -std::log(duration * duration * duration / (peak * peak) * squared_jerk(profile));
}

// Amplitudes of the padded spectrum up to kHighestFrequency, the largest 1.
// @param step Hz between two amplitudes, set.
std::vector<double> amplitudes_of(const SpeedProfile& profile, double& step) {
  const auto samples = static_cast<std::size_t>(profile.speed.size());
  const std::size_t size = std::bit_ceil(samples) * kPadding;
  std::vector<double> padded(size, 0.0);
  std::ranges::copy(profile.speed, padded.begin());
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double> transform;
  transform.fwd(spectrum, padded);
  step = 1.0 / (profile.period * static_cast<double>(size));
  const auto highest = static_cast<std::size_t>(kHighestFrequency / step);
  std::vector<double> amplitudes;
  for (std::size_t i = 0; i <= std::min(highest, size / 2); ++i) {
    amplitudes.push_back(std::abs(spectrum[i]));
  }
  const double largest = *std::ranges::max_element(amplitudes);
  for (double& amplitude : amplitudes) {
    amplitude /= largest;
  }
  return amplitudes;
}

double spectral_arc_length(const SpeedProfile& profile) {
  double step = 0.0;
  std::vector<double> amplitudes = amplitudes_of(profile, step);
  while (amplitudes.size() > 2 && amplitudes.back() < kLeastAmplitude) {
    amplitudes.pop_back();
  }
  const double along = 1.0 / static_cast<double>(amplitudes.size() - 1);
  double length = 0.0;
  for (std::size_t i = 1; i < amplitudes.size(); ++i) {
    length += std::hypot(along, amplitudes[i] - amplitudes[i - 1]);
  }
  return -length;
}

}  // namespace

std::optional<MovementSmoothness> movement_smoothness(const SpeedProfile& profile) {
  if (profile.speed.size() < kFewestSamples || !(profile.period > 0.0) ||
      !profile.speed.allFinite() || !(profile.speed.maxCoeff() > 0.0)) {
    return std::nullopt;
  }
  const MovementSmoothness smoothness{log_dimensionless_jerk(profile),
                                      spectral_arc_length(profile)};
  return std::isfinite(smoothness.log_dimensionless_jerk) ? std::optional(smoothness)
                                                          : std::nullopt;
}

}  // namespace handway::planning
