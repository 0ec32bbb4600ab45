#pragma once

#include "handway/device/glove/recording.h"

#include <span>
#include <string>

namespace handway::device {

/// The first line of every recording of Handway.
inline constexpr const char* kRecordingMark = "# handway glove recording 1";

/// The lines before the first row. @throws std::invalid_argument for a sensor that isn't
/// there, one twice, or none.
[[nodiscard]] std::string header_text(const RecordingHeader& header);

/// One row with its end of line. @throws std::invalid_argument if a value isn't finite or
/// their number is not that of the sensors.
[[nodiscard]] std::string row_text(const RecordingHeader& header, double time,
                                   std::span<const double> values);

}  // namespace handway::device
