#pragma once

#include "recordings/array_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace handway::device {

/// Arrays of a file that the program `handway-array-reader` reads, in a process of its own: the
/// libraries of such formats may crash on damaged files.
class ProcessArrays final : public NamedArrays {
 public:
  /// @param format "hdf5" or "matlab".
  /// @throws InputError if the file is damaged, reading takes longer than 100 s or more than 4 GB
  /// of memory, or the program can't be started.
  ProcessArrays(const std::filesystem::path& file, std::string format);

 private:
  [[nodiscard]] Eigen::MatrixXd numbers(const RecordingVariable& variable) const override;
  [[nodiscard]] std::vector<std::string> words(const RecordingVariable& variable) const override;

  std::string format_;
};

}  // namespace handway::device
