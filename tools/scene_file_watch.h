#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace handway::tools {

/// Former state of a file: the attributes visible without reading it, and its content.
struct SeenFile {
  std::filesystem::path file;
  std::filesystem::file_time_type written;
  std::uintmax_t size = 0;
  std::string digest;
};

/// The files' present states.
/// @param files all files of a scene (geometric::FilesRead).
[[nodiscard]] std::vector<SeenFile> see_files(const std::vector<std::filesystem::path>& files);

/// Detects within some 20 ms that a file's content has changed: the data of a running motion were
/// edited.
class SceneFileWatch {
 public:
  /// @param seen what later changes are compared with.
  /// @param on_edit called once for each edit, on a thread of its own.
  SceneFileWatch(std::vector<SeenFile> seen, std::function<void()> on_edit);

 private:
  [[nodiscard]] bool was_edited();
  void work(const std::stop_token& stop);

  std::vector<SeenFile> seen_;
  std::function<void()> on_edit_;
  std::jthread thread_;
};

}  // namespace handway::tools
