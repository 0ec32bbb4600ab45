#pragma once

#include <filesystem>

namespace handway::planning {

/// Keeps other programs from working in a folder, as long as it lives; the system takes it
/// back from a program that is killed.
class FolderLock {
 public:
  /// @throws InputError if another program holds it, or the folder can't be opened.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace handway::planning
