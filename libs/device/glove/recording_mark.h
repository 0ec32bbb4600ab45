#pragma once

namespace handway::device {

/// The first line of every recording of Handway.
inline constexpr const char* kRecordingMark = "# handway glove recording 1";

}  // namespace handway::device
