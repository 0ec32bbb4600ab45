#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <map>
#include <string>

namespace handway::device {

/// Returns whether a file has the signature of a MATLAB file (version 5 or 7.3).
[[nodiscard]] bool is_matlab_file(const std::filesystem::path& file);

/// The matrices of real numbers in a MATLAB file (version 5 or 7.3), by name, those of a structure
/// as "structure.field", those of cells as "name{row,column}"; other contents are ignored.
/// @throws geometric::InputError if it can't be read.
[[nodiscard]] std::map<std::string, Eigen::MatrixXd> read_matlab_file(
    const std::filesystem::path& file);

/// Their names and sizes, for messages: "angles (400 x 22), emg (400 x 12)".
[[nodiscard]] std::string names_of(const std::map<std::string, Eigen::MatrixXd>& matrices);

}  // namespace handway::device
