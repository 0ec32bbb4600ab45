#pragma once

#include "handway/device/core/device_stream.h"
#include "handway/device/export.h"
#include "handway/geometric/math/pose.h"

#include <optional>
#include <string>

namespace handway::device {

/// Pose of a sensor of a tracker.
struct TrackerSample {
  double time = 0.0;  ///< Arrival, s since the tracker was first connected.
  int sensor = 1;     ///< Number of the sensor; Polhemus stations count from 1.
  /// Pose of the sensor's frame T in the frame S of the source (or transmitter), m.
  geometric::Pose X_ST = geometric::Pose::Identity();
  std::optional<bool> button;  ///< True if pressed; nothing if the sensor has none.
};

/// Properties that a connected tracker reports.
struct TrackerInfo {
  std::string device;  ///< Port, as the user named it.
  std::string model;   ///< "Polhemus Fastrak, binary".
};

/// A tracker of the wrist's pose (paper, section 3): samples of one sensor or several. Poses are
/// finite and rigid.
class HANDWAY_DEVICE_EXPORT Tracker : public SampledDevice<TrackerInfo, TrackerSample> {
 private:
  void check_sample(const TrackerSample& sample) const override;
};

/// Result of reading a tracker once.
using TrackerReading = Tracker::Reading;

/// Stream of a tracker's poses, read on a thread of its own.
using TrackerStream = DeviceStream<Tracker>;
/// Callbacks of a tracker's stream.
using TrackerStreamHandlers = TrackerStream::Handlers;

}  // namespace handway::device
