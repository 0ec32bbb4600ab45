#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace handway::device {

/// A binary file that is read at any place. Memory is taken only for bytes that are there.
class FileBytes {
 public:
  /// @throws InputError if the file can't be opened. @param what its kind, for messages.
  FileBytes(std::filesystem::path file, const std::string& what);

  [[nodiscard]] const std::filesystem::path& path() const { return file_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Returns whether the file has that many bytes from `offset` on.
  [[nodiscard]] bool has(std::uint64_t offset, std::uint64_t size) const {
    return offset <= size_ && size <= size_ - offset;
  }
  /// Reads bytes from `offset` on; fewer at the end of the file.
  [[nodiscard]] std::string read(std::uint64_t offset, std::uint64_t size) const;

 private:
  std::filesystem::path file_;
  mutable std::ifstream stream_;
  std::uint64_t size_ = 0;
};

}  // namespace handway::device
