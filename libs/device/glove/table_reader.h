#pragma once

#include "glove/text_files.h"
#include "handway/device/glove/recording.h"

#include <filesystem>
#include <vector>

/// Tables of postures that are no recordings yet: see read_recording().

namespace handway::device {

/// Text of other programs: columns by the names of their header, as sensors are called by Handway
/// or others; without names, those of a glove's records or of VirtualHand. Unit and signs by the
/// numbers; warnings say what it was taken for, and which columns and rows were left out.
[[nodiscard]] Recording read_other_table(const std::filesystem::path& file,
                                         const std::vector<TextLine>& lines);

/// A MATLAB file with what a glove of 18 or 22 sensors measured.
[[nodiscard]] Recording read_matlab_recording(const std::filesystem::path& file);

/// A table of any columns, by a map of them (YAML) that names it.
[[nodiscard]] Recording read_mapped_table(const std::filesystem::path& map);

}  // namespace handway::device
