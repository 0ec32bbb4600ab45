#pragma once

#include "glove/text_files.h"
#include "handway/device/glove/recording.h"

#include <filesystem>
#include <vector>

namespace handway::device {

/// Reads lines of messages of a hand: see read_hand_message(). Every line needs a time. If both
/// hands are there, the first one seen is taken. A hand that is named wrongly is recognised by the
/// bending of its fingers. Warnings report both.
/// @throws InputError with file and line for any other line.
[[nodiscard]] Recording recording_of_hand_lines(const std::filesystem::path& file,
                                                const std::vector<TextLine>& lines);

}  // namespace handway::device
