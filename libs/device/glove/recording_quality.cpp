#include "handway/device/glove/recording_quality.h"

#include "handway/device/glove/glove_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace handway::device {
namespace {

constexpr double kMedianToDeviation = 1.4826;  // factor for a normal distribution
constexpr double kGapMedians = 3.0;
constexpr double kSaturatedShare = 0.01;

struct Thresholds {
  double dead;
  double noisy;
};

Thresholds thresholds(RecordingKind kind) {
  return kind == RecordingKind::kCounts ? Thresholds{3.0, 3.0} : Thresholds{0.02, 0.05};
}

double noise_of(const Eigen::VectorXd& x) {
  const Eigen::Index inner = x.size() - 2;
  if (inner < 1) {
    return 0.0;
  }
  const Eigen::VectorXd second = x.head(inner) - 2.0 * x.segment(1, inner) + x.tail(inner);
  return kMedianToDeviation * percentile(second.cwiseAbs(), 0.5) / std::sqrt(6.0);
}

SensorQuality assess_sensor(const Recording& recording, Eigen::Index column) {
  const RecordingKind kind = recording.header.kind;
  const Eigen::VectorXd values = recording.values.col(column);
  SensorQuality quality;
  quality.sensor = recording.header.sensors[static_cast<std::size_t>(column)];
  quality.least = values.minCoeff();
  quality.most = values.maxCoeff();
  quality.first_percentile = percentile(values, 0.01);
  quality.last_percentile = percentile(values, 0.99);
  quality.noise = noise_of(values);
  if (kind == RecordingKind::kCounts) {
    const auto ends = (values.array() <= 1.0 || values.array() >= 255.0).count();
    quality.at_ends = static_cast<double>(ends) / static_cast<double>(values.size());
  }
  quality.dead = quality.last_percentile - quality.first_percentile < thresholds(kind).dead;
  quality.noisy = quality.noise > thresholds(kind).noisy;
  quality.saturated = quality.at_ends > kSaturatedShare;
  return quality;
}

/// The mean of the steps about the median: the median alone is inexact for times in whole
/// milliseconds.
double usual_step(const Eigen::VectorXd& steps, double median) {
  double sum = 0.0;
  Eigen::Index count = 0;
  for (const double step : steps) {
    if (step > 0.5 * median && step < 1.5 * median) {
      sum += step;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : median;
}

void assess_times(const Eigen::VectorXd& times, RecordingQuality& quality) {
  quality.rows = times.size();
  if (times.size() < 2) {
    return;
  }
  const Eigen::VectorXd steps = times.tail(times.size() - 1) - times.head(times.size() - 1);
  const double median = percentile(steps, 0.5);
  quality.duration = times[times.size() - 1] - times[0];
  quality.rate = median > 0.0 ? 1.0 / usual_step(steps, median) : 0.0;
  quality.largest_gap = steps.maxCoeff();
  quality.gaps = median > 0.0 ? (steps.array() > kGapMedians * median).count() : 0;
}

void warn(RecordingQuality& quality, RecordingKind kind) {
  const char* const unit = kind == RecordingKind::kCounts ? "counts" : "rad";
  for (const SensorQuality& sensor : quality.sensors) {
    const auto name = cyberglove_sensors()[static_cast<std::size_t>(sensor.sensor)].name;
    if (sensor.dead) {
      quality.warnings.push_back(
          fmt::format("sensor {} is dead or was not moved: {:.4g} to {:.4g} {}", name, sensor.least,
                      sensor.most, unit));
    }
    if (sensor.noisy) {
      quality.warnings.push_back(
          fmt::format("sensor {} is noisy: {:.3g} {}", name, sensor.noise, unit));
    }
    if (sensor.saturated) {
      quality.warnings.push_back(fmt::format(
          "sensor {} is at an end of its range in {:.1f} % of rows", name, 100.0 * sensor.at_ends));
    }
  }
  if (quality.gaps > 0) {
    quality.warnings.push_back(
        fmt::format("{} gaps in time, the longest {:.3g} s", quality.gaps, quality.largest_gap));
  }
}

}  // namespace

double percentile(Eigen::VectorXd values, double share) {
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<Eigen::Index>(place);
  std::nth_element(values.begin(), values.begin() + below, values.end());
  const double low = values[below];
  if (below + 1 == values.size()) {
    return low;
  }
  const double high = *std::min_element(values.begin() + below + 1, values.end());
  return std::lerp(low, high, place - static_cast<double>(below));
}

RecordingQuality assess(const Recording& recording) {
  RecordingQuality quality;
  assess_times(recording.times, quality);
  for (Eigen::Index row = 1; row < recording.values.rows(); ++row) {
    quality.duplicates += recording.values.row(row) == recording.values.row(row - 1) ? 1 : 0;
  }
  for (Eigen::Index column = 0; column < std::ssize(recording.header.sensors); ++column) {
    quality.sensors.push_back(assess_sensor(recording, column));
  }
  warn(quality, recording.header.kind);
  return quality;
}

}  // namespace handway::device
