#pragma once

#include "handway/device/glove/glove.h"
#include "handway/device/glove/glove_layout.h"

#include <string>

namespace handway::tools {

/// Every sensor with its letter, label, counts and a bar; below it the state of the stream.
[[nodiscard]] std::string glove_table(const device::GloveFrame& frame, int sensors,
                                      device::StreamState state,
                                      const device::StreamStatistics& statistics);

/// "100.0 Hz, 1234 frames, …".
[[nodiscard]] std::string statistics_line(const device::StreamStatistics& statistics);

/// Time and counts of one frame, separated by blanks.
[[nodiscard]] std::string frame_line(const device::GloveFrame& frame, int sensors);

/// {"time": …, "counts": {"ThumbRotate": …, …}} on one line.
[[nodiscard]] std::string frame_json(const device::GloveFrame& frame, int sensors);

/// {"statistics": {…}} on one line.
[[nodiscard]] std::string statistics_json(const device::StreamStatistics& statistics);

}  // namespace handway::tools
