#include "handway/geometric/io/files_read.h"

#include <algorithm>

namespace handway::geometric {
namespace {

thread_local FilesRead* innermost = nullptr;

}  // namespace

FilesRead::FilesRead() : outer_(innermost) { innermost = this; }

FilesRead::~FilesRead() { innermost = outer_; }

void note_file_read(const std::filesystem::path& file) {
  if (innermost == nullptr) {
    return;
  }
  const std::filesystem::path path = std::filesystem::absolute(file).lexically_normal();
  for (FilesRead* notes = innermost; notes != nullptr; notes = notes->outer_) {
    if (std::ranges::count(notes->files_, path) == 0) {
      notes->files_.push_back(path);
    }
  }
}

}  // namespace handway::geometric
