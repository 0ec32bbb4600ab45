#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/recording.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace handway::device {

/// Quality of one sensor's readings; counts or rad as in the recording.
struct SensorQuality {
  int sensor = 0;  ///< Index into cyberglove_sensors().
  double least = 0.0;
  double most = 0.0;
  double first_percentile = 0.0;  ///< Below it lie 1 % of the values.
  double last_percentile = 0.0;   ///< Above it lie 1 % of the values.
  /// Standard deviation of random changes from one row to the next: from the median of the second
  /// differences (1.48 · median / √6).
  double noise = 0.0;
  double at_ends = 0.0;    ///< Share of rows at 1 or 255 counts, or beyond; 0 for angles.
  bool dead = false;       ///< Percentiles less than 3 counts or 0.02 rad apart.
  bool noisy = false;      ///< Noise above 3 counts or 0.05 rad.
  bool saturated = false;  ///< More than 1 % of rows at an end.
};

/// Quality of a recording.
struct RecordingQuality {
  Eigen::Index rows = 0;
  double duration = 0.0;               ///< s, from the first row to the last.
  double rate = 0.0;                   ///< Hz, by the median time between rows; 0: none.
  Eigen::Index gaps = 0;               ///< Times between rows above three medians.
  double largest_gap = 0.0;            ///< s
  Eigen::Index duplicates = 0;         ///< Rows with the same values as the row before.
  std::vector<SensorQuality> sensors;  ///< In column order.
  std::vector<std::string> warnings;   ///< Sensors that are dead, noisy, saturated; gaps.
};

/// Returns rate, gaps and faults of a recording's sensors.
[[nodiscard]] HANDWAY_DEVICE_EXPORT RecordingQuality assess(const Recording& recording);

/// The quantile of that share of the values, interpolated between neighbours.
/// @param share in [0, 1]. @pre values is not empty.
[[nodiscard]] HANDWAY_DEVICE_EXPORT double percentile(Eigen::VectorXd values, double share);

}  // namespace handway::device
