#pragma once

#include "glove/text_files.h"
#include "handway/device/glove/recording.h"

#include <filesystem>
#include <vector>

/// Tables of postures of other programs: see read_recording().

namespace handway::device {

/// Reads text of other programs: columns by the names of their header, as sensors are called by
/// Handway or others; without names, those of a glove's records or of VirtualHand. Unit and signs
/// are inferred from the numbers; warnings report the inference, and the columns and rows left out.
[[nodiscard]] Recording read_other_table(const std::filesystem::path& file,
                                         const std::vector<TextLine>& lines);

/// Reads a MATLAB file with the measurements of a glove of 18 or 22 sensors.
[[nodiscard]] Recording read_matlab_recording(const std::filesystem::path& file);

/// A table of any columns, by a map of them (YAML) that names it.
[[nodiscard]] Recording read_mapped_table(const std::filesystem::path& map);

}  // namespace handway::device
