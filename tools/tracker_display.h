#pragma once

#include "handway/device/core/stream_statistics.h"
#include "handway/device/tracker/tracker.h"

#include <map>
#include <string>

namespace handway::tools {

/// Every sensor's last pose (mm, deg) and button; below them how the stream runs.
[[nodiscard]] std::string tracker_table(const std::map<int, device::TrackerSample>& sensors,
                                        const char* state,
                                        const device::StreamStatistics& statistics,
                                        const device::TrackerFaults& faults);

/// "120.0 Hz, 1234 samples, …".
[[nodiscard]] std::string tracker_statistics_line(const device::StreamStatistics& statistics,
                                                  const device::TrackerFaults& faults);

/// Time, sensor, position (m), quaternion (x y z w) and button (0, 1 or -) of a sample.
[[nodiscard]] std::string sample_line(const device::TrackerSample& sample);

/// {"statistics": {…}} on one line.
[[nodiscard]] std::string tracker_statistics_json(const device::StreamStatistics& statistics,
                                                  const device::TrackerFaults& faults);

}  // namespace handway::tools
