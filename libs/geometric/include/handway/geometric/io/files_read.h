#pragma once

#include "handway/geometric/export.h"

#include <filesystem>
#include <vector>

namespace handway::geometric {

/// Notes which files a thread reads while it lives: all that a scene is made of, whatever refers
/// to what. Those of one thread may be nested.
class HANDWAY_GEOMETRIC_EXPORT FilesRead {
 public:
  FilesRead();
  ~FilesRead();
  FilesRead(const FilesRead&) = delete;
  FilesRead& operator=(const FilesRead&) = delete;

  /// Each once, by its absolute path, in the order in which they were first read.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  friend void note_file_read(const std::filesystem::path& file);

  std::vector<std::filesystem::path> files_;
  FilesRead* outer_;
};

/// To be called by every reader of a file that a scene or a problem may refer to.
HANDWAY_GEOMETRIC_EXPORT void note_file_read(const std::filesystem::path& file);

}  // namespace handway::geometric
