#include "campaigns/folder_lock.h"

#include "handway/geometric/io/input_error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace handway::planning {

using geometric::InputError;

FolderLock::FolderLock(const std::filesystem::path& folder)
    : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0) {
    throw InputError(
        {folder.string(), "", std::strerror(errno), "a folder for runs", "Choose another folder"});
  }
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(descriptor_);
    throw InputError({folder.string(), "", "a campaign that is being run there",
                      "a folder that no other program works in",
                      "Wait until it is done, or choose another folder"});
  }
}

FolderLock::~FolderLock() { close(descriptor_); }

}  // namespace handway::planning
