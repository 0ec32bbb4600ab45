#pragma once

#include <string_view>

namespace handway::device {

/// The first line of every recording of Handway.
inline constexpr const char* kRecordingMark = "# handway glove recording 1";
/// Mark before the label of a column of the source.
inline constexpr std::string_view kRawMark = "raw:";

}  // namespace handway::device
