#pragma once

#include "handway/device/glove/glove_calibration.h"
#include "text_lines.h"

#include <filesystem>
#include <vector>

/// The `.cal` text files of other programs, as read_calibration() documents them.
namespace handway::device {

/// Whether a line is `angle:counts angle:counts`.
[[nodiscard]] bool is_point_pair(const TextLine& line);

/// 22 lines of two points. @param lines without empty ones.
[[nodiscard]] GloveCalibration read_point_pairs(const std::filesystem::path& file,
                                                const std::vector<TextLine>& lines);

/// Six groups of four lines below a title. @param lines without empty ones.
[[nodiscard]] GloveCalibration read_virtual_hand_calibration(const std::filesystem::path& file,
                                                             const std::vector<TextLine>& lines);

}  // namespace handway::device
