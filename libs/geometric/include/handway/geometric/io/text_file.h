#pragma once

#include "handway/geometric/export.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace handway::geometric {

/// Records which files a thread reads during its lifetime: all files of a scene, with those that
/// they refer to. Recorders of one thread may be nested.
class HANDWAY_GEOMETRIC_EXPORT FilesRead {
 public:
  FilesRead();
  ~FilesRead();
  FilesRead(const FilesRead&) = delete;
  FilesRead& operator=(const FilesRead&) = delete;

  /// Files, each once, by its absolute path, in the order in which they were first read.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  friend void note_file_read(const std::filesystem::path& file);

  std::vector<std::filesystem::path> files_;
  FilesRead* outer_;
};

/// To be called by every reader of files that a scene or a problem may refer to.
HANDWAY_GEOMETRIC_EXPORT void note_file_read(const std::filesystem::path& file);

/// The whole content of a text file, as UTF-8 without control characters and byte-order mark:
/// UTF-8, UTF-16 with its mark, or with bytes of Latin-1 in between.
/// @param what expected kind of the file, for messages: "a robot file (URDF)".
/// @throws InputError if it is missing, a folder, device or pipe, unreadable, empty, larger than
/// `limit` bytes, or not text; an invalid byte is reported with its line.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string read_text_file(
    const std::filesystem::path& file, const std::string& what,
    std::size_t limit = std::size_t{64} << 20);

/// The first `size` bytes of a file, fewer of a shorter one; empty if it can't be read. For readers
/// that recognize their files.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string head_of(const std::filesystem::path& file,
                                                           std::size_t size = std::size_t{1} << 16);

}  // namespace handway::geometric
