#include "recordings/file_bytes.h"

#include "handway/geometric/io/input_error.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace handway::device {

FileBytes::FileBytes(std::filesystem::path file, const std::string& what)
    : file_(std::move(file)), stream_(file_, std::ios::binary) {
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(file_, error);
  const std::uintmax_t size = is_file ? std::filesystem::file_size(file_, error) : 0;
  if (!is_file || error || !stream_) {
    throw geometric::InputError({file_.string(), "", "a file that can't be read", what, ""});
  }
  size_ = size;
}

std::string FileBytes::read(std::uint64_t offset, std::uint64_t size) const {
  std::string bytes;
  if (offset < size_) {
    bytes.resize(static_cast<std::size_t>(std::min(size, size_ - offset)));
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(stream_.gcount()));
  }
  return bytes;
}

}  // namespace handway::device
