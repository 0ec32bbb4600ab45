#pragma once

#include "glove/text_files.h"
#include "handway/device/glove/recording.h"

#include <Eigen/Core>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// Tables of postures that are no recordings yet: see read_recording().

namespace handway::device {

/// Whether a file begins as a MATLAB file does (version 5 or 7.3).
[[nodiscard]] bool is_matlab_file(const std::filesystem::path& file);

/// The matrices of real numbers in a MATLAB file (version 5 or 7.3), by name; all else in it is
/// passed over.
/// @throws geometric::InputError if it can't be read.
[[nodiscard]] std::map<std::string, Eigen::MatrixXd> read_matlab_file(
    const std::filesystem::path& file);

/// Whether lines are VirtualHand's postures without times: rows of 23 angles, or of 22 and a label,
/// with or without a header.
[[nodiscard]] bool is_posture_table(const std::vector<TextLine>& lines);

[[nodiscard]] Recording read_posture_table(const std::filesystem::path& file,
                                           const std::vector<TextLine>& lines);

/// A MATLAB file with what a glove of 18 or 22 sensors measured.
[[nodiscard]] Recording read_matlab_recording(const std::filesystem::path& file);

/// A table of any columns, by a map of them (YAML) that names it.
[[nodiscard]] Recording read_mapped_table(const std::filesystem::path& map);

}  // namespace handway::device
